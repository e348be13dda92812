stats 'arithmetic.csv' using 6 every ::1 nooutput
set title sprintf("The smooth lobe in float and in double\n{/*0.8 truth: long double; %d random queries a point, α from .01 to 1; lines: root mean square, points: worst}", STATS_max)
set logscale xy
set xlabel "elevation of the light above the ground, degrees\n{/*0.85 Choose float: its error is the same at every angle, and a thousandth of what 8 bits show.}"
set ylabel 'relative error of f cos θ'
set format y '10^{%L}'
set key center right Right noreverse
plot [2e-4:90] [1e-17:1e-2] \
    1.0 / 255 with lines linetype 7 dashtype 2 linewidth 1 title 'one step of 8 bits', \
    'arithmetic.csv' every ::1 using 1:2 with lines linetype 1 title 'float', \
    'arithmetic.csv' every ::1 using 1:3 with points linetype 1 title 'float, worst', \
    'arithmetic.csv' every ::1 using 1:4 with lines linetype 2 title 'double', \
    'arithmetic.csv' every ::1 using 1:5 with points linetype 2 title 'double, worst'
