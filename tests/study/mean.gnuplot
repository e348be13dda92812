table = folder.'/mean.csv'
stats table using 7 every ::1 nooutput
set title sprintf("Mean of counting over seeds / smooth\n{/*0.8 truth: the smooth lobe; four materials; %.1g to %.1g draws a point; bars: one standard error}", STATS_min, STATS_max)
set logscale x
stats table using 6 every ::1 nooutput name 'bar'
far = bar_max > 0.002 ? 0.02 : 0.01 # the middle form has wider bars
set xlabel "facets under the pixel\n{/*0.85 Choose counting at every density: its mean is the smooth value.}"
set format x '10^{%L}'
set ylabel 'mean / smooth'
set key right top
set bars 0.5
plot [0.5:2e9] [1 - far:1 + far] \
    table index 0 using ($4 * 0.85):5:6 with yerrorbars linetype 1 title 'one facet in 10000 lit', \
    table index 1 using ($4 * 0.95):5:6 with yerrorbars linetype 2 title 'one in 100', \
    table index 2 using ($4 * 1.05):5:6 with yerrorbars linetype 3 title 'one in 10', \
    table index 3 using ($4 * 1.18):5:6 with yerrorbars linetype 4 title 'one in 2', \
    1.005 with lines linecolor rgb '#D55E00' dashtype 2 title (far > 0.01 ? 'bound of those with short bars' : 'bound'), \
    0.995 with lines linecolor rgb '#D55E00' dashtype 2 notitle
