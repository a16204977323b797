# Draws error against speed from the output of precision_bench, whose cases take turns there, since
# the machine's speed drifts. In the project's folder:
#   build-test/bench/precision_bench --benchmark_min_time=0.05 --benchmark_repetitions=12 \
#     --benchmark_enable_random_interleaving=true --benchmark_report_aggregates_only=true \
#     --benchmark_out=precision.csv --benchmark_out_format=csv
#   gnuplot -e "input='precision.csv'; output_file='.readme/precision.png'" bench/precision.gp
set terminal pngcairo size 960,600 font "Sans,15" linewidth 1.6
set output output_file
set datafile separator comma
set datafile missing NaN
set logscale xy
set format xy "10^{%L}"
set xlabel "periods of single points per second, all cores"
set ylabel "greatest relative error of a section"
set xrange [1e4:2e7]
set yrange [1e-12:1e-1]
set grid linecolor "gray85"
set key bottom right samplen 2 spacing 1.3
# The repetition in which the machine did least beside.
table = "< grep -E '^name,|_fastest' '" . input . "'"
# Random interleaving gives rows in any order; `smooth unique` puts them in that of the speed.
# The error in the rows whose name starts so; nothing in the others.
error(name) = strstrt(strcol("name"), name) == 1 ? column("max_error") : NaN
plot table using "periods/s":(error("rk4/fp64/events")) smooth unique with linespoints \
       linecolor "#0060ad" pointtype 7 \
       title "fp64", \
     table using "periods/s":(error("rk4/fp64/plain")) smooth unique with linespoints \
       linecolor "#0060ad" dashtype 2 pointtype 6 \
       title "fp64, no events", \
     table using "periods/s":(error("rk4/fp32/events")) smooth unique with linespoints \
       linecolor "#dd181f" pointtype 5 \
       title "fp32", \
     table using "periods/s":(error("rk4/fp32/plain")) smooth unique with linespoints \
       linecolor "#dd181f" dashtype 2 pointtype 4 \
       title "fp32, no events", \
     table using "periods/s":(error("dopri5")) smooth unique with linespoints \
       linecolor "gray30" pointtype 9 \
       title "odeint, dopri5"
