stats 'law.csv' using 8 every ::1 nooutput
set title sprintf("The mean of a binomial count: what it costs, how far off it is\n{/*0.8 truth: N p; worst of 41 pairs (N, p), %d draws each; bars: what that many draws leave open}", STATS_max)
set logscale xy
set xlabel "ns a draw (one lane, twelve draws sharing N and p)\n{/*0.85 Choose libglint's own walk to a mean of 8: the whole law is nearer than with 2 or 5 for a nanosecond more.}"
set ylabel 'worst error of the mean over N p'
set format y '10^{%L}'
set key top right Left reverse
set bars 0.6
low(e, b) = e - b > 2e-6 ? e - b : 2e-6
array name[8] = ['gated Gaussian as printed', 'gated Gaussian cut at 0 (DB23)', 'cut to [1; N] (KK24)', 'libglint walking to 2', \
    'libglint (walking to 5)', 'libglint walking to 8', 'libglint walking to 16', 'exact (BTPE)']
of(k) = sprintf('< grep -F "%s," law_front.csv', name[k])
array colour[8] = [2, 5, 4, 6, 3, 1, 7, 7]
array shape[8] = [5, 13, 11, 9, 9, 7, 9, 2]
plot [8:120] [2e-6:300] for [k = 1:8] of(k) using 2:3:(low($3, $4)):($3 + $4) with yerrorbars linetype colour[k] \
    linewidth 1 pointtype shape[k] pointsize (k == 6 ? 1.4 : 1) title name[k]
