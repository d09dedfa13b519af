/* Talking to gnuplot. */
#include "bench/bench_plot.h"

#include "base/gnuplot.h"

#include <math.h>
#include <string.h>

#define PICTURE "bench.png"

/* The rows of one curve: equal in bed, number format and threads. */
static bool same_curve(const OzBenchRow *a, const OzBenchRow *b)
{
    static const int keys[] = {OZ_BENCH_BITS, OZ_BENCH_THREADS};
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++) {
        double x = a->value[keys[k]], y = b->value[keys[k]];
        if (x != y && !(isnan(x) && isnan(y))) {
            return false;
        }
    }
    return strcmp(a->bed, b->bed) == 0;
}

static bool begins_curve(const OzBenchRow *rows, int row)
{
    for (int before = 0; before < row; before++) {
        if (same_curve(&rows[before], &rows[row])) {
            return false;
        }
    }
    return isfinite(rows[row].value[OZ_BENCH_NS_GRAIN]);
}

static void send_points(const OzBenchRow *rows, int count, int first, FILE *gnuplot)
{
    for (int r = first; r < count; r++) {
        if (same_curve(&rows[first], &rows[r])) {
            fprintf(gnuplot, "%.9g %.9g\n", rows[r].value[OZ_BENCH_GRAINS],
                    rows[r].value[OZ_BENCH_NS_GRAIN]);
        }
    }
    fprintf(gnuplot, "e\n");
}

/* The range of a column with a margin, as gnuplot's [low:high]. */
static void send_range(FILE *gnuplot, char axis, const OzBenchRow *rows, int count, int column)
{
    double low = INFINITY, high = -INFINITY;
    for (int r = 0; r < count; r++) {
        low = fmin(low, rows[r].value[column]);
        high = fmax(high, rows[r].value[column]);
    }
    fprintf(gnuplot, "set %crange [%.9g:%.9g]\n", axis, 0.7 * low, 1.4 * high);
}

/* Numbers at 1, 2 and 5 of each decade: a range of less than one would have but one otherwise. */
static void send_tics(FILE *gnuplot)
{
    fprintf(gnuplot, "set ytics (0.001");
    for (int decade = -3; decade <= 6; decade++) {
        fprintf(gnuplot, ", 1e%d, 2e%d, 5e%d", decade, decade, decade);
    }
    fprintf(gnuplot, ")\n");
}

static void send_axes(FILE *gnuplot, const char *folder, const char *title, const OzBenchRow *rows,
                      int count)
{
    fprintf(gnuplot,
            "set terminal pngcairo size 1200,700 noenhanced font 'DejaVu Sans,11'\n"
            "set output '%s/" PICTURE "'\nset title '%s'\nset logscale xy\n"
            "set grid\n"
            "set xlabel 'grains'\nset ylabel 'ns per grain and step'\n"
            "set format x '%%.0f'\nset format y '%%g'\nset key outside right top\n",
            folder, title);
    send_tics(gnuplot);
    send_range(gnuplot, 'x', rows, count, OZ_BENCH_GRAINS);
    send_range(gnuplot, 'y', rows, count, OZ_BENCH_NS_GRAIN);
}

static void send_plot(FILE *gnuplot, const OzBenchRow *rows, int count)
{
    static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9",
                                          "#e69f00", "#000000", "#8c564b", "#7f7f7f", "#9467bd"};
    char name[128];
    int curve = 0;
    for (int r = 0; r < count; r++) {
        if (begins_curve(rows, r)) {
            oz_bench_row_describe(&rows[r], name, sizeof name);
            fprintf(gnuplot,
                    "%s'-' with linespoints lw 2 ps 1.4 lc rgb '%s' pt %d dt %d title '%s'",
                    curve ? ", " : "plot ", colours[curve % 10], 4 + curve % 10,
                    rows[r].value[OZ_BENCH_BITS] > 32 ? 2 : 1, name);
            curve++;
        }
    }
    fprintf(gnuplot, "\n");
    for (int r = 0; r < count; r++) {
        if (begins_curve(rows, r)) {
            send_points(rows, count, r, gnuplot);
        }
    }
}

OzStatus oz_bench_plot_draw(const char *folder, const char *title, const OzBenchRow *rows,
                            int count)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_gnuplot_open(&gnuplot, folder, PICTURE));
    if (!gnuplot) {
        return OZ_OK;
    }
    send_axes(gnuplot, folder, title, rows, count);
    send_plot(gnuplot, rows, count);
    return oz_gnuplot_close(gnuplot, folder, PICTURE);
}
