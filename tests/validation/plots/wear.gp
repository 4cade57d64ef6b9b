# Life laws of the NASA milling data.
load plots."/style.gp"
set output out."/wear.svg"
set terminal svg size 620,560 dynamic font "Helvetica,12" background rgb "white"
d = data."/wear.dat"
set title "NASA milling: time to a flank wear of 0.3 mm, 15 cases" font ",14"
set logscale xy
set xrange [3:80]
set yrange [3:80]
set xlabel "measured, min"
set ylabel "predicted with the case left out, min"
set xtics (3,5,10,20,40,80)
set ytics (3,5,10,20,40,80)
set grid
set key top left Left reverse samplen 1.5
plot x with lines ls 9 title "equal", 1.5*x with lines ls 10 title "factor of 1.5", x/1.5 with lines ls 10 notitle, \
  d using 1:($4==0?$3:1/0) with points ls 1 ps 0.9 title "cast iron", \
  d using 1:($4==1?$3:1/0) with points ls 2 ps 0.9 title "steel"
