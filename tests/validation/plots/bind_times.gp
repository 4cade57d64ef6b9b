# Times of late binding.
load plots."/style.gp"
set output out."/bind_times.svg"
set terminal svg size 620,420 dynamic font "Helvetica,12" background rgb "white"
d = data."/bind_times.dat"
set title "Late binding: CPU time of a call" font ",14"
set logscale x
set xrange [2:2000]
set yrange [0:*]
set xlabel "CPU, ms"
set ylabel "share of the calls, per eighth of an octave"
set grid
set key top right reverse samplen 1.5
plot d using 2:($1==0?$3:1/0) with impulses ls 1 lw 4 title "length of a tool", \
  d using 2:($1==1?$3:1/0) with impulses ls 2 lw 4 title "diameter of a mill", \
  d using 2:($1==2?$3:1/0) with impulses ls 5 lw 4 title "next workingstep", \
  d using 2:($1==3?$3:1/0) with impulses ls 4 lw 4 title "bracket, all open", \
  d using 2:($1==4?$3:1/0) with impulses ls 3 lw 4 title "first of a large plan"
