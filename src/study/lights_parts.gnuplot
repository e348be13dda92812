stats 'lights_parts.csv' using 7 every ::1 nooutput
set title sprintf("Parts of a rectangle against the whole (Appendix C, Fig. 9 of Kneiphof and Klein 2024)\n{/*0.8 truth: the whole, by adaptive quadrature in double to 1e-9; %d random rectangles; bars: one standard error of the mean}", STATS_max)
set logscale xy
set xlabel "parts\n{/*0.85 Choose the exact integral where a light is made of parts that must add up; the fast one errs no more for being cut.}"
set ylabel 'relative error of the sum of the parts'
set format y '10^{%L}'
set xtics (1, 4, 16, 64, 256)
set key top right Right noreverse
set bars 0.6
of(name, column_) = stringcolumn(2) eq name ? column(column_) : NaN
low(e, b) = e - b > e / 10 ? e - b : e / 10
set datafile missing NaN
plot [0.75:340] [1e-8:1e1] \
    'lights_parts.csv' every ::1 using 1:(of('fast', 5)) with linespoints linetype 2 dashtype 2 title 'fast, worst', \
    'lights_parts.csv' every ::1 using 1:(of('fast', 3)):(low($3, $4)):($3 + $4) with yerrorlines linetype 1 title 'fast, mean', \
    'lights_parts.csv' every ::1 using 1:(of('exact', 5)) with linespoints linetype 4 dashtype 2 title 'exact, worst', \
    'lights_parts.csv' every ::1 using 1:(of('exact', 3)):(low($3, $4)):($3 + $4) with yerrorlines linetype 3 title 'exact, mean'
