set multiplot layout 1,2 title "Look-ups of a count: what a pixel costs, how far off it is\n{/*0.8 truth: all 36 at 1024 places of each pixel; 576 pixels, 1 to 1024 samples; bars: one standard error}"
set logscale xy
set ylabel 'root mean square error over the mean'
set format y '%g'
set key bottom left Left reverse
set bars 0.6
set bmargin at screen 0.16
ways = '"all 36" "one drawn by its weight" "the nearest"'
of(name) = sprintf('< grep "^%s," look_ups.csv', name)
# What one drawn takes of the time of all, and how many times the samples, at 30 lit facets: as look_ups.c has it.
cell(way, samples, field) = real(system(sprintf('grep "^%s,30,%d," look_ups.csv | cut -d, -f%d', way, samples, field)))
share = cell(word(ways, 2), 1024, 4) / cell(word(ways, 1), 1024, 4)
times = 16.0 * (cell(word(ways, 2), 1024, 5) / cell(word(ways, 1), 64, 5))**2
at(lit) = column(2) == lit ? column(5) : NaN
do for [lit in '1 30'] {
    set xlabel sprintf('µs a pixel, %s lit facet%s under it', lit, lit eq '1' ? '' : 's')
    plot [0.1:1000] [0.004:30] for [k = 1:3] name = word(ways, k) \
        of(name) using 4:(at(lit + 0)):6 with yerrorlines linetype k title name
    unset ylabel
    set label 1 sprintf('Choose all 36: one drawn takes %.2f of their time and needs %.0f times the samples for the same error.', share, times) \
        at screen 0.5, screen 0.03 center font ',10'
}
unset multiplot
