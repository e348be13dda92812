stats 'law.csv' using 8 every ::1 nooutput
set title sprintf("The mean of a binomial count over N p\n{/*0.8 truth: 1; N from .3 to 10 000, p from .001 to .95; %d even uniforms a point, which leave less than its size}", STATS_max)
set logscale x
set xlabel "N p, facets that are lit\n{/*0.85 Choose libglint: it is at 1 everywhere.}"
set ylabel 'mean over N p'
set format x '10^{%L}'
set key top right Right noreverse
of(name) = sprintf('< grep -F "%s" law.csv', name)
plot [0.08:1.2e4] [-0.1:2.6] 1 with lines linetype 7 linewidth 1 notitle, \
    of('as printed') using ($2*$3):4 with points linetype 2 title 'gated Gaussian as printed', \
    of('cut at 0') using ($2*$3):4 with points linetype 5 title 'cut at 0 (Deliot, Belcour 2023)', \
    of('cut to [1') using ($2*$3):4 with points linetype 4 title 'cut to [1, N] (Kneiphof, Klein 2024)', \
    of('walking to 5') using ($2*$3):4 with points linetype 1 pointsize 1 title 'libglint'
