table = folder.'/plan.csv'
scenes = int(system(sprintf("cut -d, -f1 '%s' | sort -u | grep -vc '^scene$'", table)))
set title sprintf("What is left out of a picture, against the budget: every scene stays below the line\n{/*0.8 truth: the same samples without a budget; %d scenes, no bars: the pictures share their samples}", scenes)
set logscale xy
set xlabel "error budget\n{/*0.85 Choose the error that you can bear: the plan keeps it.}"
set ylabel 'error, root mean square over pixels, relative'
set format y '10^{%L}'
set key left top
plot [1e-3:1] [1e-6:1] \
    table every ::1 using 3:($2==1 ? $4 : 1/0) with points linetype 1 title '1 sample', \
    table every ::1 using ($3 * 1.04):($2==16 ? $4 : 1/0) with points linetype 2 title '16 samples', \
    table every ::1 using ($3 * 1.08):($2==256 ? $4 : 1/0) with points linetype 3 title '256 samples', \
    x with lines linetype 7 dashtype 2 title 'the budget'
