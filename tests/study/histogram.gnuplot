set title 'Pixel values of counting (solid) and of explicit facets (dashed), 16 samples, box filter'
set logscale x 2
set xlabel 'value / smooth (the first point: all that is darker)'
set ylabel 'share of pixels'
set format y '%.2f'
set key right top
table = folder.'/histogram.csv'
plot table index 0 using 2:3 with lines linetype 1 title '16 facets a pixel', \
    table index 0 using 2:4 with lines linetype 1 dashtype 2 notitle, \
    table index 1 using 2:3 with lines linetype 2 title '128', \
    table index 1 using 2:4 with lines linetype 2 dashtype 2 notitle, \
    table index 2 using 2:3 with lines linetype 3 title '1024', \
    table index 2 using 2:4 with lines linetype 3 dashtype 2 notitle
