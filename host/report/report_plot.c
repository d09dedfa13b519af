/* Talking to gnuplot. */
#include "report/report_plot.h"

#include "base/folder.h"
#include "base/gnuplot.h"
#include "report/report_table.h"

#include <math.h>
#include <string.h>

/* Where an error of nothing is drawn: below any rounding. */
#define LEAST_ERROR 1e-17

/* Pixels, and the most lines that the list of settings without a point may take. */
enum { TITLE_HEIGHT = 44, PANEL_HEIGHT = 656, LIST_LINE = 15, LIST_MOST = 12 };

static int count_bad(const OzReportPoint *points, int count)
{
    int bad = 0;
    for (int i = 0; i < count; i++) {
        bad += points[i].good ? 0 : 1;
    }
    return bad;
}

static int list_lines(const OzReportPoint *points, int count)
{
    int bad = count_bad(points, count);
    return bad < LIST_MOST ? bad : LIST_MOST;
}

static bool begins_curve(const OzReportPoint *points, int i)
{
    for (int before = 0; before < i; before++) {
        if (points[before].good && oz_report_table_alike(&points[before], &points[i])) {
            return false;
        }
    }
    return points[i].good;
}

/* x of both panels, error, greatest error, wall time's extremes, label. */
static void send_row(FILE *gnuplot, const OzReportPoint *p)
{
    fprintf(gnuplot, "%.9g %.9g %.9g %.9g %.9g %.9g %d\n", p->wall, p->evaluations,
            fmax(p->error_rms, LEAST_ERROR), fmax(p->error_max, LEAST_ERROR), p->wall_low,
            p->wall_high, p->steps);
}

static void send_data(FILE *gnuplot, const OzReportPoint *points, int count)
{
    for (int i = 0; i < count; i++) {
        if (begins_curve(points, i)) {
            fprintf(gnuplot, "$curve%d << EOD\n", i);
            for (int j = i; j < count; j++) {
                if (points[j].good && oz_report_table_alike(&points[i], &points[j])) {
                    send_row(gnuplot, &points[j]);
                }
            }
            fprintf(gnuplot, "EOD\n");
        }
    }
    fprintf(gnuplot, "$front << EOD\n");
    for (int i = 0; i < count; i++) {
        if (points[i].front) {
            send_row(gnuplot, &points[i]);
        }
    }
    fprintf(gnuplot, "EOD\n");
}

static void send_curve(FILE *gnuplot, const OzReportPoint *points, int count, int i, int x)
{
    static const char *const colours[] = {"#d55e00", "#0072b2", "#009e73",
                                          "#cc79a7", "#e69f00", "#000000"};
    const OzReportPoint *p = &points[i];
    const char *colour = colours[((int)p->integrator + (p->substeps > 1 ? 3 : 0)) % 6];
    bool is_double = p->precision == OZ_PRECISION_DOUBLE;
    double order = oz_report_table_order(points, count, p);
    char title[160], method[64];
    oz_report_table_method(p, method, sizeof method);
    snprintf(title, sizeof title, "%s%s%.40s", method, p->label[0] ? ", " : "", p->label);
    if (is_double && isfinite(order)) {
        size_t length = strlen(title);
        snprintf(title + length, sizeof title - length, " (order %.1f)", order);
    }
    fprintf(gnuplot,
            "$curve%d using %d:3:3:4 with yerrorbars pt -1 ps 0 lw 1 lc rgb '%s' notitle, "
            "$curve%d using %d:3 with linespoints lw 2 ps 0.9 pt %d dt %d lc rgb '%s' title '%s', ",
            i, x, colour, i, x,
            p->host     ? 4
            : is_double ? 7
                        : 6,
            p->host     ? 4
            : is_double ? 1
                        : 2,
            colour, title);
    if (is_double || x == 1) {
        fprintf(gnuplot,
                "$curve%d using %d:3:7 with labels offset 0,%s font ',7' tc rgb '%s' notitle, ", i,
                x, is_double ? "-0.7" : "0.7", colour);
    }
}

static void send_panel(FILE *gnuplot, const OzReportPoint *points, int count, int x)
{
    fprintf(gnuplot, "plot ");
    for (int i = 0; i < count; i++) {
        if (begins_curve(points, i)) {
            send_curve(gnuplot, points, count, i, x);
        }
    }
    if (x == 1) {
        fprintf(gnuplot, "$front using 1:3 with points pt 6 ps 2.2 lw 1 lc rgb '#777777' "
                         "title 'none is faster and better'\n");
    } else {
        fprintf(gnuplot, "NaN notitle\n");
    }
}

