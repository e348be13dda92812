table = folder.'/paths.csv'
set title "Glowing surfaces: the renderer's balance heuristic against paths that only bump into light\n{/*0.8 truth: brute force in double, even over the hemisphere, two bounces; 192 pixels; bars: one standard error of both}"
set xlabel "radiance of a pixel by brute force\n{/*0.85 Choose the renderer's way: the same light with less grain.}"
set ylabel 'rendered over brute force'
set key top right
set bars 0.4
plot table every ::1 using 4:($3 / $4):($5 / $4) with yerrorbars linetype 1 linewidth 1 title 'pixels', 1 with lines linetype 2 title 'truth'
