# What exact arithmetic buys: gnuplot -e "folder='build/bench'; out='docs/images'" docs/plots/arithmetic.gp
set terminal pngcairo size 1000,460 font "sans,11" background "#ffffff"
set output out."/arithmetic.png"
set title "Pixels off by more than 1/255 of the exact picture, one ray per pixel"
set datafile separator ","
set datafile columnheaders
data = folder."/arithmetic.csv"
set style data histogram
set style histogram clustered gap 1
set style fill solid 0.9 noborder
set boxwidth 0.9
set logscale y
set format y "%g %%"
set yrange [0.001:100]
set xtics rotate by 25 right nomirror noenhanced
set ytics nomirror
set grid ytics lt 1 lw 0.6 lc "#dddddd"
set border 3 lc "#666666"
set key at graph 0.235,0.98 left Left reverse samplen 1.5

# Six rows for each scene: textbook and exact in float, both in double, packets in both. None is drawn as nothing.
row(n) = data." every 6::".n
share = '(100.0 * column("pixels_off") / (column("columns") * column("rows")))'
plot data every 6::0 using @share:xtic(strcol("scene")) lc "#c05621" title "plain/textbook/float", \
     data every 6::2 using @share lc "#f0b37e" title "plain/textbook/double", \
     data every 6::1 using @share lc "#2b6cb0" title "plain/exact/float", \
     data every 6::4 using @share lc "#2f855a" title "packet/exact/float"
