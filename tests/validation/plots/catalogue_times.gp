# Times of all recorded plans over a catalogue's, as shares of all plans of a machine.
load plots."/style.gp"
set output out."/catalogue_times.svg"
set terminal svg size 720,480 dynamic font "Helvetica,12" background rgb "white"
d = data."/catalogue_times.dat"
set title "Time of plans ÷ a catalogue's time" font ",14"
set logscale x
set xlabel "time ÷ catalogue's time"
set ylabel "share of plans up to it"
set grid
set xrange [0.4:35]
set xtics (0.5, 1, 2, 3, 5, 10, 20, 30)
set yrange [0:1.02]
set key below Left reverse samplen 1.5
plot d using 2:($1==2?$3:1/0) with linespoints ls 1 title "generic\\_vmc, 7.5 kW", \
  d using 2:($1==1?$3:1/0) with linespoints ls 2 title "tormach\\_1100mx, 1.5 kW", \
  d using 2:($1==0?$3:1/0) with linespoints ls 5 title "small\\_router, 1.5 kW at 24000 1/min"
