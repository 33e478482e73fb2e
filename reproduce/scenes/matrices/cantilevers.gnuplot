# Draws the tips of the two cantilevers over the period, and the force of the 15 pairs along one edge, from the files that a
# run of cantilevers.toml writes to `folder`. Rows 225 and 315 of motion.mtx are the heights of the two tips' corners.
set terminal pngcairo size 760, 560 font "sans,10"
set output folder . "/cantilevers.png"
set datafile separator ","
set datafile commentschars "%"
set multiplot
set lmargin at screen 0.1
set rmargin at screen 0.87
set xrange [0:1]

set tmargin at screen 0.96
set bmargin at screen 0.58
set ylabel "Height of the tip (mm)"
set format x ""
rows = 540
instants = 128
set yrange [*:*]
plot folder . "/motion.mtx" every rows::225 using ($0 / instants):(1e3 * $1) with lines lw 2 lc rgb "#1f4e9c" \
       title "lower cantilever, driven", \
     "" every rows::315 using ($0 / instants):(1e3 * $1 + 0.01) with lines lw 2 lc rgb "#c2571a" \
       title "upper cantilever"

set tmargin at screen 0.52
set bmargin at screen 0.1
set format x
set xlabel "Time over the period"
set ylabel "Distance from the clamp (mm)"
set yrange [0:210]
set cblabel "Contact force (N)"
set cbrange [0:*]
set palette defined (0 "#fff3dc", 0.15 "#ffd28a", 0.5 "#d9571a", 1 "#5c1010")
unset key
plot folder . "/contacts.csv" using ($2 <= 15 && $4 > 0 ? $1 : NaN):(200.0 / 15 * $2):4 with points pt 5 ps 1.5 lc palette
unset multiplot
