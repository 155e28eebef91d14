# A whole process against faces: gnuplot -e "folder='build/bench'; out='docs/images'" docs/plots/process.gp
set terminal pngcairo size 900,480 font "sans,11" background "#ffffff"
set output out."/bench-process.png"
set title "From the file of a city to its picture, 1920 x 1080, warm"
set logscale xy
set xrange [8:1.5e7]
set xlabel "faces"
set ylabel "milliseconds"
set format x "10^{%L}"
set grid lc "#dddddd"
set border 3 lc "#666666"
set tics nomirror
set key top left
data = folder."/process.dat"
plot data using 2:7 with linespoints lw 2 pt 7 lc "#2b6cb0" title "the process", \
     data using 2:3 with linespoints lw 1.5 dt 2 pt 6 lc "#d08a2e" title "reading", \
     data using 2:4 with linespoints lw 1.5 dt 2 pt 6 lc "#2f855a" title "building", \
     data using 2:5 with linespoints lw 1.5 dt 2 pt 6 lc "#805ad5" title "uploading", \
     data using 2:6 with linespoints lw 1.5 dt 2 pt 6 lc "#718096" title "tracing"
