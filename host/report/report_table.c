/* What the points of a report say. */
#include "report/report_table.h"

#include "base/file.h"
#include "base/folder.h"
#include "scene/keys.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Below this, an error is rounding and has no order. */
#define ROUNDING 1e-11

static const char *integrator_name(const OzReportPoint *point)
{
    return oz_keys_choice_name("integrator", (int)point->integrator);
}

static const char *precision_name(const OzReportPoint *point)
{
    return oz_keys_choice_name("precision", (int)point->precision);
}

void oz_report_table_method(const OzReportPoint *point, char *text, size_t size)
{
    if (point->substeps > 1) {
        snprintf(text, size, "%s, %d substeps, %s", integrator_name(point), point->substeps,
                 precision_name(point));
    } else {
        snprintf(text, size, "%s, %s", integrator_name(point), precision_name(point));
    }
}

static bool beats(const OzReportPoint *a, const OzReportPoint *b)
{
    bool better = a->wall < b->wall || a->error_rms < b->error_rms;
    return a->good && better && a->wall <= b->wall && a->error_rms <= b->error_rms;
}

void oz_report_table_front(OzReportPoint *points, int count)
{
    for (int i = 0; i < count; i++) {
        points[i].front = points[i].good;
        for (int j = 0; j < count && points[i].front; j++) {
            points[i].front = !beats(&points[j], &points[i]);
        }
    }
}

const OzReportPoint *oz_report_table_cheapest(const OzReportPoint *points, int count,
                                              double tolerance)
{
    const OzReportPoint *best = NULL;
    for (int i = 0; i < count; i++) {
        if (points[i].good && points[i].error_max <= tolerance &&
            (!best || points[i].wall < best->wall)) {
            best = &points[i];
        }
    }
    return best;
}

bool oz_report_table_alike(const OzReportPoint *a, const OzReportPoint *b)
{
    return a->integrator == b->integrator && a->substeps == b->substeps &&
           a->precision == b->precision && a->device == b->device;
}

double oz_report_table_order(const OzReportPoint *points, int count, const OzReportPoint *like)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int i = 0; i < count; i++) {
        const OzReportPoint *p = &points[i];
        if (p->good && oz_report_table_alike(p, like) && p->error_rms > fmax(ROUNDING, p->floor)) {
            double a = log(p->step), b = log(p->error_rms);
            n += 1;
            x += a;
            y += b;
            xx += a * a;
            xy += a * b;
        }
    }
    return n >= 3 ? (n * xy - x * y) / (n * xx - x * x) : NAN;
}

static void say_failures(FILE *file, const OzReportPoint *points, int count)
{
    for (int i = 0; i < count; i++) {
        if (!points[i].good) {
            char method[64];
            oz_report_table_method(&points[i], method, sizeof method);
            fprintf(file, "  left out: %s, %d steps per %s%s%s: %s\n", method, points[i].steps,
                    points[i].cycle, points[i].label[0] ? " on " : "", points[i].label,
                    points[i].reason);
        }
    }
}

static void say_setting(FILE *file, const OzReportPoint *best)
{
    fprintf(file, "time:\n  step: %.6g\nintegrator: %s\nprecision: %s\n", best->step,
            integrator_name(best), precision_name(best));
    if (best->substeps > 1) {
        fprintf(file, "beams: {substeps: %d}\n", best->substeps);
    }
}

void oz_report_table_say(FILE *file, const OzReportPoint *points, int count, double tolerance,
                         bool paste)
{
    if (count == 0) {
        return;
    }
    const OzReportCase *row = points[0].row;
    const OzReportPoint *best = oz_report_table_cheapest(points, count, tolerance);
    char error[64], method[64];
    if (row->unit[0]) {
        snprintf(error, sizeof error, "%g %s", tolerance, row->unit);
    } else {
        snprintf(error, sizeof error, "%g %%", 100 * tolerance);
    }
    if (best) {
        oz_report_table_method(best, method, sizeof method);
        fprintf(file,
                "%s: for an error of %s in %s use %s, at dt = %.4g s (%d steps per %s): "
                "%.3g seconds per simulated second%s%s\n",
                points[0].scene, error, row->quantity, method, best->step, best->steps, best->cycle,
                best->wall, best->label[0] ? " on " : "", best->label);
    } else {
        fprintf(file, "%s: no setting of this ladder keeps the error in %s below %s\n",
                points[0].scene, row->quantity, error);
    }
    say_failures(file, points, count);
    if (best && paste) {
        say_setting(file, best);
    }
}

static void write_row(FILE *file, const OzReportPoint *p)
{
    fprintf(file, "%s,%s,%s,%s,%d,%.9g,%.9g,%.17g,", p->scene, p->row->quantity, integrator_name(p),
            precision_name(p), p->steps, p->step, p->evaluations, p->truth);
    if (p->good) {
        fprintf(file, "%.6g,%.6g,%.6g,%.6g,%.6g,%d,", p->error_rms, p->error_max, p->wall,
                p->wall_low, p->wall_high, p->front);
    } else {
        fprintf(file, ",,,,,,");
    }
    fprintf(file, "\"%s\",\"%s\",%d\n", p->reason, p->device ? p->device->name : p->label,
            p->substeps > 1 ? p->substeps : 1);
}

OzStatus oz_report_table_write(const char *folder, const OzReportPoint *points, int count)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    FILE *file = NULL;
    OZ_TRY(oz_file_join(&path, folder, "report.csv"));
    OZ_TRY(oz_folder_create_file(&file, folder, "report.csv"));
    fprintf(file, "scene,quantity,integrator,precision,steps_per_contact,step,"
                  "evaluations_per_simulated_s,truth,error_rms,error_max,wall_per_simulated_s,"
                  "wall_low,wall_high,pareto,reason,device,substeps\n");
    for (int i = 0; i < count; i++) {
        write_row(file, &points[i]);
    }
    bool whole = !ferror(file);
    if (fclose(file) != 0 || !whole) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
done:
    free(path);
    return status;
}
