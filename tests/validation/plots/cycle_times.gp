# Predicted times against LinuxCNC's simulated machine.
load plots."/style.gp"
set output out."/cycle_times.svg"
set terminal svg size 620,560 dynamic font "Helvetica,12" background rgb "white"
d = data."/cycle_times.dat"
set title "Steps of our programs on LinuxCNC's simulated machine" font ",14"
set logscale xy
set xlabel "simulated machine, s"
set ylabel "predicted, s"
set grid
set xrange [0.5:1000]
set yrange [0.5:1000]
set key top left Left reverse samplen 1.5
plot x with lines ls 9 title "equal", 1.05*x with lines ls 10 title "±5 %", x/1.05 with lines ls 10 notitle, \
  d using 1:($3==0?$2:1/0) with points ls 1 title "bracket, steps", \
  d using 1:($3==1?$2:1/0) with points ls 2 title "surface, steps", \
  d using 1:($3==2?$2:1/0) with points ls 5 title "reference pocket, steps", \
  d using 1:($3==9?$2:1/0) with points ls 4 ps 1.1 title "whole programs"
