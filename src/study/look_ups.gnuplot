set multiplot layout 1,2 title "Look-ups of a count: what a pixel costs, how far off it is\n{/*0.8 truth: all 36 at 1024 places of each pixel; 576 pixels, 1 to 1024 samples; bars: one standard error}"
set logscale xy
set ylabel 'root mean square error over the mean'
set format y '%g'
set key bottom left Left reverse
set bars 0.6
set bmargin at screen 0.16
of(name) = sprintf('< grep "^%s," look_ups.csv', name)
at(lit) = column(2) == lit ? column(5) : NaN
do for [lit in '1 30'] {
    set xlabel sprintf('µs a pixel, %s lit facet%s under it', lit, lit eq '1' ? '' : 's')
    plot [0.1:1000] [0.004:30] for [k = 1:3] name = word('"all 36" "one drawn by its weight" "the nearest"', k) \
        of(name) using 4:(at(lit + 0)):6 with yerrorlines linetype k title name
    unset ylabel
    set label 1 'Choose all 36: one drawn costs six tenths and needs sixteen times the samples for the same error.' \
        at screen 0.5, screen 0.03 center font ',10'
}
unset multiplot
