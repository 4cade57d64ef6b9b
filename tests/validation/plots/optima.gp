# Differences to the tabulated optima.
load plots."/style.gp"
set output out."/optima.svg"
set terminal svg size 900,420 dynamic font "Helvetica,12" background rgb "white"
d = data."/optima.dat"
set title "Published problems: our optima against the tabulated ones" font ",14"
set logscale x
set xrange [0.005:300]
set yrange [9.6:-0.6]
set xlabel "relative difference, 1e-6 (what is printed of the tabulated values limits it)"
set ytics ("five milling operations" 0, "turning 6 mm" 1, "turning 8 mm" 2, "turning 10 mm" 3, "turning, least time" 4, "turning, least wear" 5, "least wear within 1 min" 6, "speed of least cost" 7, "speed of most production" 8, "drilled hole" 9)
set grid
set key top left Left reverse
set arrow from 100,-0.6 to 100,9.6 nohead ls 10
set label "asked: 1e-4" at 90,7.4 right font ",10"
plot d using 2:1 with points ls 1 ps 1 title "NLopt", d using 3:($1+0.2) with points ls 2 ps 0.9 title "Ipopt"
