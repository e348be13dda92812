set title 'Counts tend to the smooth surface (Fig. 10 of Kneiphof and Klein 2024)'
set logscale xy
set xlabel 'facets under the pixel'
set ylabel 'deviation of a pixel over its mean'
set format x '10^{%L}'
set format y '10^{%L}'
set key outside right
of(roughness, radius, column_) = abs(column(1) - roughness) < 1e-3 && abs(column(2) - radius) < 1e-3 ? column(column_) : NaN
set datafile missing NaN
radii = '20 3 0.26'
roughnesses = '0.1 0.5 0.9'
plot [10:3e7] \
    for [r = 1:3] for [a = 1:3] 'lights_convergence.csv' using 3:(of(real(word(roughnesses, a)), real(word(radii, r)), 6)) \
        with lines linetype r dashtype a linewidth 1 notitle, \
    for [r = 1:3] for [a = 1:3] 'lights_convergence.csv' using 3:(of(real(word(roughnesses, a)), real(word(radii, r)), 5)) \
        with points linetype r pointtype (4 + 2 * a) title '√α '.word(roughnesses, a).', sun '.word(radii, r).'°'
