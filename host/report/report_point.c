/* Running one setting of a report. */
#include "report/report_point.h"

#include "base/clock.h"
#include "base/order.h"
#include "report/report_cases.h"
#include "report/report_methods.h"
#include "report/report_refuse.h"
#include "report/report_runs.h"
#include "sim/element_reference.h"
#include "sim/read_snapshot.h"
#include "sim/reference.h"
#include "sim/sim.h"

#include <math.h>
#include <string.h>

enum { REPEATS_MOST = 64 };

/* The run that begins with the i-th start, by the reference on the host; *seconds receives what its
 * steps took. */
static OzStatus run_reference(OzSnapshot *end, double *seconds, const OzReportRuns *runs, int i)
{
    OzStatus status = OZ_OK;
    const OzGrains *start = &runs->starts[i];
    OzReference *reference = NULL;
    OzElementReference *elements = NULL;
    double begun = NAN;
    if (start->elements) {
        OZ_TRY(oz_element_reference_create(&elements, &runs->scene, start));
        begun = oz_clock_now();
        OZ_TRY(oz_element_reference_advance(elements, runs->steps));
        *seconds = oz_clock_now() - begun;
        OZ_TRY(oz_element_reference_snapshot(elements, end));
    } else {
        OZ_TRY(oz_reference_create(&reference, &runs->scene, start));
        begun = oz_clock_now();
        OZ_TRY(oz_reference_advance(reference, runs->steps));
        *seconds = oz_clock_now() - begun;
        OZ_TRY(oz_reference_snapshot(reference, end));
    }
done:
    oz_reference_free(reference);
    oz_element_reference_free(elements);
    return status;
}

OzStatus oz_report_point_truth(OzReportJob *job)
{
    OzStatus status = OZ_OK;
    OzReportJob alone = *job;
    OzSnapshot end = {0};
    OzReportRuns *runs = NULL;
    const OzReportMethods *methods = oz_report_methods_of(job->row->model);
    OzReportPoint point = {.integrator = methods->truth,
                           .precision = OZ_PRECISION_DOUBLE,
                           .steps = methods->truth_steps};
    double seconds = 0;
    memset(job->truth, 0, sizeof job->truth);
    if (job->row->zero) {
        return OZ_OK;
    }
    alone.phases = 1;
    OZ_TRY(oz_report_runs_open(&runs, &alone, &point));
    OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[0]));
    if (job->row->exact) {
        job->truth[0] = job->row->exact(&end);
    } else {
        OZ_TRY(run_reference(&end, &seconds, runs, 0));
        oz_report_cases_read(job->row, &end, job->truth);
    }
done:
    oz_snapshot_free(&end);
    oz_report_runs_close(runs);
    return status;
}

/* error_rms holds the sum of squares until the last copy. */
static void take_error(OzReportPoint *point, double error, int copy, int copies)
{
    point->error_rms = (copy > 0 ? point->error_rms : 0) + error * error;
    point->error_max = copy > 0 && error <= point->error_max ? point->error_max : error;
    if (copy == copies - 1) {
        point->error_rms = sqrt(point->error_rms / copies);
    }
}

static OzStatus take_errors(OzReportPoint *point, const OzReportJob *job, OzSim *sim,
                            const OzReportRuns *runs)
{
    OzStatus status = OZ_OK;
    OzSnapshot end = {0};
    for (int i = 0; i < runs->count; i++) {
        const char *stopped = oz_sim_stopped(sim, i);
        if (stopped) {
            status = oz_status_fail(OZ_ERR_BLOWUP, "%s", stopped);
            goto done;
        }
        OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[i]));
        OZ_TRY(oz_read_snapshot_snapshot(sim, i, &end, true));
        take_error(point, oz_report_cases_error(job->row, &end, job->truth), i, runs->count);
        oz_snapshot_free(&end);
    }
done:
    oz_snapshot_free(&end);
    return status;
}

/* Runs all phases side by side. *seconds receives the wall time of one of them, but for the first
 * step, in which the driver makes itself ready; the first run's errors go into the point. */
static OzStatus run_once(double *seconds, OzReportPoint *point, const OzReportJob *job,
                         const OzReportRuns *runs, bool first)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OZ_TRY(oz_sim_create(&sim, job->device, runs->members, runs->count, job->options->source_dir));
    OZ_TRY(oz_sim_advance(sim, 1));
    double start = oz_clock_now();
    OZ_TRY(oz_sim_advance(sim, runs->steps));
    *seconds =
        (oz_clock_now() - start) * (double)runs->steps / (double)(runs->steps - 1) / runs->count;
    if (first) {
        OZ_TRY(take_errors(point, job, sim, runs));
    }
done:
    oz_sim_free(sim);
    return status;
}

/* Median and extremes of wall times of one copy. */
static void take_times(OzReportPoint *point, double *seconds, int count, const OzReportRuns *runs)
{
    double simulated = (double)runs->steps * runs->scene.step;
    oz_order_sort(seconds, count);
    point->wall = 0.5 * (seconds[(count - 1) / 2] + seconds[count / 2]) / simulated;
    point->wall_low = seconds[0] / simulated;
    point->wall_high = seconds[count - 1] / simulated;
}

static OzStatus run_all(OzReportPoint *point, const OzReportJob *job, const OzReportRuns *runs)
{
    double seconds[REPEATS_MOST];
    int repeats = job->repeats < REPEATS_MOST ? job->repeats : REPEATS_MOST;
    for (int k = 0; k < repeats; k++) {
        OZ_PASS(run_once(&seconds[k], point, job, runs, k == 0));
    }
    take_times(point, seconds, repeats, runs);
    return OZ_OK;
}

static OzStatus run_on_host(OzReportPoint *point, const OzReportJob *job, const OzReportRuns *runs)
{
    OzStatus status = OZ_OK;
    OzSnapshot end = {0};
    double seconds[OZ_REPORT_RUNS_MOST];
    for (int i = 0; i < runs->count; i++) {
        OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[i]));
        OZ_TRY(run_reference(&end, &seconds[i], runs, i));
        take_error(point, oz_report_cases_error(job->row, &end, job->truth), i, runs->count);
        oz_snapshot_free(&end);
    }
    take_times(point, seconds, runs->count, runs);
done:
    oz_snapshot_free(&end);
    return status;
}

/* Anything that is not finite is an outcome too. */
static OzStatus judge(OzReportPoint *point, OzStatus status)
{
    point->good = status == OZ_OK && isfinite(point->error_rms);
    if (status == OZ_OK && !point->good) {
        snprintf(point->reason, sizeof point->reason, "the result is not a number");
    }
    return oz_status_outcome(status, point->reason, sizeof point->reason);
}

OzStatus oz_report_point_measure(OzReportPoint *point, const OzReportJob *job)
{
    OzStatus status = OZ_OK;
    OzReportRuns *runs = NULL;
    OZ_TRY(oz_report_runs_open(&runs, job, point));
    point->row = job->row;
    point->truth = job->row->values ? 0 : job->truth[0];
    point->step = runs->scene.step;
    point->evaluations = 1 / runs->scene.step;
    snprintf(point->scene, sizeof point->scene, "%s", runs->scene.name);
    point->evaluations *= point->integrator == OZ_INTEGRATOR_RK4 ? 4 : 1;
    if (!job->options->force) {
        status = oz_report_refuse_unstable(&runs->scene, &runs->starts[0]);
    }
    if (status == OZ_OK) {
        status = point->host ? run_on_host(point, job, runs) : run_all(point, job, runs);
    }
    status = judge(point, status);
done:
    oz_report_runs_close(runs);
    return status;
}
