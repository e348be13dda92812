set title 'Fast integral over lights of real size: error of the radiance'
set logscale xcb
set xlabel 'radiance factor of the light'
set ylabel 'roughness √α'
set cblabel 'error over the exact integral'
set palette defined (0 '#EEEEEE', 1 '#56B4E9', 2 '#0072B2', 3 '#E69F00', 4 '#D55E00')
set cbrange [1e-4:1]
set format x '10^{%L}'
set format cb '10^{%L}'
set key outside top right horizontal
worse(x) = abs(x) < 1e-4 ? 1e-4 : abs(x)
of(name) = stringcolumn(1) eq name ? column(5) : NaN
# Few are worse than a tenth: they lie on top, and the worst say from where they are seen and how large they are.
bad(name) = abs(column(6)) > 0.1 ? of(name) : NaN
worst(error) = abs(error) > 0.25 ? column(5) : NaN
told(view, size) = sprintf('%.0f°, %.2g sr', view, size)
plot [1e-6:1] [0.1:1] \
    'lights_error.csv' using (of('GGX')):2:(worse($6)) with points pointtype 7 pointsize 0.35 linecolor palette title 'GGX', \
    'lights_error.csv' using (of('Beckmann')):2:(worse($6)) with points pointtype 9 pointsize 0.45 linecolor palette title 'Beckmann', \
    'lights_error.csv' using (bad('GGX')):2:(worse($6)) with points pointtype 7 pointsize 1.1 linecolor palette notitle, \
    'lights_error.csv' using (bad('Beckmann')):2:(worse($6)) with points pointtype 9 pointsize 1.3 linecolor palette notitle, \
    'lights_error.csv' using (worst($6)):2:(told($3, $4)) with labels offset 0, 0.7 font ',8' notitle
