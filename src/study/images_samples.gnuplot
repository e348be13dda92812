stats 'images_samples.csv' using 7 every ::1 nooutput
most = STATS_max
stats 'images_samples.csv' using 2 every ::1 nooutput
set title sprintf("A whole picture: error against seconds\n{/*0.8 truth: %d samples a pixel; 1 to %d samples, a factor of four from point to point; bars: one standard error, with the truth's own}", most, STATS_max)
set logscale xy
set xlabel "seconds of one core\n{/*0.85 Choose 16 samples for a look, 64 for a picture, 256 for a reference.}"
set ylabel 'root mean square error over the mean'
set key bottom left Left reverse
set bars 0.6
low(e, b) = e - b > e / 10 ? e - b : e / 10
plot [] [1e-4:20] for [name in 'near-sparse far-dense area-lit layered'] \
    sprintf('< grep "^%s," images_samples.csv', name) using 3:4:(low($4, $5)):($4 + $5) with yerrorlines title name
