/* The straight line of a report: every scene, every method, every step of the ladder. */
#include "report/report.h"

#include "base/clock.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "report/report_bed.h"
#include "report/report_cases.h"
#include "report/report_ensemble.h"
#include "report/report_extreme.h"
#include "report/report_hits.h"
#include "report/report_map.h"
#include "report/report_methods.h"
#include "report/report_own.h"
#include "report/report_plot.h"
#include "report/report_point.h"
#include "report/report_table.h"
#include "report/report_validate.h"

#include <libgen.h>
#include <stdlib.h>
#include <string.h>

enum {
    PHASES = 32,
    PHASES_QUICK = 8,
    REPEATS = 5,
    DEVICES_MOST = 4,
    POINTS_MOST = OZ_REPORT_METHODS_MOST * DEVICES_MOST * OZ_REPORT_RUNGS_MOST /* of a scene */
};

/* Without --tolerance. */
#define TOLERANCE 0.01

static const char *const folder_default = "report";

typedef struct Report {
    const OzOptions *options;
    OzDevice devices[DEVICES_MOST];
    char *device_list; /* cut at its commas: labels point into it    */
    const char *labels[DEVICES_MOST];
    char device_names[DEVICES_MOST * 160]; /* of all, for pictures */
    int device_count;
    OzReportPoint *points;
    int count;
    char *folder;
    OzFolder owned; /* the folder, in use */
} Report;

/* "scenes/report/bounce.yaml" is the case "bounce"; *row is NULL where no answer is known. */
static OzStatus find_case(const OzReportCase **row, const char *path)
{
    OzStatus status = OZ_OK;
    char *copy = NULL;
    OZ_TRY(oz_memory_text(&copy, path));
    char *name = basename(copy), *dot = strrchr(name, '.');
    if (dot) {
        *dot = '\0';
    }
    *row = oz_report_cases_find(name);
done:
    free(copy);
    return status;
}

static OzStatus study_method(Report *report, const OzReportJob *job, const OzReportPoint *like)
{
    OzStatus status = OZ_OK;
    const OzReportMethods *methods = oz_report_methods_of(job->row->model);
    const int *steps = job->options->quick ? methods->quick : methods->steps;
    for (int r = 0; r < OZ_REPORT_RUNGS_MOST && steps[r] > 0; r++) {
        OzReportPoint *point = &report->points[report->count];
        char method[64];
        *point = *like;
        point->steps = steps[r];
        oz_report_table_method(point, method, sizeof method);
        oz_log_progress("%s: %s, %d steps per %s", job->row->scene, method, point->steps,
                        point->cycle);
        OZ_TRY(oz_report_point_measure(point, job));
        report->count++;
    }
done:
    oz_log_progress("%s", "");
    return status;
}

/* Every method on a device, those of the host with the first one. */
static OzStatus study_device(Report *report, OzReportJob *job, int d)
{
    const OzReportMethods *methods = oz_report_methods_of(job->row->model);
    for (int i = 0; i < methods->count; i++) {
        const OzReportMethod *method = &methods->methods[i];
        OzReportPoint point = {.cycle = methods->cycle,
                               .floor = job->row->floor,
                               .integrator = method->integrator,
                               .precision = method->precision,
                               .substeps = method->substeps,
                               .host = method->host};
        job->device = point.device = method->host ? NULL : &report->devices[d];
        point.label = method->host ? "host" : report->device_count > 1 ? report->labels[d] : "";
        bool known = method->host
                         ? d == 0
                         : method->precision == OZ_PRECISION_FLOAT || point.device->has_double;
        if (known) {
            OZ_PASS(study_method(report, job, &point));
        }
    }
    return OZ_OK;
}

static OzStatus study_scene(Report *report, const char *path, const OzReportCase *row)
{
    const OzOptions *options = report->options;
    double tolerance = options->tolerance > 0 ? options->tolerance : TOLERANCE;
    int first = report->count;
    OzReportJob job = {.options = options,
                       .path = path,
                       .row = row,
                       .phases = options->quick ? PHASES_QUICK : PHASES,
                       .repeats = REPEATS};
    OZ_PASS(oz_report_point_truth(&job));
    for (int d = 0; d < report->device_count; d++) {
        OZ_PASS(study_device(report, &job, d));
    }
    oz_report_table_front(report->points + first, report->count - first);
    oz_report_table_say(stdout, report->points + first, report->count - first, tolerance,
                        options->tolerance > 0);
    fflush(stdout);
    return oz_report_plot_draw(report->folder, report->device_names, report->points + first,
                               report->count - first);
}

