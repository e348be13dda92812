table = folder.'/plain_lights.csv'
set datafile separator ','
set title "Few points of a light beside 4096\n{/*0.8 each dot a light of the study; broken: what Gauss's nodes leave of a double pole in two dimensions}"
set logscale xy
set format y '10^{%T}'
set xrange [0.05:5]
set yrange [1e-8:1]
set xlabel 'size of the light over the distance of the nearest singularity'
set ylabel 'relative error'
set key bottom right
r(x) = 1 / x + sqrt(1 + 1 / x**2)
pole(n, x) = 2 * (2 * n + 1) * r(x)**(-2 * n)
set arrow 1 from 0.35, graph 0 to 0.35, graph 1 nohead linecolor rgb '#CCCCCC'
set arrow 2 from 0.9, graph 0 to 0.9, graph 1 nohead linecolor rgb '#CCCCCC'
set arrow 3 from 1.6, graph 0 to 1.6, graph 1 nohead linecolor rgb '#CCCCCC'
set arrow 4 from 2.4, graph 0 to 2.4, graph 1 nohead linecolor rgb '#CCCCCC'
plot table using 2:3 with points pointtype 7 pointsize 0.25 linetype 1 notitle, table using 2:4 with points pointtype 7 pointsize 0.25 linetype 2 notitle, \
    table using 2:5 with points pointtype 7 pointsize 0.25 linetype 3 notitle, table using 2:6 with points pointtype 7 pointsize 0.25 linetype 4 notitle, \
    pole(3, x) with lines linetype 1 linewidth 2 dashtype 2 title '8 points', \
    pole(4, x) with lines linetype 2 linewidth 2 dashtype 2 title '16', \
    pole(6, x) with lines linetype 3 linewidth 2 dashtype 2 title '36', \
    pole(8, x) with lines linetype 4 linewidth 2 dashtype 2 title '64'
