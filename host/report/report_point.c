/* Running one setting of a report. */
#include "report/report_point.h"

#include "base/clock.h"
#include "base/order.h"
#include "report/report_refuse.h"
#include "report/report_runs.h"
#include "sim/element_reference.h"
#include "sim/read_snapshot.h"
#include "sim/reference.h"
#include "sim/sim.h"

#include <math.h>
#include <stdlib.h>

enum { REPEATS_MOST = 64 };

OzStatus oz_report_point_truth(double *truth, const OzReportJob *job)
{
    OzStatus status = OZ_OK;
    OzReportJob alone = *job;
    OzReference *reference = NULL;
    OzSnapshot end = {0};
    OzReportRuns *runs = NULL;
    OzReportPoint point = {.integrator = OZ_INTEGRATOR_VELOCITY_VERLET,
                           .precision = OZ_PRECISION_DOUBLE,
                           .steps = OZ_REPORT_POINT_TRUTH};
    alone.phases = 1;
    OZ_TRY(oz_report_runs_open(&runs, &alone, &point));
    OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[0]));
    if (job->row->exact) {
        *truth = job->row->exact(&end);
    } else {
        OZ_TRY(oz_reference_create(&reference, &runs->scene, &runs->starts[0]));
        OZ_TRY(oz_reference_advance(reference, runs->steps));
        OZ_TRY(oz_reference_snapshot(reference, &end));
        *truth = job->row->value(&end);
    }
done:
    oz_reference_free(reference);
    oz_snapshot_free(&end);
    oz_report_runs_close(runs);
    return status;
}

static double error_of(const OzReportJob *job, const OzReportPoint *point, const OzSnapshot *end)
{
    return job->elements ? oz_report_element_cases_error(job->elements, end, job->truth)
                         : oz_report_cases_error(point->row, point->row->value(end), point->truth);
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
        take_error(point, error_of(job, point, &end), i, runs->count);
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
    OzElementReference *reference = NULL;
    OzSnapshot end = {0};
    double seconds[OZ_REPORT_RUNS_MOST];
    for (int i = 0; i < runs->count; i++) {
        OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[i]));
        OZ_TRY(oz_element_reference_create(&reference, &runs->scene, &runs->starts[i]));
        double start = oz_clock_now();
        OZ_TRY(oz_element_reference_advance(reference, runs->steps));
        seconds[i] = oz_clock_now() - start;
        OZ_TRY(oz_element_reference_snapshot(reference, &end));
        take_error(point, error_of(job, point, &end), i, runs->count);
        oz_element_reference_free(reference);
        oz_snapshot_free(&end);
        reference = NULL;
    }
    take_times(point, seconds, runs->count, runs);
done:
    oz_element_reference_free(reference);
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
