stats 'images_accuracy.csv' using 6 every ::1 nooutput
set multiplot layout 1,2 title sprintf("--accuracy: what it leaves out of a picture, and the time that it saves\n{/*0.8 truth: the same %d samples without a budget; bars: one standard error}", STATS_max)
set logscale x
set bars 0.6
set logscale y
set xlabel '--accuracy'
set bmargin at screen 0.16
set ylabel 'left out, root mean square over the mean'
set key bottom right Right noreverse
set format y '%g'
set ytics add ('nothing' 1e-5)
least(e) = e > 1e-5 ? e : 1e-5
plot [0.0015:0.3] [1e-5:0.5] x with lines linetype 7 dashtype 2 title 'the budget', \
    for [k = 1:4] name = word('near-sparse far-dense area-lit layered', k) \
    sprintf('< grep "^%s,0\\.[0-9]" images_accuracy.csv', name) using 2:(least($4)):5 with yerrorlines linetype k title name
unset logscale y
unset ytics
set ytics nomirror textcolor rgb "#333333"
set label 1 "Choose .02 or more but for references: lights with a shape then cost a fraction; .01 where every flake must be the very one." \
    at screen 0.5, screen 0.03 center font ',10'
set ylabel 'time over that without a budget'
set format y '%g'
set key bottom left Left reverse
whole(name) = real(system(sprintf('grep "^%s,0," images_accuracy.csv | cut -d, -f3', name)))
plot [0.0015:0.3] [0:*] for [k = 1:4] name = word('near-sparse far-dense area-lit layered', k) \
    sprintf('< grep "^%s,0\\.[0-9]" images_accuracy.csv', name) using 2:($3 / whole(name)) with linespoints linetype k title name
unset multiplot
