# Time against faces: gnuplot -e "folder='build/bench'; out='docs/images'" docs/plots/scaling.gp
set terminal pngcairo size 900,480 font "sans,11" background "#ffffff"
set output out."/bench-scaling.png"
set title "A city of more and more boxes, 1920 x 1080"
set logscale xy
set xrange [8:1.5e6]
set xlabel "faces"
set ylabel "milliseconds"
set format x "10^{%L}"
set grid lc "#dddddd"
set border 3 lc "#666666"
set tics nomirror
set key top left
data = folder."/scaling.dat"
plot data using 2:3 with linespoints lw 2 pt 7 lc "#2b6cb0" title "rectray, trace", \
     data using 2:($4 > 0 ? $4 : 1/0) with linespoints lw 2 pt 7 lc "#d08a2e" title "Embree, trace", \
     data using 2:5 with linespoints lw 1.5 dt 2 pt 6 lc "#2b6cb0" title "rectray, build", \
     data using 2:($6 > 0 ? $6 : 1/0) with linespoints lw 1.5 dt 2 pt 6 lc "#d08a2e" title "Embree, build"
