set title 'Convergence to Cook-Torrance as facets are added'
set logscale xy
set xlabel 'facets under the pixel'
set ylabel 'root mean square of f / Cook-Torrance - 1'
set key right top
table = folder.'/convergence.csv'
plot [1:1e12] [1e-6:100] \
    table index 0 using 2:3 with linespoints linetype 1 title 'counting, GGX', \
    table index 1 using 2:3 with linespoints linetype 6 title 'counting, Beckmann', \
    table index 2 using 2:3 with linespoints linetype 7 title 'explicit, GGX', \
    table index 3 using 2:3 with linespoints linetype 2 title 'dictionary, GGX', \
    table index 4 using 2:3 with linespoints linetype 5 title 'dictionary, Beckmann', \
    5 / sqrt(x) with lines linecolor rgb '#AAAAAA' dashtype 2 title '1 / √N'
