/* Table, CSV and picture of ensembles. */
#include "report/report_ensemble_table.h"

#include "base/folder.h"
#include "base/gnuplot.h"
#include "scene/keys.h"

#include <errno.h>
#include <math.h>
#include <string.h>

OzMoments oz_report_ensemble_table_moments(const OzEnsemblePoint *point, int quantity)
{
    return oz_student_moments(point->value[quantity], point->members);
}

/* What a scene has no number of is left out of tables and pictures. */
static bool has_number(const OzEnsemblePoint *points, int count, int quantity)
{
    for (int i = 0; i < count; i++) {
        for (int m = 0; m < points[i].members; m++) {
            if (isfinite(points[i].value[quantity][m])) {
                return true;
            }
        }
    }
    return false;
}

/* Which quantities a table shows. */
typedef struct Shown {
    bool shown[OZ_MEMBER_QUANTITIES];
} Shown;

/* All, where no member reached the end: nothing is known of the scene then. */
static Shown choose_shown(const OzEnsemblePoint *points, int count)
{
    Shown shown;
    bool any = false;
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        shown.shown[q] = has_number(points, count, q);
        any |= shown.shown[q];
    }
    for (int q = 0; q < OZ_MEMBER_QUANTITIES && !any; q++) {
        shown.shown[q] = true;
    }
    return shown;
}

static const char *name_of(const OzEnsemblePoint *point)
{
    return oz_keys_choice_name("integrator", (int)point->integrator);
}

static void print_cell(FILE *file, OzMoments m)
{
    if (isfinite(m.mean)) {
        fprintf(file, "  %8.4g +- %-12.2g", m.mean, m.interval);
    } else {
        fprintf(file, "  %8s    %-12s", "-", "");
    }
}

static void say_left_out(FILE *file, Shown shown)
{
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        if (!shown.shown[q]) {
            fprintf(file, "%s is left out: this scene has no %s\n",
                    oz_report_member_quantities[q].name, oz_report_member_quantities[q].column);
        }
    }
}

void oz_report_ensemble_table_print(FILE *file, const OzEnsemblePoint *points, int count)
{
    Shown shown = choose_shown(points, count);
    fprintf(file, "%-17s %5s %5s %7s", "mean +- 95 %", "steps", "seeds", "wall, s");
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        if (shown.shown[q]) {
            fprintf(file, "  %-24s", oz_report_member_quantities[q].name);
        }
    }
    fprintf(file, "\n");
    for (int i = 0; i < count; i++) {
        const OzEnsemblePoint *p = &points[i];
        fprintf(file, "%-17s %5d %5d %7.1f", name_of(p), p->steps, p->members, p->seconds);
        for (int q = 0; q < OZ_MEMBER_QUANTITIES && p->members > 0; q++) {
            if (shown.shown[q]) {
                print_cell(file, oz_report_ensemble_table_moments(p, q));
            }
        }
        fprintf(file, "%s%s\n", p->reason[0] ? "  " : "", p->reason);
    }
    say_left_out(file, shown);
}

static void write_header(FILE *file, Shown shown)
{
    fprintf(file, "integrator,steps_per_contact,members,wall_seconds");
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        const char *name = oz_report_member_quantities[q].name;
        if (shown.shown[q]) {
            fprintf(file, ",%s_mean,%s_spread,%s_ci95", name, name, name);
        }
    }
    fprintf(file, ",reason\n");
}

static void write_row(FILE *file, const OzEnsemblePoint *p, Shown shown)
{
    fprintf(file, "%s,%d,%d,%.6g", name_of(p), p->steps, p->members, p->seconds);
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        OzMoments m = oz_report_ensemble_table_moments(p, q);
        if (shown.shown[q] && p->members > 1 && isfinite(m.mean)) {
            fprintf(file, ",%.9g,%.6g,%.6g", m.mean, m.spread, m.interval);
        } else if (shown.shown[q]) {
            fprintf(file, ",,,");
        }
    }
    fprintf(file, ",\"%s\"\n", p->reason);
}

/* A curve for each integrator, each a little beside the others so that bars can be told apart. */
static void send_curves(FILE *gnuplot, const OzEnsemblePoint *points, int count, int quantity)
{
    for (int i = 0; i < count; i++) {
        if (i == 0 || points[i].integrator != points[i - 1].integrator) {
            fprintf(gnuplot, "%s$q%dm%d << EOD\n", i ? "EOD\n" : "", quantity,
                    (int)points[i].integrator);
        }
        OzMoments m = oz_report_ensemble_table_moments(&points[i], quantity);
        if (points[i].members > 1 && isfinite(m.mean)) {
            double beside = 1 + 0.02 * ((int)points[i].integrator - 1);
            fprintf(gnuplot, "%.6g %.9g %.6g\n", beside * points[i].steps, m.mean, m.interval);
        }
    }
    fprintf(gnuplot, "EOD\n");
}

static void send_panel(FILE *gnuplot, const OzEnsemblePoint *points, int count, int quantity)
{
    static const char *const colours[] = {"#d55e00", "#0072b2", "#009e73", "#cc79a7"};
    const OzMemberQuantity *row = &oz_report_member_quantities[quantity];
    fprintf(gnuplot, "set ylabel '%s%s%s'\nplot ", row->name, row->unit[0] ? ", " : "", row->unit);
    for (int i = 0; i < count; i++) {
        if (i == 0 || points[i].integrator != points[i - 1].integrator) {
            int m = (int)points[i].integrator;
            fprintf(gnuplot,
                    "$q%dm%d using 1:2:3 with yerrorlines lw 2 pt 7 lc rgb '%s' title '%s', ",
                    quantity, m, colours[m % 4], name_of(&points[i]));
        }
    }
    fprintf(gnuplot, "NaN notitle\n");
}

static OzStatus draw(const char *folder, const char *title, const OzEnsemblePoint *points,
                     int count)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_gnuplot_open(&gnuplot, folder, "ensemble.png"));
    if (!gnuplot) {
        return OZ_OK;
    }
    Shown shown = choose_shown(points, count);
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        send_curves(gnuplot, points, count, q);
    }
    fprintf(gnuplot,
            "set terminal pngcairo size 1100,800 noenhanced font 'DejaVu Sans,11'\n"
            "set output '%s/ensemble.png'\nset multiplot layout 2,2 "
            "title '%s: means over seeds, later half of the taps; bars: 95 %% interval'\n"
            "set logscale x\nset xtics (10, 20, 30, 40, 50, 70, 100, 200)\n"
            "set xlabel 'steps per contact'\nset key top right font ',9'\n"
            "set grid xtics ytics lc rgb '#dddddd'\n"
            "set offsets graph 0.05, graph 0.05, graph 0.25, graph 0.05\n",
            folder, title);
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        if (shown.shown[q]) {
            send_panel(gnuplot, points, count, q);
        }
    }
    return oz_gnuplot_close(gnuplot, folder, "ensemble.png");
}

OzStatus oz_report_ensemble_table_write(const char *folder, const char *title,
                                        const OzEnsemblePoint *points, int count)
{
    FILE *file = NULL;
    OZ_PASS(oz_folder_create_file(&file, folder, "ensemble.csv"));
    OZ_PASS(oz_folder_note(folder, "ensemble.png"));
    Shown shown = choose_shown(points, count);
    write_header(file, shown);
    for (int i = 0; i < count; i++) {
        write_row(file, &points[i], shown);
    }
    bool whole = !ferror(file);
    if (fclose(file) != 0 || !whole) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s/ensemble.csv: %s", folder,
                              strerror(errno));
    }
    return draw(folder, title, points, count);
}
