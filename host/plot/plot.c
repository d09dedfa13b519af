/* Choosing columns and talking to gnuplot, which reads the tables itself. */
#include "plot/plot.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/gnuplot.h"
#include "base/log.h"
#include "observe/series.h"
#include "plot/plot_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PANEL_HEIGHT = 260, WIDTH = 900 };

/* What is drawn when no column is named, as far as there are values. */
static const char *const usual[] = {"density_tap_mean", "angle_tap_mean", "nematic_s",
                                    "contact_count",    "kinetic",        "contact_number",
                                    "outflow_count",    "inclination",    "bend_max"};

typedef struct Work {
    const char *folder, *out;
    char *path; /* of the table that is drawn */
    bool is_ensemble;
    OzPlotTable table, members;
    const char *columns[OZ_PLOT_COLUMNS];
    int count;
    const char *against;
} Work;

/* The column that holds a name's values: an ensemble's means. */
static int find_values(const Work *work, const char *name)
{
    char mean[OZ_COLUMN_NAME + 8];
    snprintf(mean, sizeof mean, "%s_mean", name);
    return oz_cells_find(&work->table.cells, work->is_ensemble ? mean : name);
}

static OzStatus add_column(Work *work, const char *name)
{
    int column = find_values(work, name);
    if (column < 0) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s has no column %s; expected one of its first line (`orzo keys "
                              "--columns` says what they are)",
                              work->path, name);
    }
    if (!work->table.has_value[column]) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: column %s is empty; `orzo check` says why",
                              work->path, name);
    }
    work->columns[work->count++] = name;
    return OZ_OK;
}

static OzStatus choose_usual(Work *work)
{
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) {
        int column = find_values(work, usual[i]);
        if (column >= 0 && work->table.has_value[column]) {
            OZ_PASS(add_column(work, usual[i]));
        }
    }
    return OZ_OK;
}

static OzStatus choose_columns(Work *work, const OzPlot *plot)
{
    for (int i = 0; i < plot->count; i++) {
        OZ_PASS(add_column(work, plot->columns[i]));
    }
    OZ_PASS(plot->columns ? OZ_OK : choose_usual(work));
    return work->count > 0 ? OZ_OK
                           : oz_status_fail(OZ_ERR_INPUT,
                                            "%s: none of the usual columns has a "
                                            "value; expected names of columns",
                                            work->path);
}

/* Along x: what was asked for, else taps where there are any. */
static OzStatus choose_against(Work *work, const char *asked)
{
    int tap = oz_cells_find(&work->table.cells, "tap");
    work->against = asked ? asked : tap >= 0 && work->table.has_value[tap] ? "tap" : "time";
    int column = oz_cells_find(&work->table.cells, work->against);
    return column >= 0 && work->table.has_value[column]
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INPUT,
                                "--against %s: %s has no such column with values; expected step, "
                                "time or tap",
                                work->against, work->path);
}

static OzStatus find_table(Work *work)
{
    OzStatus status = OZ_OK;
    char *ensemble = NULL;
    OZ_TRY(oz_file_join(&ensemble, work->folder, "ensemble.csv"));
    work->is_ensemble = oz_file_exists(ensemble);
    OZ_TRY(
        oz_file_join(&work->path, work->folder, work->is_ensemble ? "ensemble.csv" : "series.csv"));
done:
    free(ensemble);
    return status;
}

static OzStatus read_tables(Work *work)
{
    OzStatus status = OZ_OK;
    char *members = NULL;
    OZ_TRY(oz_file_join(&members, work->folder, "members.csv"));
    OZ_TRY(oz_plot_table_read(&work->table, work->path));
    if (work->is_ensemble) {
        OZ_TRY(oz_plot_table_read(&work->members, members));
    }
done:
    free(members);
    return status;
}

/* A text between quotes of gnuplot's. */
static void send_text(FILE *gnuplot, const char *text)
{
    fputc('\'', gnuplot);
    for (; *text; text++) {
        fputs(*text == '\'' ? "''" : (char[2]){*text}, gnuplot);
    }
    fputc('\'', gnuplot);
}

/* Whether a column of the list has that name; `wall<i>_f<x>` has wall0_fx. */
static bool has_name(const char *listed, const char *name)
{
    while (*listed && *name) {
        bool is_part = *listed == '<';
        size_t length = is_part ? strspn(name, "0123456789xyz") : *listed == *name;
        if (length == 0) {
            return false;
        }
        listed += is_part ? strcspn(listed, ">") + 1 : 1;
        name += length;
    }
    return *listed == *name;
}

static const char *unit_of(const char *name)
{
    const OzColumn *column = oz_series_columns();
    while (column->name && !has_name(column->name, name)) {
        column++;
    }
    return column->name && strcmp(column->unit, "1") != 0 ? column->unit : "";
}

static void send_label(FILE *gnuplot, const char *axis, const char *name)
{
    const char *unit = unit_of(name);
    fprintf(gnuplot, "set %s '%s%s%s'\n", axis, name, *unit ? ", " : "", unit);
}

/* Whether a member's curve lies there: not where it never began, nor where parts were gathered. */
static bool has_series(const char *folder)
{
    char *path = NULL;
    bool has = oz_file_join(&path, folder, "series.csv") == OZ_OK && oz_file_exists(path);
    free(path);
    return has;
}

/* Every member's own curve, thin and grey. */
static void send_members(const Work *work, FILE *gnuplot, const char *name)
{
    for (int i = 0; i < work->members.first_count; i++) {
        char *path = NULL;
        if (oz_file_join(&path, work->folder, work->members.first[i]) == OZ_OK &&
            has_series(path)) {
            send_text(gnuplot, path);
            fprintf(gnuplot,
                    ".'/series.csv' using '%s':'%s' with lines lw 0.5 lc rgb '#b0b0b0' notitle, ",
                    work->against, name);
        }
        free(path);
    }
}

