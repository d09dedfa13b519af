/* From members.csv to points, and a line through them. */
#include "figures/swept.h"

#include "base/cells.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/student.h"
#include "observe/power_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 800, HEIGHT = 600, MOST_FITS = 2 };

/* All members of one value. */
typedef struct Point {
    double value, bar; /* bar: mean of the figure's `bars`, NAN without */
    OzMoments moments;
    int members;
} Point;

typedef struct Swept {
    const OzFigureWork *work;
    const OzStudyFigure *figure;
    OzCells members;
    const char *key; /* swept */
    Point *points;
    int count;
    OzPowerFit fits[MOST_FITS]; /* with the paper's exponent, and with a free one */
    bool is_free[MOST_FITS];
    int fit_count;
} Swept;

static OzStatus find_columns(Swept *swept, const char *path, int *value, int *column, int *bars)
{
    const OzStudyFigure *figure = swept->figure;
    const char *name = figure->columns.items[0];
    *value = oz_cells_find(&swept->members, "seed") + 1;
    *column = oz_cells_find(&swept->members, name);
    *bars = figure->bars ? oz_cells_find(&swept->members, figure->bars) : -1;
    if (*value >= swept->members.column_count ||
        strcmp(swept->members.cells[*value], "status") == 0) {
        return oz_status_fail(OZ_ERR_INPUT, "%s is of no sweep; expected a run of a scene with one",
                              path);
    }
    swept->key = swept->members.cells[*value];
    if (*column < 0 || (figure->bars && *bars < 0)) {
        return oz_status_fail(OZ_ERR_INPUT, "%s has no column %s; expected one of its first line",
                              path, *column < 0 ? name : figure->bars);
    }
    return OZ_OK;
}

/* Members of one value stand one after the other. */
static OzStatus gather_points(Swept *swept, int value, int column, int bars)
{
    const OzCells *table = &swept->members;
    double *values = NULL;
    OZ_PASS(OZ_NEW(&values, table->row_count));
    OzStatus status = OZ_NEW(&swept->points, table->row_count);
    for (int64_t row = 0; row < table->row_count && status == OZ_OK;) {
        Point *point = &swept->points[swept->count++];
        *point = (Point){.value = oz_cells_number(table, row, value)};
        double sum = 0;
        for (; row < table->row_count && oz_cells_number(table, row, value) == point->value;
             row++) {
            values[point->members++] = oz_cells_number(table, row, column);
            sum += bars < 0 ? NAN : oz_cells_number(table, row, bars);
        }
        if (point->members == 0) {
            status =
                oz_status_fail(OZ_ERR_INPUT, "members.csv: a value of %s is no number", swept->key);
        }
        point->moments = oz_student_moments(values, point->members);
        point->bar = sum / point->members;
    }
    free(values);
    return status;
}

static OzStatus read_points(Swept *swept)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    int value = 0, column = 0, bars = 0;
    const OzStudyRun *run = oz_figure_work_run(swept->work, swept->figure->runs.items[0]);
    OZ_TRY(oz_study_runs_path(&path, run, swept->work->folder, "members.csv"));
    OZ_TRY(oz_cells_read(&swept->members, path));
    OZ_TRY(find_columns(swept, path, &value, &column, &bars));
    OZ_TRY(gather_points(swept, value, column, bars));
done:
    free(path);
    return status;
}

/* y = constant + factor x^exponent with this exponent, by least squares. */
static OzPowerFit fit_line(const double *x, const double *y, int count, double exponent)
{
    double mean_u = 0, mean_y = 0, uu = 0, uy = 0, squares = 0;
    for (int i = 0; i < count; i++) {
        mean_u += pow(x[i], exponent) / count;
        mean_y += y[i] / count;
    }
    for (int i = 0; i < count; i++) {
        double u = pow(x[i], exponent) - mean_u;
        uu += u * u;
        uy += u * (y[i] - mean_y);
    }
    OzPowerFit fit = {.exponent = exponent, .exponent_low = exponent, .exponent_high = exponent};
    fit.factor = uy / uu;
    fit.constant = mean_y - fit.factor * mean_u;
    for (int i = 0; i < count; i++) {
        double off = y[i] - fit.constant - fit.factor * pow(x[i], exponent);
        squares += off * off;
    }
    fit.residual = sqrt(squares / count);
    return fit;
}

static OzStatus find_fits(Swept *swept)
{
    double *x = NULL, *y = NULL;
    int count = 0;
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(&x, swept->count));
    OZ_TRY(OZ_NEW(&y, swept->count));
    for (int i = 0; i < swept->count; i++) {
        if (isfinite(swept->points[i].moments.mean)) {
            x[count] = fabs(swept->points[i].value);
            y[count++] = swept->points[i].moments.mean;
        }
    }
    if (swept->figure->power.count && count >= 3) {
        swept->fits[swept->fit_count++] = fit_line(x, y, count, swept->figure->power.items[0]);
    }
    if (oz_power_fit_find(&swept->fits[swept->fit_count], x, y, count)) {
        swept->is_free[swept->fit_count++] = true;
    }
done:
    free(x);
    free(y);
    return status;
}

/* A cell; none for what is not known. */
static void write_number(FILE *file, double value)
{
    if (isfinite(value)) {
        fprintf(file, ",%.9g", value);
    } else {
        fputc(',', file);
    }
}

static OzStatus write_points(const Swept *swept, const char *name)
{
    FILE *file = NULL;
    const char *column = swept->figure->columns.items[0];
    OZ_PASS(oz_folder_create_file(&file, swept->work->folder, name));
    fprintf(file, "%s,members,%s,%s_spread,%s_ci95,bar\n", swept->key, column, column, column);
    for (int i = 0; i < swept->count; i++) {
        const Point *point = &swept->points[i];
        fprintf(file, "%.9g,%d", point->value, point->members);
        write_number(file, point->moments.mean);
        write_number(file, point->moments.spread);
        write_number(file, point->moments.interval);
        write_number(file, point->bar);
        fputc('\n', file);
    }
    return oz_folder_finish_file(file, name);
}

