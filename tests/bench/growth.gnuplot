set multiplot layout 2,4 margins .065,.985,.07,.83 spacing .065,.2 title "Time, and what memory it takes, as one thing grows\n{/*0.8 seconds of one core; below: ns of an evaluation, MiB at most}"
table = folder.'/growth.csv'
set logscale xy
set format x '10^{%L}'
set key left top reverse Left samplen 1 spacing 1
of(name) = sprintf("< grep '^%s,' '%s'", name, table)
set ytics ('1 µs' 1e-6, '10 µs' 1e-5, '.1 ms' 1e-4, '1 ms' .001, '10 ms' .01, '.1 s' .1, '1 s' 1, '10 s' 10, '100 s' 100)
set xtics 1, 10
set title 'pixels, 4 samples each'
plot of('resolution') using 2:3 with linespoints linetype 1 title 'render', x * 6e-6 with lines linecolor rgb '#AAAAAA' dashtype 2 title 'slope 1'
set title 'lights (32 x 32 pixels)'
plot [1:1e3] [.001:10] of('lights') using 2:3 with linespoints linetype 1 title 'render', x * 6e-3 with lines linecolor rgb '#AAAAAA' dashtype 2 title 'slope 1'
set title 'triangles'
plot of('triangles') using 2:3 with linespoints linetype 1 title 'load', of('triangles') using 2:5 with linespoints linetype 3 title 'Embree', \
    x * 6e-7 with lines linecolor rgb '#AAAAAA' dashtype 2 title 'slope 1'
set title 'texels of a PNG'
plot of('textures') using 2:3 with linespoints linetype 1 title 'read, render', x * 5e-8 with lines linecolor rgb '#AAAAAA' dashtype 2 title 'slope 1'
set title 'materials (64 x 64 pixels)'
plot [1:256] [.001:1] of('materials') using 2:3 with linespoints linetype 1 title 'set-up, render'
# of one evaluation, in ns: 4096 of them are measured
unset logscale y
set ytics auto
set format y '%g'
set title 'density: ns by facets / m²'
set xtics 1, 1e4
plot [1e2:1e14] [0:450] of('density') using 2:($3 / 4096 * 1e9) with linespoints linetype 1 title 'one point', \
    of('batch') using 2:($3 / 4096 * 1e9) with linespoints linetype 2 title 'batch'
set title 'footprint: ns by length / width'
set xtics 1, 10
plot [1:1e3] [0:450] of('footprint') using 2:($3 / 4096 * 1e9) with linespoints linetype 1 title 'one point'
set logscale y
set title 'MiB by what grows'
set xtics 1, 100
plot [1:1e8] [5:20000] of('resolution') using 2:4 with lines linetype 1 title 'pixels', of('lights') using 2:4 with lines linetype 2 title 'lights', \
    of('triangles') using 2:4 with lines linetype 3 title 'triangles', of('textures') using 2:4 with lines linetype 4 title 'texels', \
    of('materials') using 2:4 with lines linetype 5 title 'materials'
unset multiplot
