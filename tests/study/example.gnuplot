set title "Example model: times faster than the full sum of Gaussians\n{/*0.8 truth: the sum over every texel (Yan et al. 2016); 100 or 400 queries a point, timed in one run; no bars}"
set logscale xy
set xlabel "pixel, texels along a side\n{/*0.85 Choose it for pixels of a texel and more; below that a sum over the few texels is as fast.}"
set ylabel 'times faster'
set key left top
table = folder.'/example_speed.csv'
plot [0.3:60] [0.1:200] \
    table index 0 using 1:5 with linespoints linetype 1 title 'tiled, any half vector', \
    table index 0 using 1:9 with linespoints linetype 6 title 'tiled, lit', \
    table index 1 using 1:5 with linespoints linetype 7 title 'scattered, any half vector', \
    table index 1 using 1:9 with linespoints linetype 2 title 'scattered, lit', \
    1 with lines linecolor rgb '#AAAAAA' dashtype 2 title 'the full sum'
