stats 'law.csv' using 8 every ::1 nooutput
set multiplot layout 1,2 title sprintf("A binomial count: what it costs, how far off it is\n{/*0.8 truth: N p and the law, term by term; worst of 41 pairs (N, p), %d draws each; bars: what that many draws leave open}", STATS_max)
set logscale xy
set format y '10^{%L}'
set bars 0.6
set bmargin at screen 0.16
low(e, b) = e - b > 2e-6 ? e - b : 2e-6
array name[8] = ['gated Gaussian as printed', 'gated Gaussian cut at 0 (DB23)', 'cut to [1; N] (KK24)', 'libglint walking to 2', \
    'libglint (walking to 5)', 'libglint walking to 8', 'libglint walking to 16', 'exact (BTPE)']
of(file, k) = sprintf('< grep -F "%s," %s', name[k], file)
array colour[8] = [2, 5, 4, 6, 1, 3, 7, 7]
array shape[8] = [5, 13, 11, 9, 7, 9, 9, 2]
set xlabel 'ns a draw (one lane, twelve draws sharing N and p)'
set ylabel 'worst error of the mean over N p'
set key top right Left reverse font ',9'
plot [8:120] [2e-6:1e5] for [k = 1:8] of('law_front.csv', k) using 2:3:(low($3, $4)):($3 + $4) with yerrorbars \
    linetype colour[k] linewidth 1 pointtype shape[k] pointsize (k == 5 ? 1.4 : 1) title name[k]
set label 1 "Choose libglint's own walk to a mean of 5: its mean is right, and a longer walk is hardly nearer." \
    at screen 0.5, screen 0.03 center font ',10'
set ylabel 'worst distance of the law (Kolmogorov)'
set key off
plot [8:120] [2e-5:10] for [k = 1:8] of('law_ks_front.csv', k) using 2:3:($3 - $4 > 2e-5 ? $3 - $4 : 2e-5):($3 + $4) with yerrorbars \
    linetype colour[k] linewidth 1 pointtype shape[k] pointsize (k == 5 ? 1.4 : 1)
unset multiplot
