/* Methods, steps and truth of trigrains' scenes. */
#include "report/report_element.h"

#include "report/report_runs.h"
#include "sim/element_reference.h"

#include <string.h>

static const OzReportMethod methods[] = {
    {OZ_INTEGRATOR_GEAR4, OZ_PRECISION_DOUBLE, 0, true},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 0, true},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 4, true},
    {OZ_INTEGRATOR_RK4, OZ_PRECISION_DOUBLE, 0, true},
    {OZ_INTEGRATOR_GEAR4, OZ_PRECISION_DOUBLE, 0, false},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 0, false},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 4, false},
    {OZ_INTEGRATOR_GEAR4, OZ_PRECISION_FLOAT, 0, false},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_FLOAT, 0, false},
};

/* gear4 is stable from about 12 on, substeps of beams help below; at 640 float's rounding shows. */
static const int ladder[] = {5, 8, 14, 20, 40, 80, 160, 320, 640};
static const int ladder_quick[] = {20, 40, 80};

enum {
    METHODS = sizeof methods / sizeof methods[0],
    RUNGS = sizeof ladder / sizeof ladder[0],
    RUNGS_QUICK = sizeof ladder_quick / sizeof ladder_quick[0]
};

const OzReportMethod *oz_report_element_methods(int *count)
{
    *count = METHODS;
    return methods;
}

const int *oz_report_element_ladder(bool quick, int *count)
{
    *count = quick ? RUNGS_QUICK : RUNGS;
    return quick ? ladder_quick : ladder;
}

OzStatus oz_report_element_truth(OzReportJob *job)
{
    OzStatus status = OZ_OK;
    OzReportJob alone = *job;
    OzElementReference *reference = NULL;
    OzSnapshot end = {0};
    OzReportRuns *runs = NULL;
    OzReportPoint point = {.integrator = OZ_INTEGRATOR_GEAR4,
                           .precision = OZ_PRECISION_DOUBLE,
                           .steps = OZ_REPORT_ELEMENT_TRUTH};
    memset(job->truth, 0, sizeof job->truth);
    if (job->elements->exact) {
        return OZ_OK;
    }
    alone.phases = 1;
    OZ_TRY(oz_report_runs_open(&runs, &alone, &point));
    OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[0]));
    OZ_TRY(oz_element_reference_create(&reference, &runs->scene, &runs->starts[0]));
    OZ_TRY(oz_element_reference_advance(reference, runs->steps));
    OZ_TRY(oz_element_reference_snapshot(reference, &end));
    job->elements->values(&end, job->truth);
done:
    oz_element_reference_free(reference);
    oz_snapshot_free(&end);
    oz_report_runs_close(runs);
    return status;
}
