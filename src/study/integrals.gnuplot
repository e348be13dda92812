stats 'integrals.csv' using 6 every ::1 nooutput
truth = STATS_max
lights = int(system("grep -c '^point' integrals.csv"))
set title sprintf("Lights of real size: what an integral costs, how far off it is\n{/*0.8 truth: adaptive quadrature in double, by its own estimate good to %.0e; %d random rectangles, GGX, √α .1 to 1; bars: a standard deviation}", truth, lights)
set logscale xy
set xlabel "ns a light (smooth lobe, one lane)\n{/*0.85 Choose the fast integral; the exact one for references and anisotropic roughness.}"
set ylabel 'relative error of the radiance'
set format y '10^{%L}'
set key bottom left Left reverse
set bars 0.6
low(e, b) = e - b > e / 10 ? e - b : e / 10
few(n) = strstrt(n, 'random') ? n : ''
near(n) = n eq 'Gauss 2 x 2' || n eq 'Gauss 8 x 8' ? n : ''
# Below the points: what stands there has room to the left and right.
below(n) = n eq 'point' || n eq 'cap' ? n : ''
else(n) = strstrt(n, 'random') || near(n) ne '' || below(n) ne '' ? '' : n
plot [50:1e5] [1e-8:100] \
    '< grep ",1$" integrals_front.csv' using 2:3 with lines linetype 1 linewidth 1 dashtype 2 notitle, \
    '< grep ",1$" integrals_worst_front.csv' using 2:3 with lines linetype 2 linewidth 1 dashtype 2 notitle, \
    'integrals_front.csv' every ::1 using 2:3:(low($3, $4)):($3 + $4) with yerrorbars linetype 1 title 'median', \
    'integrals_worst_front.csv' every ::1 using 2:3:(low($3, $4)):($3 + $4) with yerrorbars linetype 2 title '95 % of the lights', \
    for [file in 'integrals_front.csv integrals_worst_front.csv'] file every ::1 using 2:3:(else(stringcolumn(1))) \
        with labels left offset 0.8,-0.8 font ',9' notitle, \
    for [file in 'integrals_front.csv integrals_worst_front.csv'] file every ::1 using 2:3:(near(stringcolumn(1))) \
        with labels right offset -0.8,-0.8 font ',9' notitle, \
    for [file in 'integrals_front.csv integrals_worst_front.csv'] file every ::1 using 2:3:(below(stringcolumn(1))) \
        with labels center offset 0,0.9 font ',9' notitle, \
    'integrals_worst_front.csv' every ::1 using 2:3:(few(stringcolumn(1))) \
        with labels left offset 0.8,0.9 font ',9' textcolor rgb '#777777' notitle
