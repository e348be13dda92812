table = folder.'/blocks.csv'
sweep = folder.'/blocks_sweep.csv'
set logscale x 2
set xtics (1, 2, 4, 8, 16)
set xlabel 'block of k x k pixels'
set ylabel 'variance of counting / variance of explicit'
set key bottom right
array low[10]
array high[10]
array squares[2]
do for [f=0:1] {
    do for [k=0:4] {
        stats sweep index f using (column(5 + k)) nooutput
        low[5 * f + k + 1] = STATS_min
        high[5 * f + k + 1] = STATS_max
    }
    stats table index f using 10 nooutput
    squares[f + 1] = STATS_max
}
set multiplot layout 1,2 title "Blocks of pixels vary as explicit's do\n{/*0.8 truth: explicit's variance in closed form; band: counting's in closed form, tilts to 80°, .5 to 1000 facets, all sizes; points: simulated, one sigma}"
set bmargin at screen 0.16
do for [f=0:1] {
    set title sprintf("%s\n{/*0.8 %d squares of 16 x 16 pixels a point}", \
        f == 0 ? '16 samples a pixel, box filter' : '1 sample a pixel, tent filter', squares[f + 1])
    plot [0.8:20] [0.65:1.35] \
        '+' using (2**int($0)):(low[5 * f + int($0) + 1]):(high[5 * f + int($0) + 1]) every ::0::4 \
            with filledcurves fillcolor rgb '#CCE3F2' title 'closed form', \
        1.3 - 0.15 * (x > 1.41) with lines linecolor rgb '#D55E00' dashtype 2 title 'bound', \
        0.7 + 0.15 * (x > 1.41) with lines linecolor rgb '#D55E00' dashtype 2 notitle, \
        table index f using ($6 * (1 + 0.03 * (int($0 / 5) - 3.5))):8:9 with yerrorbars linetype 1 title 'simulated'
    unset ylabel
    set label 1 'Choose counting from blocks of 2 x 2 pixels on; where single pixels matter, 16 samples and a box.' \
        at screen 0.5, screen 0.03 center font ',10'
}
unset multiplot
