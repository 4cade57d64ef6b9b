# Kienzle's law fitted to a table.
load plots."/style.gp"
set output out."/kienzle.svg"
set terminal svg size 760,520 dynamic font "Helvetica,12" background rgb "white"
d = data."/kienzle.dat"
array kc[13]
array mc[13]
stats d using (kc[int($1)+1]=$3, mc[int($1)+1]=$4) nooutput
set title "Kienzle's law fitted to a tool maker's table of face milling" font ",14"
set logscale xy
set xrange [0.085:0.75]
set yrange [250:3500]
set xtics (0.1,0.2,0.3,0.4,0.6)
set ytics (300,500,1000,2000,3000)
set xlabel "feed per tooth, mm"
set ylabel "specific cutting force, N/mm²"
set grid
set key outside right Left reverse samplen 2
name(i) = word("mild-steel medium hard-steel CrMo-730 CrMo-600 NiCrMo-940 austenitic hard-cast-iron grey-iron brass AlMg AlSi AlZnMgCu", i+1)
rows = "0 2 6 7 8 9 10 12"
plot for [k=1:words(rows)] kc[int(word(rows,k))+1]*x**(-mc[int(word(rows,k))+1]) with lines lw 1.5 lc k title name(int(word(rows,k))), \
  for [k=1:words(rows)] for [c=0:4] d every ::int(word(rows,k))::int(word(rows,k)) using (real(word("0.1 0.2 0.3 0.4 0.6",c+1))):(column(5+c)) with points pt 7 ps 0.5 lc k notitle
