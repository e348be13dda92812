# How every figure looks. Colours are Okabe and Ito's, which differ for any eye.
set datafile separator comma
set linetype 1 linecolor rgb '#0072B2' linewidth 2 pointtype 7 pointsize 0.7
set linetype 2 linecolor rgb '#D55E00' linewidth 2 pointtype 5 pointsize 0.7
set linetype 3 linecolor rgb '#009E73' linewidth 2 pointtype 9 pointsize 0.8
set linetype 4 linecolor rgb '#CC79A7' linewidth 2 pointtype 11 pointsize 0.8
set linetype 5 linecolor rgb '#E69F00' linewidth 2 pointtype 13 pointsize 0.8
set linetype 6 linecolor rgb '#56B4E9' linewidth 2 pointtype 3 pointsize 0.8
set linetype 7 linecolor rgb '#555555' linewidth 2 pointtype 1 pointsize 0.8
set border 3 linecolor rgb '#555555'
set tics nomirror textcolor rgb '#333333'
set grid linecolor rgb '#DDDDDD' linewidth 1 linetype 1
set key left top reverse Left
set format x '%g'
set format y '%g'
