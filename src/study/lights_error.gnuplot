lights = int(system("grep -c '^GGX\\|^Beckmann' lights_error.csv"))
stats 'lights_error.csv' using 11 every ::1 nooutput
known = STATS_max
set multiplot title sprintf("Lights of real size: true error of the radiance by the library's integrals\n{/*0.8 truth: adaptive quadrature in double, by its own estimate good to %.0e; %d random lights of five shapes; no bars, each is one number}", known, lights)
set label 1 "Choose the fast integral for pictures; the exact one (--accuracy 0) where a light of more than 2.5 sr is seen from 60° or more." \
    at screen 0.5, screen 0.03 center font ',10'
set logscale xcb
set xlabel 'radiance factor of the light'
set ylabel 'roughness √α'
set cblabel 'error of the fast integral'
# Darker is worse, in grey too.
set palette defined (0 '#E4E4E4', 1 '#F7C46C', 2 '#E8682F', 3 '#9B2964', 4 '#1B0C41')
set cbrange [1e-4:1]
set format x '10^{%L}'
set format cb '10^{%L}'
set key at screen 0.35, screen 0.885 center horizontal Left reverse
worse(x) = abs(x) < 1e-4 ? 1e-4 : abs(x)
of(name) = stringcolumn(1) eq name ? column(5) : NaN
# Few are worse than a tenth: they lie on top, and the worst say from where they are seen and how large they are.
bad(name) = abs(column(6)) > 0.1 ? of(name) : NaN
worst(error) = abs(error) > 0.25 ? column(5) : NaN
set style textbox opaque noborder margins 0.3, 0.2
told(view, size) = sprintf('%.0f°, %.2g sr', view, size)
set lmargin at screen 0.08
set rmargin at screen 0.5
set bmargin at screen 0.16
set tmargin at screen 0.86
plot [1e-6:1] [0.1:1] \
    'lights_error.csv' every ::1 using (of('GGX')):2:(worse($6)) with points pointtype 7 pointsize 0.35 linecolor palette notitle, \
    'lights_error.csv' every ::1 using (of('Beckmann')):2:(worse($6)) with points pointtype 9 pointsize 0.45 linecolor palette notitle, \
    'lights_error.csv' every ::1 using (bad('GGX')):2:(worse($6)) with points pointtype 7 pointsize 1.1 linecolor palette notitle, \
    'lights_error.csv' every ::1 using (bad('Beckmann')):2:(worse($6)) with points pointtype 9 pointsize 1.3 linecolor palette notitle, \
    'lights_error.csv' every ::1 using (worst($6)):2:(told($3, $4)) with labels boxed offset 0, 0.8 font ',8' notitle, \
    keyentry with points pointtype 7 linecolor rgb '#9B2964' title 'GGX', \
    keyentry with points pointtype 9 linecolor rgb '#9B2964' title 'Beckmann'
# How many are worse: of each distribution the share of lights beyond an error.
unset label 1
unset logscale cb
set logscale y
set xlabel 'error of the radiance'
set ylabel 'share of lights that are further off'
set format y '%g'
set key at screen 0.99, screen 0.915 right top vertical maxrows 3 width -1 Left reverse samplen 1.5 font ',8'
set lmargin at screen 0.735
set xtics 1e-10, 100
set tmargin at screen 0.8
set rmargin at screen 0.98
array count[2] = [int(system("grep -c '^GGX' lights_error.csv")), int(system("grep -c '^Beckmann' lights_error.csv"))]
sorted(name, column) = sprintf("< grep '^%s' lights_error.csv | cut -d, -f%d | sed 's/^-//' | sort -g", name, column)
plot [1e-10:1] [5e-5:1] \
    for [k = 1:2] sorted(word('GGX Beckmann', k), 6) using 1:(1.0 - $0 / count[k]) with lines linetype k title word('GGX Beckmann', k).', fast', \
    for [k = 1:2] sorted(word('GGX Beckmann', k), 9) using 1:(1.0 - $0 / count[k]) with lines linetype k dashtype 2 title word('GGX Beckmann', k).', exact', \
    '< cut -d, -f11 lights_error.csv | grep -v error | sort -g' using 1:(1.0 - $0 / lights) with lines linetype 7 linewidth 1 title 'the truth itself'
unset multiplot
