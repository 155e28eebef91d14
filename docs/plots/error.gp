# Time against error of one scene: gnuplot -e "folder='build/bench'; out='docs/images'; scene='gallery'" docs/plots/error.gp
data = folder."/error-".scene.".csv"
set datafile separator ","
set datafile missing NaN # a line goes on over what it leaves out
set logscale xy
set xlabel "milliseconds to trace one picture"
set ylabel "RMSE against the truth (colours from 0 to 1)"
set format "10^{%L}"
set border 3 lc "#666666"
set tics nomirror
set key below Left reverse samplen 2 spacing 1.3 width -3 maxcols 3
set title scene.": what more time buys; the numbers are N of N x N rays per pixel"

# Columns: 5 series, 9 grid, 10 bounces, 8 accel, 12 ms, 13 RMSE, 20 on the front, 22 the truth's own error.
is(series) = strcol(5) eq series
plain(dummy) = is("float") || is("double") || is("reference")
stats data using 22 skip 1 nooutput
truth = STATS_max > 1e-9 ? STATS_max : 1e-9
bytes = 1 / 255.0 / sqrt(12) # what rounding to bytes alone makes
stats data using 13 skip 1 nooutput
set yrange [truth / 2:1.5 * STATS_max]
set offsets graph 0, graph 0.06, graph 0, graph 0
set grid xtics ytics lt 1 lw 0.6 lc "#e4e4e4"

do for [kind in "png svg"] {
    if (kind eq "png") {
        set terminal pngcairo size 1000,700 font "sans,11" background "#ffffff"
    } else {
        set terminal svg size 1000,700 font "sans,13" background "#ffffff"
    }
    set output out."/error-".scene.".".kind
    plot bytes with lines dt 2 lw 1.2 lc "#999999" title "what 8 bits can show", \
         truth with lines dt 3 lw 1.5 lc "#999999" title "error of the truth itself", \
         data using (strcol(20) eq "1" ? $12 : NaN):13 skip 1 smooth unique with lines lw 11 lc "#f6cfcf" \
             title "Pareto front: nothing is both faster and closer", \
         data using (is("reference") ? $12 : NaN):13 skip 1 with linespoints lw 1.5 pt 4 ps 1 lc "#8a8a8a" \
             title "reference", \
         data using (is("double") ? $12 : NaN):13 skip 1 with linespoints lw 1.5 pt 6 ps 1 lc "#d08a2e" \
             title "OpenCL, double", \
         data using (is("float") ? $12 : NaN):13 skip 1 with linespoints lw 2 pt 7 ps 1 lc "#2b6cb0" \
             title "OpenCL, float", \
         data using (is("bounces") ? $12 : NaN):13 skip 1 with points pt 2 ps 1 lw 1.5 lc "#9b2c6b" \
             title "float, 4 x 4, at most so many bounces", \
         data using (is("accel") ? $12 : NaN):13 skip 1 with points pt 1 ps 1.2 lw 1.5 lc "#2f855a" \
             title "float, 4 x 4, that way to find faces", \
         data using (plain(0) ? $12 : NaN):13:9 skip 1 with labels left offset 0.6,0.6 font ",9" tc "#444444" notitle, \
         data using (is("bounces") ? $12 : NaN):13:10 skip 1 with labels right offset -0.7,-0.5 font ",9" \
             tc "#9b2c6b" notitle, \
         data using (is("accel") ? $12 : NaN):13:(strcol(8)) skip 1 with labels left offset 0.5,0.7 font ",9" \
             tc "#2f855a" notitle
}
