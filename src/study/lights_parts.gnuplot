set title 'Parts of a rectangle against the whole (Appendix C, Fig. 9 of Kneiphof and Klein 2024)'
set logscale xy
set xlabel 'parts'
set ylabel 'error of their sum'
set format y '10^{%L}'
set xtics (4, 16, 64, 256)
of(name, column_) = stringcolumn(2) eq name ? column(column_) : NaN
set datafile missing NaN
plot [3:340] [1e-5:1e1] \
    'lights_parts.csv' using 1:(of('fast', 3)) with linespoints linetype 1 title 'fast, mean', \
    'lights_parts.csv' using 1:(of('fast', 4)) with linespoints linetype 1 dashtype 2 title 'fast, worst', \
    'lights_parts.csv' using 1:(of('exact', 3)) with linespoints linetype 3 title 'exact, mean', \
    'lights_parts.csv' using 1:(of('exact', 4)) with linespoints linetype 3 dashtype 2 title 'exact, worst'
