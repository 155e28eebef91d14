# Time against error of one scene: gnuplot -e "folder='build/bench'; out='docs/images'; scene='gallery'" docs/plots/error.gp
data = folder."/error-".scene.".csv"
set datafile separator ","
set datafile columnheaders
set datafile missing NaN # a line goes on over what it leaves out
set logscale xy
set xlabel "milliseconds to trace one picture"
set ylabel "RMSE against the truth (colours from 0 to 1)"
set format "10^{%L}"
set border 3 lc "#666666"
set tics nomirror
set grid xtics ytics lt 1 lw 0.6 lc "#e4e4e4"
set key below Left reverse samplen 2.5 spacing 1.3 width -3 maxcols 3
set title scene.": what more time buys; the numbers are N of N x N rays per pixel"

# Series by series, each a colour: backends and precisions, then what was tried with float and 4 x 4 rays.
is(series) = strcol("series") eq series
ms(series) = is(series) ? column("trace_ms") : NaN
lines = "with linespoints lw 1.6 ps 1"
dashes = "with linespoints lw 1.6 ps 1 dt 2"
numbers = "with labels left offset 0.6,0.6 font ',9' tc '#444444' notitle"
low_numbers = "with labels right offset -0.7,-0.5 font ',9'"

# Not every scene has mirrors, and gnuplot warns of what has no points.
bounces = 'data using (ms("bounces")):"rmse" with points pt 2 ps 1 lw 1.5 lc "#9b2c6b" \
    title "float, 4 x 4, at most so many bounces", \
    data using (ms("bounces")):"rmse":"bounces" @low_numbers tc "#9b2c6b" notitle,'
adaptive = 'data using (ms("adaptive reference")):"rmse" @dashes pt 8 lc "#8a8a8a" title "reference, adaptive up to N x N", \
    data using (ms("adaptive double")):"rmse" @dashes pt 8 lc "#d08a2e" title "OpenCL, double, adaptive", \
    data using (ms("adaptive")):"rmse" @dashes pt 9 lc "#2b6cb0" title "OpenCL, float, adaptive", \
    data using (ms("adaptive")):"rmse":"grid" @low_numbers tc "#2b6cb0" notitle,'
plain = 'data using (ms("plain")):"rmse" @lines pt 12 lc "#2f855a" title "plain, exact, float", \
    data using (ms("plain double")):"rmse" @dashes pt 12 lc "#2f855a" title "plain, exact, double", \
    data using (ms("textbook")):"rmse" @lines pt 10 lc "#c05621" title "plain, textbook, float", \
    data using (ms("textbook double")):"rmse" @dashes pt 10 lc "#c05621" title "plain, textbook, double",'
mirrors = 0
refined = 0
stats data using (mirrors = mirrors || is("bounces"), refined = refined || is("adaptive"), 1) nooutput
if (!mirrors) { bounces = "" }
if (!refined) { adaptive = "" }

stats data using "truth_error" nooutput
truth = STATS_max > 1e-9 ? STATS_max : 1e-9
bytes = 1 / 255.0 / sqrt(12) # what rounding to bytes alone makes
stats data using "rmse" nooutput
set yrange [truth / 2:1.5 * STATS_max]
set offsets graph 0, graph 0.06, graph 0, graph 0

do for [kind in "png svg"] {
    if (kind eq "png") {
        set terminal pngcairo size 1000,720 font "sans,11" background "#ffffff"
    } else {
        set terminal svg size 1000,720 font "sans,13" background "#ffffff"
    }
    set output out."/error-".scene.".".kind
    plot data using (strcol("on_front") eq "1" ? column("trace_ms") : NaN):"rmse" smooth unique with lines lw 11 \
             lc "#f6cfcf" title "Pareto front: nothing is both faster and closer", \
         bytes with lines dt 2 lw 1.2 lc "#999999" title "what 8 bits can show", \
         truth with lines dt 3 lw 1.5 lc "#999999" title "error of the truth itself", \
         data using (ms("reference")):"rmse" @lines pt 4 lc "#8a8a8a" title "reference", \
         data using (ms("double")):"rmse" @lines pt 6 lc "#d08a2e" title "OpenCL, double", \
         data using (ms("float")):"rmse" @lines pt 7 lc "#2b6cb0" title "OpenCL, float", \
         @plain \
         @adaptive \
         @bounces \
         data using (ms("accel")):"rmse" with points pt 1 ps 1.2 lw 1.5 lc "#2f855a" \
             title "float, 4 x 4, that way to find faces", \
         data using (ms("reference")):"rmse":"grid" @numbers, \
         data using (ms("double")):"rmse":"grid" @numbers, \
         data using (ms("float")):"rmse":"grid" @numbers, \
         data using (ms("accel")):"rmse":(strcol("accel")) with labels left offset 0.5,0.7 font ",9" tc "#2f855a" notitle
}
