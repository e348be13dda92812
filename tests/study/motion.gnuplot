table = folder.'/motion.csv'
set multiplot layout 1,2 title "What changes in so many frames: 0 a still picture, 1 frames that know nothing of each other\n{/*0.8 truth: explicit, whose facets stay; 32 x 32 pixels, 120 frames, many seeds; bars: one standard error over seeds}"
set bmargin at screen 0.16
set logscale x 2
set xlabel 'frames'
set ylabel 'S, in variances of explicit'
set yrange [0:1.3]
set key top left
do for [i=0:1] {
    set title i == 0 ? 'camera recedes, x 8 in 120 frames' : 'light turns by 0.6 rad in 120 frames'
    plot table index (12 * i) using 4:5:6 with yerrorlines linetype 1 title 'explicit, pixels', \
        table index (12 * i + 3) using 4:5:6 with yerrorlines linetype 6 title 'explicit, 8 x 8', \
        table index (12 * i + 4) using 4:5:6 with yerrorlines linetype 2 title 'counting, pixels', \
        table index (12 * i + 7) using 4:5:6 with yerrorlines linetype 5 title 'counting, 8 x 8', \
        table index (12 * i + 8) using 4:5:6 with yerrorlines linetype 3 title 'dictionary, pixels'
    set label 1 'Choose counting: no frame pops; while a camera recedes its facets are replaced one by one.' \
        at screen 0.5, screen 0.03 center font ',10'
}
unset multiplot