/* Those of --device cpu,gpu, or the one that a run would take. */
static OzStatus open_devices(Report *report)
{
    const OzOptions *options = report->options;
    OZ_PASS(oz_memory_text(&report->device_list, options->device ? options->device : "auto"));
    for (char *rest = report->device_list; rest;) {
        int d = report->device_count;
        if (d == DEVICES_MOST) {
            return oz_status_fail(OZ_ERR_INPUT, "--device %s: at most %d devices", options->device,
                                  DEVICES_MOST);
        }
        report->labels[d] = strsep(&rest, ",");
        OZ_PASS(oz_device_open(&report->devices[d], report->labels[d], d ? 0 : options->threads));
        report->device_count++;
        printf("device: %s\n", report->devices[d].name);
        size_t length = strlen(report->device_names);
        snprintf(report->device_names + length, sizeof report->device_names - length, "%s%.150s",
                 d ? " | " : "", report->devices[d].name);
    }
    return OZ_OK;
}

static OzStatus study_scenes(Report *report)
{
    OzStatus status = OZ_OK;
    const OzFolderUse use = {.keep = true};
    const OzOptions *options = report->options;
    double start = oz_clock_now();
    OZ_TRY(OZ_NEW(&report->points, options->path_count * POINTS_MOST));
    OZ_TRY(open_devices(report));
    OZ_TRY(oz_folder_open(&report->owned, report->folder, &use));
    OZ_TRY(oz_folder_note(report->folder, "report.csv")); /* refused now, not at the end */
    for (int i = 0; i < options->path_count; i++) {
        const OzReportCase *row = NULL;
        OZ_TRY(find_case(&row, options->paths[i]));
        OZ_TRY(!row         ? oz_report_own_study(options->paths[i], report->folder, options,
                                                  &report->devices[0])
               : row->study ? row->study(options->paths[i], report->folder, options)
                            : study_scene(report, options->paths[i], row));
    }
    if (report->count == 0) {
        goto done; /* no table */
    }
    oz_log_line("%d settings in %.0f s; %s/report.csv and pictures", report->count,
                oz_clock_now() - start, report->folder);
done:
    if (report->count > 0) {
        OzStatus written = oz_report_table_write(report->folder, report->points, report->count);
        status = status == OZ_OK ? written : status;
    }
    return status;
}

OzStatus oz_report_run(const OzOptions *options)
{
    OzStatus status = OZ_OK;
    Report report = {.options = options};
    setvbuf(stdout, NULL, _IOLBF, 0); /* lines are seen as they come, in a pipe too */
    OZ_TRY(oz_memory_text(&report.folder, options->out ? options->out : folder_default));
    if (options->extreme) {
        OZ_TRY(oz_report_extreme_run(options));
    } else if (options->map) {
        OZ_TRY(oz_report_map_draw(report.folder));
    } else if (options->validate) {
        OZ_TRY(oz_report_validate_run(options, report.folder));
    } else if (options->path_count == 0) {
        OZ_TRY(oz_status_fail(OZ_ERR_INPUT, "orzo report: no scene; expected SCENE..., --validate, "
                                            "--extreme or --map"));
    } else if (options->ensemble) {
        OZ_TRY(oz_report_ensemble_run(options, report.folder));
    } else if (options->hits) {
        OZ_TRY(oz_report_hits_run(options, report.folder));
    } else if (options->stability) {
        for (int i = 0; i < options->path_count; i++) {
            OZ_TRY(oz_report_bed_say(options->paths[i], options->settings, options->setting_count,
                                     options->device, options->threads, options->source_dir));
        }
    } else {
        OZ_TRY(study_scenes(&report));
    }
done:
    for (int d = 0; d < report.device_count; d++) {
        oz_device_close(&report.devices[d]);
    }
    free(report.device_list);
    free(report.points);
    oz_folder_close(&report.owned);
    free(report.folder);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
