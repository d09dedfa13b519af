/* The words that gnuplot gets. It reads the figure's own table and nothing else. */
#include "figures/curves.h"

#include "base/file.h"
#include "figures/curves_data.h"

#include <stdlib.h>
#include <string.h>

/* Pixels: of a figure with one panel, of each of several, and of the caption's line below. */
enum { WIDTH = 900, HEIGHT = 600, PANEL_WIDTH = 420, PANEL_HEIGHT = 330, CAPTION_HEIGHT = 40 };

/* Which runs and columns stand in one panel. */
typedef struct Panel {
    int first_run, run_count, first_column, column_count;
    const char *title; /* NULL: none */
} Panel;

typedef struct Curves {
    const OzFigureWork *work;
    const OzStudyFigure *figure;
    char *table, *inset_table; /* paths of their numbers */
    bool has_spread, inset_has_spread;
    int panel_count, across; /* panels; in a row */
} Curves;

static const char *run_label(const Curves *curves, const char *name)
{
    const OzStudyRun *run = oz_figure_work_run(curves->work, name);
    return run->label ? run->label : run->name;
}

static const char *column_label(const OzStudyFigure *figure, int i)
{
    return i < figure->labels.count ? figure->labels.items[i] : figure->columns.items[i];
}

static int count_panels(const OzStudyFigure *figure)
{
    return !figure->panels                       ? 1
           : strcmp(figure->panels, "runs") == 0 ? figure->runs.count
                                                 : figure->columns.count;
}

static Panel panel_of(const Curves *curves, int i)
{
    const OzStudyFigure *figure = curves->figure;
    Panel panel = {0, figure->runs.count, 0, figure->columns.count, NULL};
    if (figure->panels && strcmp(figure->panels, "runs") == 0) {
        panel.first_run = i;
        panel.run_count = 1;
        panel.title = run_label(curves, figure->runs.items[i]);
    } else if (figure->panels) {
        panel.first_column = i;
        panel.column_count = 1;
        panel.title = column_label(figure, i);
    }
    return panel;
}

static void send_range(FILE *gnuplot, const char *axis, const OzNumbers *range)
{
    if (range->count == 2) {
        fprintf(gnuplot, "set %srange [%.9g:%.9g]\n", axis, range->items[0], range->items[1]);
    }
}

static void send_label(FILE *gnuplot, const char *axis, const char *text)
{
    fprintf(gnuplot, "set %slabel ", axis);
    oz_figure_work_text(gnuplot, text ? text : "");
    fputc('\n', gnuplot);
}

static void send_axes(const Curves *curves, FILE *gnuplot)
{
    const OzStudyFigure *figure = curves->figure;
    send_label(gnuplot, "x", figure->x_label ? figure->x_label : figure->against);
    send_label(gnuplot, "y", figure->y_label);
    fprintf(gnuplot, "%s logscale x\n", figure->x_log ? "set" : "unset");
    send_range(gnuplot, "x", &figure->x_range);
    send_range(gnuplot, "y", &figure->y_range);
    fprintf(gnuplot, "set key %s\n", figure->key ? figure->key : "left top");
}

/* x of the rows of one run, nothing of the others. */
static void send_table(FILE *gnuplot, const char *table, const char *run, const char *against)
{
    oz_figure_work_text(gnuplot, table);
    fputs(" using (strcol('run') eq ", gnuplot);
    oz_figure_work_text(gnuplot, run);
    fprintf(gnuplot, " ? column('%s') : NaN):", against);
}

/* The spread to either side of the mean. */
static void send_band(FILE *gnuplot, const char *table, const char *run, const char *against,
                      const char *column, int colour)
{
    send_table(gnuplot, table, run, against);
    fprintf(gnuplot,
            "(column('%s') - column('%s_spread')):(column('%s') + column('%s_spread')) with "
            "filledcurves fs transparent solid 0.18 noborder lc %d notitle, ",
            column, column, column, column, colour);
}

static void send_line(FILE *gnuplot, const char *table, const char *run, const char *against,
                      const char *column, int colour)
{
    send_table(gnuplot, table, run, against);
    fprintf(gnuplot, "(column('%s')) with lines lw 1.5 lc %d ", column, colour);
}

static void send_panel(const Curves *curves, FILE *gnuplot, int i)
{
    const OzStudyFigure *figure = curves->figure;
    Panel panel = panel_of(curves, i);
    fputs("set title ", gnuplot);
    oz_figure_work_text(gnuplot, panel.title ? panel.title : "");
    fputs("\nplot ", gnuplot);
    for (int pass = curves->has_spread ? 0 : 1; pass < 2; pass++) {
        int colour = 1;
        for (int r = panel.first_run; r < panel.first_run + panel.run_count; r++) {
            for (int c = panel.first_column; c < panel.first_column + panel.column_count; c++) {
                const char *run = figure->runs.items[r], *column = figure->columns.items[c];
                (pass ? send_line : send_band)(gnuplot, curves->table, run, figure->against, column,
                                               colour++);
                if (pass) {
                    fputs("title ", gnuplot);
                    oz_figure_work_text(gnuplot, panel.column_count > 1 ? column_label(figure, c)
                                                                        : run_label(curves, run));
                    fputs(", ", gnuplot);
                }
            }
        }
    }
    fputs("NaN notitle\n", gnuplot);
}

