set title 'A panel on a floor: integrals replaced one by one (Fig. 7 of Kneiphof and Klein 2024)'
set xlabel 'place on the floor, m; the panel stands at 1.5'
set ylabel 'over the exact one'
set y2label 'radiance factor'
set y2tics textcolor rgb '#333333'
set ytics nomirror
set logscale y2
set format y2 '10^{%L}'
set key outside bottom center horizontal
set bmargin at screen 0.24
of(roughness, column_) = abs(column(1) - roughness) < 1e-3 ? column(column_) : NaN
set datafile missing NaN
roughness(k) = real(word('0.3 0.6', k))
plot [-2.5:1.4] [0.96:1.04] \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 3)) axes x1y2 with lines linetype 7 linewidth 1 \
        dashtype k title sprintf('highlight, √α %g', roughness(k)), \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 5)) with lines linetype 1 \
        dashtype k title sprintf('radiance fast, √α %g', roughness(k)), \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 7)) with lines linetype 2 \
        dashtype k title 'light of a glint, p fast', \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 8)) with lines linetype 3 \
        dashtype k title 'light of a glint, both fast'
