/* bench.png: time per grain and step against the number of grains, drawn by gnuplot. */
#ifndef OZ_STUDY_BENCH_PLOT_H
#define OZ_STUDY_BENCH_PLOT_H

#include "study/bench_row.h"

/* Draws rows into path; title names the device. Without gnuplot a line in the log says so, and
 * there is no picture. Fails with OZ_ERR_FILE when gnuplot does. */
OzStatus oz_bench_plot_draw(const char *path, const char *title, const OzBenchRow *rows, int count);

#endif
