table = folder.'/convergence.csv'
stats table using 5 every ::1 nooutput
set title sprintf("Convergence to Cook-Torrance as facets are added (Chermain et al. 2020, Figure 2)\n{/*0.8 truth: the smooth lobe; %d views, lights and places a point; bars: one standard error}", STATS_max)
set logscale xy
set xlabel "facets under the pixel\n{/*0.85 Choose smooth from 10^9 facets on: a thousandth of the value is all that is left of them.}"
set ylabel 'root mean square of f / Cook-Torrance - 1'
set format x '10^{%L}'
set format y '10^{%L}'
set key right top
set bars 0.5
plot [0.7:2e12] [1e-6:100] \
    table index 0 using 2:3:4 with yerrorlines linetype 1 title 'counting, GGX', \
    table index 1 using 2:3:4 with yerrorlines linetype 6 title 'counting, Beckmann', \
    table index 2 using 2:3:4 with yerrorlines linetype 7 title 'explicit, GGX', \
    table index 3 using 2:3:4 with yerrorlines linetype 2 title 'dictionary, GGX', \
    table index 4 using 2:3:4 with yerrorlines linetype 5 title 'dictionary, Beckmann', \
    5 / sqrt(x) with lines linecolor rgb '#AAAAAA' dashtype 2 title '1 / √N'
