table = folder.'/blocks.csv'
sweep = folder.'/blocks_sweep.csv'
set logscale x 2
set xtics (1, 2, 4, 8, 16)
set xlabel 'block of k x k pixels'
set ylabel 'variance of counting / variance of explicit'
set key bottom right
array low[10]
array high[10]
do for [f=0:1] {
    do for [k=0:4] {
        stats sweep index f using (column(5 + k)) nooutput
        low[5 * f + k + 1] = STATS_min
        high[5 * f + k + 1] = STATS_max
    }
}
set multiplot layout 1,2 title 'Blocks of pixels: band, closed form over tilts to 80°, 0.5 to 1000 facets, all sizes; points, simulated'
do for [f=0:1] {
    set title f == 0 ? '16 samples a pixel, box filter' : '1 sample a pixel, tent filter'
    first = 40 * f
    plot [0.8:20] [0.65:1.35] \
        '+' using (2**int($0)):(low[5 * f + int($0) + 1]):(high[5 * f + int($0) + 1]) every ::0::4 \
            with filledcurves fillcolor rgb '#CCE3F2' title 'closed form', \
        1.3 - 0.15 * (x > 1.41) with lines linecolor rgb '#D55E00' dashtype 2 title 'bound', \
        0.7 + 0.15 * (x > 1.41) with lines linecolor rgb '#D55E00' dashtype 2 notitle, \
        table index f using ($6 * (1 + 0.03 * (int($0 / 5) - 3.5))):8:9 with yerrorbars linetype 1 title 'simulated, one sigma'
}
unset multiplot
