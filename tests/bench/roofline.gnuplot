set title "Where the counting kernel stands under what one core computes and what memory brings\n{/*0.8 an operation: one lane of one vector instruction}"
set logscale xy
set xlabel 'operations for a byte of points and results'
set ylabel 'billion operations a second'
set key left top
roof = folder.'/roofline_roof.csv'
dots = folder.'/roofline.csv'
set xtics (".1" .1, "1" 1, "10" 10, "100" 100, "1000" 1000)
lanes = '4 8 16'
plot [.1:1024] [1:1000] for [i = 0:2] roof index i using 1:2 with lines linetype (i + 1) title word(lanes, i + 1).' lanes: what the machine does at most', \
    for [i = 0:2] dots every ::i::i using 2:3 with points linetype (i + 1) pointtype 7 pointsize 1.6 title word(lanes, i + 1).' lanes: the kernel'
