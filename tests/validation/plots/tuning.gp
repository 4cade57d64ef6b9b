# Time of tuned parts over that of the handbook's, part by part, in simulated shops.
load plots."/style.gp"
set output out."/tuning.svg"
set terminal svg size 720,420 dynamic font "Helvetica,12" background rgb "white"
d = data."/tuning.dat"
set title "Simulated shops: time of a part, tuned over handbook" font ",14"
set xrange [1:40]
set yrange [0.75:1.05]
set xlabel "part"
set ylabel "time over the handbook's"
set grid
set key bottom left Left reverse samplen 1.5
set style fill transparent solid 0.18 noborder
plot 1 with lines ls 9 title "handbook (no cases)", \
  d using 1:3:4 with filledcurves lc rgb "#0072b2" title "half of the shops", \
  d using 1:6:7 with filledcurves lc rgb "#d55e00" title "half of the shops", \
  d using 1:2 with lines ls 1 title "regression only, median", \
  d using 1:5 with lines ls 2 title "Gaussian process, median"