/* A text between single quotes, in which gnuplot wants a quote twice. */
static void send_quoted(FILE *gnuplot, const char *text)
{
    fputc('\'', gnuplot);
    for (; *text; text++) {
        fputs(*text == '\'' ? "''" : (char[]){*text, '\0'}, gnuplot);
    }
    fputc('\'', gnuplot);
}

/* Line `line` of the list, counted from the picture's lower edge. */
static void send_left_out(FILE *gnuplot, const char *text, int line, int height)
{
    fprintf(gnuplot, "set label %d ", line + 1);
    send_quoted(gnuplot, text);
    fprintf(gnuplot, " at screen 0.01,%.4f font ',8'\n", (line + 0.8) * LIST_LINE / height);
}

/* The settings without a point, below the panels: nothing of theirs is covered. */
static void send_list(FILE *gnuplot, const OzReportPoint *points, int count, int height)
{
    char text[320], method[64];
    int lines = list_lines(points, count), line = lines, rest = count_bad(points, count);
    for (int i = 0; i < count && line > 0; i++) {
        if (!points[i].good) {
            oz_report_table_method(&points[i], method, sizeof method);
            snprintf(text, sizeof text, "left out: %s%s%s, %d: %.160s", method,
                     points[i].label[0] ? ", " : "", points[i].label, points[i].steps,
                     points[i].reason);
            if (--line == 0 && rest > 1) {
                snprintf(text, sizeof text, "left out: %d more, see report.csv", rest);
            }
            send_left_out(gnuplot, text, line, height);
            rest--;
        }
    }
}

/* The two panels side by side, between the title and the list. */
static void send_panels(FILE *gnuplot, const OzReportPoint *points, int count, int height)
{
    double low = (double)(list_lines(points, count) * LIST_LINE) / height;
    double share = (double)PANEL_HEIGHT / height;
    fprintf(gnuplot, "set size 0.5,%.4f\nset origin 0,%.4f\n", share, low);
    fprintf(gnuplot, "set xlabel 'wall seconds per simulated second'\n");
    send_panel(gnuplot, points, count, 1);
    fprintf(gnuplot, "unset label\nset origin 0.5,%.4f\n", low);
    fprintf(gnuplot, "set xlabel 'force evaluations per simulated second'\n");
    send_panel(gnuplot, points, count, 2);
}

static void send_picture(FILE *gnuplot, const char *terminal, const char *path, const char *device,
                         const OzReportPoint *points, int count)
{
    const OzReportCase *row = points[0].row;
    int bottom = 4; /* lines below the axis: its title, and the key's */
    int height = TITLE_HEIGHT + PANEL_HEIGHT + LIST_LINE * list_lines(points, count);
    for (int i = 0; i < count; i++) {
        bottom += begins_curve(points, i) ? 1 : 0;
    }
    fprintf(gnuplot,
            "set terminal %s size 1500,%d noenhanced font 'DejaVu Sans,11'\nset output '%s'\n"
            "set multiplot title \"%s: error in %s; labels: steps per %s; bars: up "
            "to the greatest error of any phase\\n%s\"\n"
            "set logscale xy\nset grid xtics ytics lc rgb '#dddddd'\nset format '%%g'\n"
            "set ylabel 'RMS error, %s'\n"
            "set key below font ',9' maxcols 2\nset bmargin %d\n",
            terminal, height, path, points[0].scene, row->quantity, points[0].cycle, device,
            row->unit[0] ? row->unit : "as a share", bottom);
    send_list(gnuplot, points, count, height);
    send_panels(gnuplot, points, count, height);
    fprintf(gnuplot, "unset multiplot\nset output\n");
}

OzStatus oz_report_plot_draw(const char *folder, const char *device, const OzReportPoint *points,
                             int count)
{
    char path[1024], name[2][1024];
    if (count_bad(points, count) == count) {
        return OZ_OK;
    }
    snprintf(name[0], sizeof name[0], "%s.png", points[0].scene);
    snprintf(name[1], sizeof name[1], "%s.svg", points[0].scene);
    OZ_PASS(oz_folder_note(folder, name[0]));
    OZ_PASS(oz_folder_note(folder, name[1]));
    FILE *gnuplot = NULL;
    OZ_PASS(oz_gnuplot_open(&gnuplot, folder, name[0]));
    if (!gnuplot) {
        return OZ_OK;
    }
    send_data(gnuplot, points, count);
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, name[i]);
        send_picture(gnuplot, i == 0 ? "pngcairo" : "svg", path, device, points, count);
    }
    return oz_gnuplot_close(gnuplot, folder, name[0]);
}
