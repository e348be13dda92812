stats 'models.csv' using 11 every ::1 nooutput
set title sprintf("Models: what a pixel costs, how far its blocks are off\n{/*0.8 truth: explicit, every facet; %d surfaces of 48 x 48 pixels, Beckmann of α = .3; bars: one standard error}", STATS_max)
set logscale xy
set xlabel "ns a pixel\n{/*0.85 Choose counting: its cost does not grow with the facets; explicit only where there are few.}"
set format x '10^{%L}'
set ylabel 'error of the standard deviation of blocks of 4 x 4 pixels'
set key top right Left reverse
set bars 0.6
error(e) = e > 1e-3 ? e : 1e-3
low(e, b) = e - b > 1e-3 ? e - b : 1e-3
of(n) = sprintf('< grep ",%s," models.csv | grep -v explicit', n)
sizes = '4 64 1024'
set ytics add ('none' 1e-3)
plot [60:1e6] [1e-3:3] for [k = 1:3] of(word(sizes, k)) using 3:(error($9)):(low($9, $10)):($9 + $10) \
        with yerrorbars linetype k title word(sizes, k).' facets a pixel', \
    '< grep ",64," models.csv | grep -v explicit' using 3:(error($9) * 1.25):1 with labels left offset 2.6,0.3 font ',9' notitle, \
    '< grep "^example,4," models.csv' using 3:(error($9) * 1.25):1 with labels right offset -1.2,0 font ',9' notitle, \
    for [k = 1:3] sprintf('< grep "explicit,%s," models.csv', word(sizes, k)) using 3:(1e-3) with points linetype k pointsize 1.6 notitle, \
    '< grep "explicit" models.csv' using 3:(1.5e-3):1 with labels font ',9' notitle
