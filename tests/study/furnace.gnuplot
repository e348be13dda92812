table = folder.'/furnace.csv'
set multiplot layout 1,3 title "Weak white furnace of the dictionary (Chermain et al. 2020, Figure 9)\n{/*0.8 truth: 1; one patch a point, integrated over 60 000 half vectors; no bars, the sum is good to 10^{-5}}"
set bmargin at screen 0.16
set yrange [0.985:1.015]
set ylabel 'reflected / incident'
set key top left
array label[3] = ['roughness α', 'facets under the pixel', 'variation of the density ζ']
do for [i=0:2] {
    unset logscale x
    if (i < 2) { set logscale x }
    set xlabel label[i + 1]
    set xtics (i == 1 ? 1e4 : i == 0 ? 10 : 1)
    plot table index i using (column(i + 1)):4 with linespoints linetype 1 title 'θ = 0', \
        table index i using (column(i + 1)):5 with linespoints linetype 3 title 'θ = π/4', \
        table index i using (column(i + 1)):6 with linespoints linetype 2 title 'θ = 1.56', \
        1.003 with lines linecolor rgb '#AAAAAA' dashtype 2 title 'the paper', \
        0.997 with lines linecolor rgb '#AAAAAA' dashtype 2 notitle, \
        1.012 with lines linecolor rgb '#E0B090' dashtype 2 title 'the paper, 1.56', \
        0.988 with lines linecolor rgb '#E0B090' dashtype 2 notitle
    unset ylabel
    if (i == 1) { set label 1 'Choose any: no roughness, density or variation makes or loses light.' at screen 0.5, screen 0.03 center font ',10' }
}
unset multiplot
