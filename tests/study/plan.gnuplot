set title 'What is left out of a picture, against the budget: every scene stays below the line'
set logscale xy
set datafile separator ','
set xlabel 'error budget'
set ylabel 'error, root mean square over pixels, relative'
set key left top
table = folder.'/plan.csv'
plot [1e-3:1] [1e-5:1] \
    table using 3:($2==1 ? $4 : 1/0) with points linetype 1 title '1 sample', \
    table using 3:($2==16 ? $4 : 1/0) with points linetype 6 title '16 samples', \
    table using 3:($2==256 ? $4 : 1/0) with points linetype 7 title '256 samples', \
    x with lines linecolor rgb '#AAAAAA' dashtype 2 title 'the budget'
