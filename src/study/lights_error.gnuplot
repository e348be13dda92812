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
plot [1e-6:1] [0.1:1] \
    'lights_error.csv' using (of('GGX')):2:(worse($6)) with points pointtype 7 pointsize 0.35 linecolor palette title 'GGX', \
    'lights_error.csv' using (of('Beckmann')):2:(worse($6)) with points pointtype 9 pointsize 0.45 linecolor palette title 'Beckmann'
