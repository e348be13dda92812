places = int(system("grep -c '^0.3' lights_replaced.csv"))
set title sprintf("A panel on a floor: integrals replaced one by one (Fig. 7 of Kneiphof and Klein 2024)\n{/*0.8 truth: adaptive quadrature in double to 1e-9; %d places a line; no bars, as nothing is drawn at random; full lines √α = .3, dashed .6}", places)
set label 1 "Choose both fast: what they are off they are off together, and a glint keeps its light." at screen 0.5, screen 0.03 center font ',10'
set xlabel 'place on the floor, m; the panel stands at 1.5'
set ylabel 'over the true one'
set y2label 'radiance factor of the highlight'
set y2tics textcolor rgb '#333333'
set ytics nomirror
set logscale y2
set format y2 '10^{%L}'
set key at screen 0.5, screen 0.1 center horizontal samplen 3
set bmargin at screen 0.25
of(roughness, column_) = abs(column(1) - roughness) < 1e-3 ? column(column_) : NaN
set datafile missing NaN
roughness(k) = real(word('0.3 0.6', k))
plot [-2.5:1.4] [0.994:1.006] \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 3)) axes x1y2 with lines linetype 7 linewidth 1 \
        dashtype k title k == 1 ? 'highlight (right)' : '', \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 5)) with lines linetype 1 \
        dashtype k title k == 1 ? 'radiance fast' : '', \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 7)) with lines linetype 2 \
        dashtype k title k == 1 ? 'light of a glint, p fast' : '', \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 8)) with lines linetype 3 linewidth 3 \
        dashtype k title k == 1 ? 'light of a glint, both fast' : '', \
    for [k = 1:2] 'lights_replaced.csv' using 2:(of(roughness(k), 10)) with lines linetype 4 linewidth 1 \
        dashtype k title k == 1 ? 'both exact' : ''
