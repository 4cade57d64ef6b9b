# One look for all pictures: colours that are told apart by the colour-blind, and by shape.
set encoding utf8
set style line 1 lc rgb "#0072b2" pt 7 ps 0.6 lw 2
set style line 2 lc rgb "#d55e00" pt 5 ps 0.6 lw 2
set style line 3 lc rgb "#999999" pt 9 ps 0.7 lw 2
set style line 4 lc rgb "#cc79a7" pt 13 ps 0.8 lw 2
set style line 5 lc rgb "#009e73" pt 11 ps 0.8 lw 2
set style line 9 lc rgb "#444444" lw 1.2 dt 1
set style line 10 lc rgb "#888888" lw 1 dt 2
set border lw 0.8
set grid lc rgb "#dddddd" lw 0.6
