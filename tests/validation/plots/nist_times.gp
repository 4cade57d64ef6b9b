# Measured and predicted times per tool of the NIST plates.
load plots."/style.gp"
set output out."/nist_times.svg"
set terminal svg size 1100,520 dynamic font "Helvetica,12" background rgb "white"
set multiplot layout 1,2 title "NIST plate: time per tool in motion, 14 parts, 7 tools" font ",15"
set logscale xy
set xrange [10:900]
set yrange [3:900]
set xlabel "measured, s"
set key bottom right Left reverse samplen 1 spacing 1.05 font ",11"
set grid
d = data."/nist_times.dat"
set title "Predicted with path tolerance, acceleration and block time"
set ylabel "predicted, s"
plot x with lines ls 9 title "equal", 1.1*x with lines ls 10 title "±10 %", x/1.1 with lines ls 10 notitle, \
  d using 3:($6==0?$4:1/0) with points ls 1 title "calibrating: parts 2, 5, 10, 12", \
  d using 3:($6==1?$4:1/0) with points ls 2 title "tested: parts 4, 9, 14, 16, 18, 20", \
  d using 3:($6==2?$4:1/0) with points ls 3 title "interrupted: parts 1, 11, 19", \
  d using 3:($6==3?$4:1/0) with points ls 4 title "part 7, schedule's feeds"
set title "Length of the path ÷ programmed feed"
set ylabel "length ÷ feed, s"
set key top left
plot x with lines ls 9 title "equal", 1.1*x with lines ls 10 title "±10 %", x/1.1 with lines ls 10 notitle, \
  d using 3:($6==0?$5:1/0) with points ls 1 notitle, \
  d using 3:($6==1?$5:1/0) with points ls 2 notitle, \
  d using 3:($6==2?$5:1/0) with points ls 3 notitle, \
  d using 3:($6==3?$5:1/0) with points ls 4 notitle
unset multiplot