static OzStatus write_fits(const Swept *swept, const char *name)
{
    FILE *file = NULL;
    OZ_PASS(oz_folder_create_file(&file, swept->work->folder, name));
    fputs("exponent,exponent_low,exponent_high,constant,factor,residual\n", file);
    for (int i = 0; i < swept->fit_count; i++) {
        const OzPowerFit *fit = &swept->fits[i];
        fprintf(file, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", fit->exponent, fit->exponent_low,
                fit->exponent_high, fit->constant, fit->factor, fit->residual);
        oz_log_line("%s: %.4g + %.4g x^%.3g%s, residual %.3g", swept->figure->name, fit->constant,
                    fit->factor, fit->exponent, swept->is_free[i] ? ", exponent free" : "",
                    fit->residual);
    }
    return oz_folder_finish_file(file, name);
}

static OzStatus write_tables(const Swept *swept, char **path)
{
    OzStatus status = OZ_OK;
    char *name = NULL, *fit = NULL;
    if (asprintf(&name, "%s.csv", swept->figure->name) < 0 ||
        asprintf(&fit, "%s_fit.csv", swept->figure->name) < 0 ||
        asprintf(path, "%s/%s", swept->work->folder, name) < 0) {
        *path = NULL;
        status = oz_status_fail(OZ_ERR_MEMORY, "out of memory for a name");
        goto done;
    }
    OZ_TRY(write_points(swept, name));
    OZ_TRY(write_fits(swept, fit));
done:
    free(name);
    free(fit);
    return status;
}

static void send_axes(const Swept *swept, FILE *gnuplot)
{
    const OzStudyFigure *figure = swept->figure;
    fputs("set title ", gnuplot);
    oz_figure_work_text(gnuplot, figure->title ? figure->title : figure->name);
    fputs("\nset xlabel ", gnuplot);
    oz_figure_work_text(gnuplot, figure->x_label ? figure->x_label : swept->key);
    fputs("\nset ylabel ", gnuplot);
    oz_figure_work_text(gnuplot, figure->y_label ? figure->y_label : figure->columns.items[0]);
    fprintf(gnuplot, "\n%s\nset offsets graph 0.05, graph 0.05, graph 0.05, 0\n",
            figure->x_log ? "set logscale x" : "");
    oz_figure_work_key(gnuplot, figure->key);
    oz_figure_work_range(gnuplot, "x", &figure->x_range);
    oz_figure_work_range(gnuplot, "y", &figure->y_range);
    oz_figure_work_send_caption(swept->work, gnuplot, "");
}

static void send_points(const Swept *swept, FILE *gnuplot, const char *path)
{
    const OzStudyFigure *figure = swept->figure;
    const char *column = figure->columns.items[0];
    if (figure->bars) {
        oz_figure_work_text(gnuplot, path);
        fprintf(gnuplot,
                " using 1:(column('%s')):(column('bar')) with yerrorbars lc rgb '#aaaaaa' "
                "pt -1 title ",
                column);
        oz_figure_work_text(gnuplot, figure->bars);
        fputs(", ", gnuplot);
    }
    if (swept->count > 0 && swept->points[0].members > 1) {
        oz_figure_work_text(gnuplot, path);
        fprintf(gnuplot,
                " using 1:(column('%s')):(column('%s_ci95')) with yerrorbars lc rgb '#0072b2' lw 2 "
                "pt -1 title '95 %% interval of the mean', ",
                column, column);
    }
    oz_figure_work_text(gnuplot, path);
    fprintf(gnuplot, " using 1:(column('%s')) with points pt 7 lc rgb '#0072b2' title ", column);
    oz_figure_work_text(gnuplot, column);
}

static void send_fits(const Swept *swept, FILE *gnuplot)
{
    for (int i = 0; i < swept->fit_count; i++) {
        const OzPowerFit *fit = &swept->fits[i];
        fprintf(gnuplot,
                ", %.9g + %.9g * abs(x)**%.9g with lines dt %d lc rgb '#d55e00' title '%.3g %+.3g "
                "x^%.2g%s'",
                fit->constant, fit->factor, fit->exponent, swept->is_free[i] ? 1 : 2, fit->constant,
                fit->factor, fit->exponent,
                swept->is_free[i] ? ", exponent free" : ", as in the paper");
    }
    fputc('\n', gnuplot);
}

static OzStatus draw(const Swept *swept, const char *path, const char *ending)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_figure_work_open(swept->work, ending, WIDTH, HEIGHT, &gnuplot));
    if (gnuplot) {
        fputs("set datafile columnheaders\nset bmargin 6\n", gnuplot);
        send_axes(swept, gnuplot);
        fputs("plot ", gnuplot);
        send_points(swept, gnuplot, path);
        send_fits(swept, gnuplot);
    }
    return oz_figure_work_close(swept->work, ending, gnuplot);
}

OzStatus oz_swept_draw(const OzFigureWork *work)
{
    static const char *const endings[] = {"png", "svg", "pdf"};
    OzStatus status = OZ_OK;
    Swept swept = {.work = work, .figure = work->figure};
    char *path = NULL;
    OZ_TRY(read_points(&swept));
    OZ_TRY(find_fits(&swept));
    OZ_TRY(write_tables(&swept, &path));
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        OZ_TRY(draw(&swept, path, endings[i]));
    }
done:
    oz_cells_free(&swept.members);
    free(swept.points);
    free(path);
    return status;
}
