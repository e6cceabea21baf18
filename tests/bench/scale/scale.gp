# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot scale.gp, in this folder: draws scale.svg from the table of SCALE.md.
set terminal svg size 640,360 font "sans-serif,13" background "white"
set output "scale.svg"
set logscale x 2
set xrange [32:20480]
set yrange [0.9:1]
set xtics (64, 256, 1024, 4096, 10240)
set xlabel "ranks"
set ylabel "efficiency"
set grid
set key left bottom
table = "< grep '^| [0-9]' SCALE.md"
set datafile separator "|"
plot table using 2:($3 == 60 ? $7 : NaN) with linespoints pt 7 title "60 s of work for each rank", \
     table using 2:($3 == 600 ? $7 : NaN) with points pt 9 ps 1.5 title "600 s"
