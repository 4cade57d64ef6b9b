# Bores of plates as cases: each predicted from the others, with the interval that is stated.
load plots."/style.gp"
set output out."/plates.svg"
set terminal svg size 720,400 dynamic font "Helvetica,12" background rgb "white"
d = data."/plates_bores.dat"
set title "NIST plates: 4 mm bores, each plate left out" font ",14"
set xlabel "plate"
set ylabel "diameter less programmed, mm"
set xtics rotate by 0
set xrange [-0.6:13.6]
set key top left Left reverse samplen 1.5
plot d using 0:3:4:5:xticlabels(1) with yerrorbars lc rgb "#0072b2" pt 7 ps 0.6 title "predicted from the other plates, 90 %", \
  d using 0:6 with points ls 3 title "static bending, no cases", \
  d using 0:2 with points ls 2 title "measured"
