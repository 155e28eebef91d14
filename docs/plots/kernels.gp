# The ladder of kernels: gnuplot -e "folder='build/bench'; out='docs/images'; scene='gallery'" docs/plots/kernels.gp
set terminal pngcairo size 900,440 font "sans,11" background "#ffffff"
set output out."/bench-kernels-".scene.".png"
set title scene.": one picture, milliseconds (less is better)"
set datafile separator "\t"
set datafile columnheaders
data = folder."/kernels-".scene.".tsv"
stats data using "trace_ms" nooutput
set logscale x
set xrange [0.5 * STATS_min:3 * STATS_max]
set yrange [*:*] reverse
set offsets 0, 0, 0.6, 0.6
set format x "%g"
set grid xtics lt 1 lw 0.6 lc "#dddddd"
set border 3 lc "#666666"
set tics nomirror
set style fill solid 0.9 noborder
unset key

# Grey the reference, orange the plain kernel, blue packets, green packets in classified tiles.
colour(x) = strcol("backend") eq "reference" ? 0x8a8a8a : strcol("kernel") eq "plain" ? 0xd08a2e : \
            column("tiles") > 0 ? 0x2f855a : 0x2b6cb0
text(ms) = ms < 10 ? sprintf("%.2f", ms) : sprintf("%.0f", ms)
plot data using "trace_ms":"row":(0.5 * STATS_min):"trace_ms":(column("row") - 0.4):(column("row") + 0.4):(colour(0)): \
         ytic(strcol("name")) with boxxyerror lc rgb variable, \
     data using "trace_ms":"row":(text(column("trace_ms"))) with labels left offset 0.5,0 font ",9" tc "#444444"
