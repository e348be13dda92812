stats 'lights_convergence.csv' using 8 every ::1 nooutput
set title sprintf("Counts tend to the smooth surface (Fig. 10 of Kneiphof and Klein 2024)\n{/*0.8 truth: lines, the binomial law's √((1 - p) / N p); points: %d pixels each; bars: one standard error}", STATS_max)
set logscale xy
set xlabel "facets under the pixel\n{/*0.85 Choose smooth where a hundredth may be missing and 10 000 facets are lit: --accuracy .01 does it.}"
set ylabel 'deviation of a pixel over its mean'
set format x '10^{%L}'
set format y '10^{%L}'
set key outside right top
set bars 0.4
set label 1 'a hundredth' at 12, 0.0065 font ',9' textcolor rgb '#555555'
of(roughness, radius, column_) = abs(column(1) - roughness) < 1e-3 && abs(column(2) - radius) < 1e-3 ? column(column_) : NaN
low(d, b) = d - b > d / 10 ? d - b : d / 10
set datafile missing NaN
radii = '20 3 0.26'
roughnesses = '0.1 0.5 0.9'
plot [10:3e7] [1e-5:1e3] \
    0.01 with lines linetype 7 linewidth 1 dashtype 3 notitle, \
    for [r = 1:3] for [a = 1:3] 'lights_convergence.csv' using 3:(of(real(word(roughnesses, a)), real(word(radii, r)), 7)) \
        with lines linetype r dashtype a linewidth 1 notitle, \
    for [r = 1:3] for [a = 1:3] 'lights_convergence.csv' every ::1 \
        using 3:(of(real(word(roughnesses, a)), real(word(radii, r)), 5)):(low($5, $6)):($5 + $6) \
        with yerrorbars linetype r linewidth 1 pointtype (4 + 2 * a) title '√α '.word(roughnesses, a).', sun '.word(radii, r).'°'
