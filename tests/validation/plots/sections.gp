# Error of the measured cross section by size of cell.
load plots."/style.gp"
set output out."/sections.svg"
set terminal svg size 700,460 dynamic font "Helvetica,12" background rgb "white"
d = data."/sections.dat"
set title "Cross section on a path skewed to the cells: largest error" font ",14"
set logscale xy
set xrange [20:250]
set yrange [0.0005:2]
set xtics ("D/25" 25, "D/50" 50, "D/100" 100, "D/200" 200)
set xlabel "size of the height map's cells"
set ylabel "largest error of CSA, % of depth × diameter"
set grid
set key bottom left Left reverse
set arrow from 20,0.5 to 250,0.5 nohead ls 10
set label "asked at D/100: 0.5 % or more" at 21,0.6 font ",10"
plot d using 1:2 with linespoints ls 1 title "slot", d using 1:3 with linespoints ls 2 title "shoulder, 2 mm wide", \
  d using 1:4 with linespoints ls 5 title "ball in the solid"
