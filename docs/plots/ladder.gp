# The ladder as bars: gnuplot -e "folder='build/bench'; out='docs/images'" docs/plots/ladder.gp
set terminal pngcairo size 900,480 font "sans,11" background "#ffffff"
set output out."/bench-ladder.png"
set title "Tracing one picture, 1920 x 1080, milliseconds (less is better)"
set style data histograms
set style histogram clustered gap 1
set style fill solid 0.9 noborder
set boxwidth 0.9
set logscale y
set ytics ("1" 1, "2" 2, "5" 5, "10" 10, "20" 20, "50" 50, "100" 100, "200" 200, "500" 500, "1000" 1000)
set grid ytics lc "#dddddd"
set border 3 lc "#666666"
set xtics rotate by -30 nomirror
set ytics nomirror
set key outside top right horizontal
set tmargin 5
set yrange [1:*]
data = folder."/ladder.dat"
plot data using 3:xtic(1) title "rectray" lc "#2b6cb0", \
     data using ($4 > 0 ? $4 : 1/0) title "Embree 3.13.5, its best mode" lc "#d08a2e"