/* A small plot in the panel's empty lower right, on linear axes of its own. */
static void send_inset(const Curves *curves, FILE *gnuplot)
{
    const OzStudyFigure *figure = curves->figure;
    const char *run = figure->inset_run.items[0];
    fputs("set size 0.42,0.4\nset origin 0.55,0.13\nunset title\nset autoscale\nunset logscale\n"
          "set xlabel offset 0,0.7 font ',9'\nset ylabel '' \nset tics font ',8'\nset xtics auto\n"
          "set key top left font ',8' samplen 1\nunset grid\n"
          "set object 1 rectangle from graph -0.16,-0.22 to graph 1.02,1.03 behind fc rgb 'white' "
          "fs solid noborder\n",
          gnuplot);
    send_label(gnuplot, "x", run_label(curves, run));
    send_range(gnuplot, "x", &figure->inset_range);
    fputs("plot ", gnuplot);
    for (int c = 0; c < figure->inset_columns.count; c++) {
        const char *column = figure->inset_columns.items[c];
        send_line(gnuplot, curves->inset_table, run, figure->against, column, c + 1);
        fputs("title ", gnuplot);
        oz_figure_work_text(gnuplot, column);
        fputs(c + 1 < figure->inset_columns.count ? ", " : "\n", gnuplot);
    }
}

static void send_caption(const Curves *curves, FILE *gnuplot)
{
    char text[OZ_FIGURE_CAPTION + 64];
    snprintf(text, sizeof text, "%s%s", curves->work->caption,
             curves->has_spread ? "; bands: standard deviation of the seeds" : "");
    fputs("set label 1 ", gnuplot);
    oz_figure_work_text(gnuplot, text);
    fputs(" at screen 0.5,0.012 center font ',8' tc rgb '#555555'\n", gnuplot);
}

static void send_all(const Curves *curves, FILE *gnuplot)
{
    const OzStudyFigure *figure = curves->figure;
    int rows = (curves->panel_count + curves->across - 1) / curves->across;
    fprintf(gnuplot,
            "set datafile columnheaders\nset style data lines\nset grid lc rgb '#dddddd'\n"
            "set multiplot layout %d,%d margins screen %g,%g,%g,%g spacing screen %g,%g title ",
            rows, curves->across, curves->across > 1 ? 0.06 : 0.1, 0.97, rows > 1 ? 0.1 : 0.13,
            rows > 1 ? 0.9 : 0.91, 0.06, 0.12);
    oz_figure_work_text(gnuplot, figure->title ? figure->title : figure->name);
    fputc('\n', gnuplot);
    send_axes(curves, gnuplot);
    send_caption(curves, gnuplot);
    for (int i = 0; i < curves->panel_count; i++) {
        send_panel(curves, gnuplot, i);
    }
    if (figure->inset_run.count && figure->inset_columns.count) {
        fputs("unset label 1\n", gnuplot);
        send_inset(curves, gnuplot);
    }
    fputs("unset multiplot\n", gnuplot);
}

static OzStatus draw(const Curves *curves, const char *ending)
{
    FILE *gnuplot = NULL;
    int rows = (curves->panel_count + curves->across - 1) / curves->across;
    bool one = curves->panel_count == 1;
    int width = one ? WIDTH : curves->across * PANEL_WIDTH;
    int height = CAPTION_HEIGHT + (one ? HEIGHT : rows * PANEL_HEIGHT);
    OZ_PASS(oz_figure_work_open(curves->work, ending, width, height, &gnuplot));
    if (gnuplot) {
        send_all(curves, gnuplot);
    }
    return oz_figure_work_close(curves->work, ending, gnuplot);
}

/* Writes a table and keeps its path. */
static OzStatus write_table(Curves *curves, const char *ending, const OzTexts *runs,
                            const OzTexts *columns, bool *has_spread, char **path)
{
    OzStatus status = OZ_OK;
    char *name = NULL;
    if (asprintf(&name, "%s%s.csv", curves->figure->name, ending) < 0) {
        name = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a name");
    }
    OZ_TRY(oz_file_join(path, curves->work->folder, name));
    OZ_TRY(oz_curves_data_write(curves->work, name, runs, columns, has_spread));
done:
    free(name);
    return status;
}

OzStatus oz_curves_draw(const OzFigureWork *work)
{
    static const char *const endings[] = {"png", "svg", "pdf"};
    OzStatus status = OZ_OK;
    const OzStudyFigure *figure = work->figure;
    Curves curves = {.work = work, .figure = figure, .panel_count = count_panels(figure)};
    curves.across = curves.panel_count == 1 ? 1 : curves.panel_count <= 4 ? 2 : 3;
    OZ_TRY(write_table(&curves, "", &figure->runs, &figure->columns, &curves.has_spread,
                       &curves.table));
    if (figure->inset_run.count && figure->inset_columns.count) {
        OZ_TRY(write_table(&curves, "_inset", &figure->inset_run, &figure->inset_columns,
                           &curves.inset_has_spread, &curves.inset_table));
    }
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        OZ_TRY(draw(&curves, endings[i]));
    }
done:
    free(curves.table);
    free(curves.inset_table);
    return status;
}
