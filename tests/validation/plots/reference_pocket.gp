# What the simulated machine did in the reference pocket; drawn where the simulation ran.
load plots."/style.gp"
set output out."/reference_pocket.svg"
set terminal svg size 1000,420 dynamic font "Helvetica,12" background rgb "white"
set datafile separator ","
f = data."/reference_pocket.csv"
set title "Reference pocket on LinuxCNC's simulated machine: speed over time" font ",14"
set xlabel "machine time, s"
set ylabel "speed, mm/min"
set grid
set yrange [0:*]
set xrange [0:*]
set key top right
plot f using (strcol(1) eq "constant"?$2:1/0):6 every 8 with lines ls 3 lw 1 title "one feed per step, the best that is constant", \
  f using (strcol(1) eq "scheduled"?$2:1/0):6 every 8 with lines ls 1 lw 1 title "scheduled feeds"
