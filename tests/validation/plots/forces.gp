# One cut by six published sets of coefficients.
load plots."/style.gp"
set output out."/forces.svg"
set terminal svg size 900,460 dynamic font "Helvetica,12" background rgb "white"
d = data."/forces.dat"
stats data."/forces_margin.dat" using 1 nooutput
m = STATS_min
stats data."/forces_margin.dat" using 2 nooutput
h = STATS_min
stats data."/forces_margin.dat" using 3 nooutput
l = STATS_min
set title "Peak force in a slot by six published sets of coefficients\n(4 mm deep, 0.08 mm per tooth, 12 mm, four teeth, helix 30°)" font ",14"
set style fill solid 0.55 border
set boxwidth 0.6
set xrange [-0.6:5.6]
set yrange [0:800]
set ylabel "peak resultant in the plane, N"
set xlabel "alloy and set (table 5 of doi 10.1186/s10033-021-00536-9)"
set xtics font ",10"
set grid ytics
set key top left Left reverse
plot d using 1:4:xtic(2) with boxes ls 1 title "peak", \
  d using 1:($4+22):(sprintf("Ktc %.0f",$3)) with labels font ",10" notitle, \
  m with lines ls 9 title "set [190]", h with lines ls 10 title "its margin, × and ÷ 1.5", l with lines ls 10 notitle
