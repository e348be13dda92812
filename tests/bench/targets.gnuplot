set title "What is reached of what is aimed at\n{/*0.8 1: met; of what should be small, target over reached}"
set lmargin at screen .6
set rmargin at screen .96
set logscale x
set xrange [.1:30]
set yrange [] reverse
set xtics ('.1' .1, '.3' .3, '1' 1, '3' 3, '10' 10, '30' 30)
unset key
set style fill solid .85 noborder
table = folder.'/targets.csv'
set arrow from 1, graph 0 to 1, graph 1 nohead front linecolor rgb '#333333' linewidth 1.5
shown(x) = x > 30 ? 30 : x
plot table every ::1 using (.1):0:(.1):(shown($4)):($0 - .35):($0 + .35):($4 >= 1 ? 0x009E73 : 0xD55E00):ytic(1) with boxxyerror linecolor rgb variable
