# Bores of the NIST plates by the long and the short end mills.
load plots."/style.gp"
set output out."/small_holes.svg"
set terminal svg size 1100,500 dynamic font "Helvetica,12" background rgb "white"
d = data."/small_holes.dat"
set multiplot layout 1,2 title "NIST plate: bores milled on a helix, mean of a part, measured − programmed diameter" font ",15"
set grid
set xlabel "feed per revolution in the bore (predicted motion), mm"
set ylabel "measured − programmed, mm"
set xrange [0.03:0.14]
set yrange [-0.1:0.5]
set key top left Left reverse samplen 1.5
set title "4 mm bores, T5 (1/8 in)"
plot 0 with lines ls 9 notitle, \
  d using 4:($2==1?$5:1/0) with points ls 2 ps 1 title "measured, stick-out 34.9 mm", \
  d using 4:($2==0?$5:1/0) with points ls 1 ps 0.9 title "measured, stick-out 9.5 mm", \
  d using 4:($2==1?$8:1/0) with points ls 4 title "static bending says, 34.9 mm", \
  d using 4:($2==0?$8:1/0) with points ls 5 title "static bending says, 9.5 mm", \
  d using 4:($2==1&&$1!=11?$5:1/0):(sprintf("  %.0f rpm",$3)) with labels left font ",10" notitle
set title "The other small bores"
plot 0 with lines ls 9 notitle, \
  d using 4:($2==1?$6:1/0) with points ls 2 title "4.5 mm, T5, spotted before, 34.9 mm", \
  d using 4:($2==0?$6:1/0) with points ls 1 title "4.5 mm, T5, spotted before, 9.5 mm", \
  d using 4:($2==1?$7:1/0) with points ls 4 title "3 mm, T1 (.093 in), 34.9 mm", \
  d using 4:($2==0?$7:1/0) with points ls 5 title "3 mm, T1 (.093 in), 9.5 mm"
unset multiplot
