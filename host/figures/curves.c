/* The words that gnuplot gets. It reads the figure's own table and nothing else. */
#include "figures/curves.h"

#include "base/file.h"
#include "figures/curves_data.h"

#include <stdlib.h>
#include <string.h>

/* Pixels: of a figure with one panel, of each of several; around them, room for labels and titles.
 */
enum {
    WIDTH = 900,
    HEIGHT = 640,
    PANEL_WIDTH = 400,
    PANEL_HEIGHT = 300,
    LEFT = 85,
    RIGHT = 25,
    TOP = 75,
    BOTTOM = 85,
    ACROSS = 105, /* between panels */
    DOWN = 90
};

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
    int width, height;       /* of all, pixels   */
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
    oz_figure_work_range(gnuplot, "x", &figure->x_range);
    oz_figure_work_range(gnuplot, "y", &figure->y_range);
    oz_figure_work_key(gnuplot, figure->key);
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

/* Later columns may be dashed, to be seen over earlier ones that they lie upon. */
static void send_line(FILE *gnuplot, const char *table, const char *run, const char *against,
                      const char *column, int colour, int dash)
{
    send_table(gnuplot, table, run, against);
    fprintf(gnuplot, "(column('%s')) with lines lw 1.5 lc %d dt %d ", column, colour, dash);
}

/* What tells a curve apart in its panel. */
static void send_title(const Curves *curves, FILE *gnuplot, const Panel *panel, int run, int column)
{
    char text[512];
    const char *of_run = run_label(curves, curves->figure->runs.items[run]);
    const char *of_column = column_label(curves->figure, column);
    snprintf(text, sizeof text, "%s%s%s",
             panel->run_count > 1 || panel->column_count == 1 ? of_run : "",
             panel->run_count > 1 && panel->column_count > 1 ? ", " : "",
             panel->column_count > 1 ? of_column : "");
    fputs("title ", gnuplot);
    oz_figure_work_text(gnuplot, text);
    fputs(", ", gnuplot);
}

/* All bands lie behind all lines. */
static void send_curves(const Curves *curves, FILE *gnuplot, const Panel *panel, bool bands)
{
    const OzStudyFigure *figure = curves->figure;
    int colour = 1;
    for (int r = panel->first_run; r < panel->first_run + panel->run_count; r++) {
        for (int c = panel->first_column; c < panel->first_column + panel->column_count; c++) {
            const char *run = figure->runs.items[r], *column = figure->columns.items[c];
            if (bands) {
                send_band(gnuplot, curves->table, run, figure->against, column, colour);
            } else {
                send_line(gnuplot, curves->table, run, figure->against, column, colour,
                          figure->dashes ? c - panel->first_column + 1 : 1);
                send_title(curves, gnuplot, panel, r, c);
            }
            colour++;
        }
    }
}

static void send_panel(const Curves *curves, FILE *gnuplot, int i)
{
    Panel panel = panel_of(curves, i);
    fputs("set title ", gnuplot);
    oz_figure_work_text(gnuplot, panel.title ? panel.title : "");
    fputs("\nplot ", gnuplot);
    if (curves->has_spread) {
        send_curves(curves, gnuplot, &panel, true);
    }
    send_curves(curves, gnuplot, &panel, false);
    fputs("NaN notitle\nunset key\n", gnuplot); /* panels are alike: one key will do */
}

/* A small plot in the panel's upper left, which curves that rise leave empty, on linear axes of its
 * own. */
static void send_inset(const Curves *curves, FILE *gnuplot)
{
    const OzStudyFigure *figure = curves->figure;
    const char *run = figure->inset_run.items[0];
    fputs("unset title\nunset label\nset autoscale\nset offsets 0,0,graph 0.3,0\nunset "
          "logscale\nunset grid\n"
          "set lmargin at screen 0.16\nset rmargin at screen 0.5\n"
          "set bmargin at screen 0.57\nset tmargin at screen 0.85\n"
          "set object 1 rectangle from screen 0.105,0.49 to screen 0.52,0.872 behind "
          "fc rgb 'white' fs solid noborder\n"
          "set xlabel offset 0,0.5 font ',9'\nset ylabel ''\nset tics font ',8'\n"
          "set key top right font ',8' samplen 1\n",
          gnuplot);
    send_label(gnuplot, "x", run_label(curves, run));
    oz_figure_work_range(gnuplot, "x", &figure->inset_range);
    fputs("plot ", gnuplot);
    for (int c = 0; c < figure->inset_columns.count; c++) {
        const char *column = figure->inset_columns.items[c];
        send_line(gnuplot, curves->inset_table, run, figure->against, column, c + 1, 1);
        fputs("title ", gnuplot);
        oz_figure_work_text(gnuplot, column);
        fputs(c + 1 < figure->inset_columns.count ? ", " : "\n", gnuplot);
    }
}

/* Told apart also by those who do not see all colours (Okabe & Ito 2008), without their yellow,
 * which is too light for a line. */
static void send_colours(FILE *gnuplot)
{
    static const char *const colours[] = {"#d55e00", "#009e73", "#0072b2", "#000000",
                                          "#cc79a7", "#e69f00", "#56b4e9", "#808080"};
    for (int i = 0; i < (int)(sizeof colours / sizeof *colours); i++) {
        fprintf(gnuplot, "set linetype %d lc rgb '%s'\n", i + 1, colours[i]);
    }
}

static void send_all(const Curves *curves, FILE *gnuplot)
{
    const OzStudyFigure *figure = curves->figure;
    double width = curves->width, height = curves->height;
    int rows = (curves->panel_count + curves->across - 1) / curves->across;
    fprintf(gnuplot,
            "set datafile columnheaders\nset style data lines\n"
            "set grid lt 1 lw 0.5 lc rgb '#dddddd'\nset tics font ',9'\n"
            "set multiplot layout %d,%d margins screen %.5f,%.5f,%.5f,%.5f "
            "spacing screen %.5f,%.5f title ",
            rows, curves->across, LEFT / width, 1 - RIGHT / width, BOTTOM / height,
            1 - TOP / height, ACROSS / width, DOWN / height);
    oz_figure_work_text(gnuplot, figure->title ? figure->title : figure->name);
    fputc('\n', gnuplot);
    send_colours(gnuplot);
    send_axes(curves, gnuplot);
    oz_figure_work_send_caption(curves->work, gnuplot,
                                curves->has_spread ? "; bands: standard deviation of the seeds"
                                                   : "");
    for (int i = 0; i < curves->panel_count; i++) {
        send_panel(curves, gnuplot, i);
    }
    if (figure->inset_run.count && figure->inset_columns.count) {
        send_inset(curves, gnuplot);
    }
    fputs("unset multiplot\n", gnuplot);
}

static void measure(Curves *curves)
{
    int rows = (curves->panel_count + curves->across - 1) / curves->across;
    bool one = curves->panel_count == 1;
    int across = curves->across;
    curves->width = one ? WIDTH : LEFT + RIGHT + across * PANEL_WIDTH + (across - 1) * ACROSS;
    curves->height = one ? HEIGHT : TOP + BOTTOM + rows * PANEL_HEIGHT + (rows - 1) * DOWN;
}

static OzStatus draw(const Curves *curves, const char *ending)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_figure_work_open(curves->work, ending, curves->width, curves->height, &gnuplot));
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
    curves.across = curves.panel_count == 4 ? 2 : curves.panel_count < 3 ? curves.panel_count : 3;
    measure(&curves);
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
