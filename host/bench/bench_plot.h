/* bench.png: time per grain and step against the number of grains, drawn by gnuplot. */
#pragma once

#include "bench/bench_row.h"

/* Draws rows into bench.png of the folder; title names the device. Without gnuplot a line in the
 * log says so, and there is no picture. Fails with OZ_ERR_FILE when gnuplot does. */
OzStatus oz_bench_plot_draw(const char *folder, const char *title, const OzBenchRow *rows,
                            int count);
