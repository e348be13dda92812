table = folder.'/histogram.csv'
stats table using 5 every ::1 nooutput
set title sprintf("Pixel values of counting (solid) and of explicit facets (dashed)\n{/*0.8 truth: explicit; %d pixels a curve, 16 samples, box filter; one standard error of a share is at most %.4f}", STATS_max, 0.5 / sqrt(STATS_max))
set logscale x 2
set xlabel "value / smooth (the first point: all that is darker)\n{/*0.85 Choose explicit where single facets must be told apart, counting from a hundred a pixel on.}"
set ylabel 'share of pixels'
set format y '%.2f'
set key right top
plot table index 0 using 2:3 with lines linetype 1 title '16 facets a pixel', \
    table index 0 using 2:4 with lines linetype 1 dashtype 2 notitle, \
    table index 1 using 2:3 with lines linetype 2 title '128', \
    table index 1 using 2:4 with lines linetype 2 dashtype 2 notitle, \
    table index 2 using 2:3 with lines linetype 3 title '1024', \
    table index 2 using 2:4 with lines linetype 3 dashtype 2 notitle
