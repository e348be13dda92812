set multiplot layout 1,3 margins .07,.985,.14,.84 spacing .05 title 'Error against seconds of one core, without start-up: Cycles with explicit flakes, and libglint'
table = folder.'/cycles.csv'
set logscale xy
set format x '10^{%L}'
set format y '10^{%L}'
set xlabel 'seconds of the processor'
set key left bottom reverse Left
of(scene, who) = sprintf("< grep '^%s,%s,' '%s'", scene, who, table)
set ylabel 'root mean square error / mean' offset 1
do for [scene in 'plane_rect plane_sun sphere_rect'] {
    set title scene[1:strstrt(scene, '_') - 1].' under a '.scene[strstrt(scene, '_') + 1:*]
    plot [.01:100] [1e-4:100] of(scene, 'cycles') using 4:5 with linespoints linetype 2 title 'Cycles', \
        of(scene, 'ours') using 4:($5 > 1e-4 ? $5 : 1e-4) with linespoints linetype 1 title 'libglint, counting'
    unset ylabel
}
unset multiplot