/* The mean of one combination of a sweep, or (NULL) of all members, with its interval. */
static void send_mean(const Work *work, FILE *gnuplot, const char *name, const char *value, int i)
{
    const char *key = oz_cells_text(&work->table.cells, -1, 0);
    char only[512] = "";
    if (value) {
        snprintf(only, sizeof only, "stringcolumn(1) ne '%s' ? NaN : ", value);
    }
    send_text(gnuplot, work->path);
    fprintf(gnuplot,
            " using (%scolumn('%s')):(column('%s_mean') - column('%s_ci95')):(column('%s_mean') + "
            "column('%s_ci95')) with filledcurves fs transparent solid 0.2 lc %d notitle, ",
            only, work->against, name, name, name, name, i + 1);
    send_text(gnuplot, work->path);
    fprintf(gnuplot, " using (%scolumn('%s')):(column('%s_mean')) with lines lw 2 lc %d ", only,
            work->against, name, i + 1);
    if (value) {
        fprintf(gnuplot, "title '%s %s', ", key, value);
    } else {
        fputs("notitle, ", gnuplot);
    }
}

/* gnuplot finds a range for any curve but one that stays the same, of which it complains. */
static void send_range(const Work *work, FILE *gnuplot, const char *name)
{
    int column = oz_cells_find(&work->table.cells, name);
    double low = column < 0 ? NAN : work->table.low[column];
    double half = fmax(fabs(low) / 10, 1e-6);
    if (column >= 0 && low == work->table.high[column]) {
        fprintf(gnuplot, "set yrange [%.9g:%.9g]\n", low - half, low + half);
    } else {
        fputs("set yrange [*:*]\n", gnuplot);
    }
}

static void send_panel(const Work *work, FILE *gnuplot, const char *name)
{
    send_label(gnuplot, "ylabel", name);
    send_range(work, gnuplot, name);
    fputs("plot ", gnuplot);
    if (!work->is_ensemble) {
        send_text(gnuplot, work->path);
        fprintf(gnuplot, " using '%s':'%s' with lines lw 2 lc 1 notitle\n", work->against, name);
        return;
    }
    bool is_sweep = work->table.first_count > 0;
    send_members(work, gnuplot, name);
    for (int i = 0; is_sweep && i < work->table.first_count; i++) {
        send_mean(work, gnuplot, name, work->table.first[i], i);
    }
    if (!is_sweep) {
        send_mean(work, gnuplot, name, NULL, 0);
    }
    fputs("NaN notitle\n", gnuplot);
}

static OzStatus draw(const Work *work, const char *terminal, const char *picture)
{
    FILE *gnuplot = NULL;
    char *path = NULL;
    OZ_PASS(oz_folder_note(work->out, picture));
    OZ_PASS(oz_file_join(&path, work->out, picture));
    OzStatus status = oz_gnuplot_open(&gnuplot, work->out, picture);
    if (gnuplot) {
        fprintf(gnuplot, "set terminal %s size %d,%d noenhanced font 'DejaVu Sans,11'\nset output ",
                terminal, WIDTH, 60 + PANEL_HEIGHT * work->count);
        send_text(gnuplot, path);
        fprintf(gnuplot,
                "\nset datafile separator ','\nset datafile missing ''\nset lmargin 12\n"
                "set format y '%%.4g'\nset autoscale xfix\nset grid lc rgb '#dddddd'\n"
                "set multiplot layout %d,1 title ",
                work->count);
        send_text(gnuplot, work->folder);
        fputc('\n', gnuplot);
        send_label(gnuplot, "xlabel", work->against);
        for (int i = 0; i < work->count; i++) {
            send_panel(work, gnuplot, work->columns[i]);
        }
        fputs("unset multiplot\n", gnuplot);
        status = oz_gnuplot_close(gnuplot, work->out, picture);
    }
    if (status == OZ_OK && gnuplot) {
        oz_log_line("%s", path);
    }
    free(path);
    return status;
}

static void free_work(Work *work)
{
    oz_plot_table_free(&work->table);
    oz_plot_table_free(&work->members);
    free(work->path);
}

OzStatus oz_plot_draw(const OzPlot *plot)
{
    Work work = {.folder = plot->folder, .out = plot->out ? plot->out : plot->folder};
    OzStatus status = OZ_OK;
    OZ_TRY(find_table(&work));
    OZ_TRY(read_tables(&work));
    OZ_TRY(choose_against(&work, plot->against));
    OZ_TRY(choose_columns(&work, plot));
    OZ_TRY(oz_file_make_folder(work.out));
    OZ_TRY(draw(&work, "pngcairo", "plot.png"));
    OZ_TRY(draw(&work, "svg", "plot.svg"));
done:
    free_work(&work);
    return status;
}

OzStatus oz_plot_series(const char *folder)
{
    const int64_t rows_least = 3; /* of a curve */
    Work work = {.folder = folder, .out = folder};
    OzStatus status = OZ_OK;
    OZ_TRY(find_table(&work));
    if (!oz_file_exists(work.path)) {
        goto done;
    }
    OZ_TRY(read_tables(&work));
    OZ_TRY(choose_usual(&work));
    if (work.count > 0 && work.table.cells.row_count >= rows_least) {
        OZ_TRY(choose_against(&work, NULL));
        OZ_TRY(draw(&work, "pngcairo", "series.png"));
    }
done:
    free_work(&work);
    return status;
}
