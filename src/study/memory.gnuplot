set multiplot layout 1,2 title "What memory buys"
set logscale xy
set ylabel 'root mean square error over the mean'
set format y '%g'
set key top right Right noreverse
set bars 0.6
of(name) = sprintf('< grep "x %s" memory_encodings.csv | sort -t, -n -k2', name)
set title "One marginal of the dictionary\n{/*0.8 truth: 256 lobes in double; 24 marginals; bars: one standard error}"
set xlabel "bytes: 16 to 256 samples\n{/*0.85 128 samples of 8 bits would be nearer than libglint's 64 of half.}"
plot [8:2000] for [name in '"8 bits" half float'] of(name) using 2:3:4 with yerrorlines title name
unset ylabel
set title "A map of normals from far away\n{/*0.8 truth: the smooth lobe; bars: one standard error}"
set xlabel "bytes while it is made, by texels\n{/*0.85 Choose 16 x 16: more do not show a better lobe.}"
set format x '10^{%L}'
set key off
plot [3e5:1e8] [0.01:0.2] 'memory_maps.csv' every ::1 using 2:3:4 with yerrorlines linetype 1, \
    'memory_maps.csv' every ::1 using 2:3:(word(stringcolumn(1), 1)) with labels left rotate by 60 offset 0.2,0.8 font ',9'
unset multiplot
