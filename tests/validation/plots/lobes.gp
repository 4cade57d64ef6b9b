# Stability lobes and simulated limits.
load plots."/style.gp"
set output out."/lobes.svg"
set terminal svg size 1100,460 dynamic font "Helvetica,12" background rgb "white"
set multiplot layout 1,2 title "Limiting depth of cut: zero-order lobes and a simulation in time (four teeth, Al 7075-T6)" font ",15"
set xlabel "spindle speed, 1/min"
set ylabel "axial depth, mm"
set xrange [4000:16000]
set yrange [0:*]
set grid
set key top left Left reverse
set title "Slot"
plot data."/lobes_slot.dat" using 1:2 with lines ls 1 title "lobes (stable below)", \
  data."/lobes_slot_points.dat" using 1:2 with points ls 2 title "simulated limit"
set title "Half immersion, down milling"
plot data."/lobes_half.dat" using 1:2 with lines ls 1 title "lobes (stable below)", \
  data."/lobes_half_points.dat" using 1:2 with points ls 2 title "simulated limit"
unset multiplot
