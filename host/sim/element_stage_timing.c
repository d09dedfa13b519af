/* Timing the kernels of kernels/element_stage_timing.cl. */
#include "sim/element_stage_timing.h"

#include "compute/cl_try.h"
#include "sim/element_private.h"
#include "sim/timing.h"

#include <string.h>

static const struct {
    const char *name, *kernel, *less;
} phases[] = {
#define ROW(id, name, kernel, less) {name, kernel, less},
    OZ_ELEMENT_STAGES(ROW)
#undef ROW
};

const char *oz_element_stage_timing_name(OzElementPhase phase)
{
    return phases[phase].name;
}

/* Elements under loads that never change would go too far after more repeats than these. */
static OzStatus time_kernel(OzSim *sim, cl_program program, const char *name, double *seconds)
{
    const OzTiming timing = {
        .items = (size_t)oz_element_switches(sim)->group, .seconds = 0.01, .repeats_most = 2048};
    return oz_timing_kernel(sim, program, name, &timing, seconds);
}

typedef struct Job {
    double *seconds; /* one a phase */
    cl_program program;
} Job;

static OzStatus time_all(void *context, OzSim *sim)
{
    const Job *job = context;
    memset(job->seconds, 0, OZ_ELEMENT_PHASE_COUNT * sizeof *job->seconds);
    for (int p = 0; p < OZ_ELEMENT_PHASE_COUNT; p++) {
        double less = 0;
        if (p == OZ_ELEMENT_PHASE_BEAMS && !oz_element_switches(sim)->beams) {
            continue;
        }
        OZ_PASS(time_kernel(sim, job->program, phases[p].kernel, &job->seconds[p]));
        if (phases[p].less) {
            OZ_PASS(time_kernel(sim, job->program, phases[p].less, &less));
        }
        job->seconds[p] -= less;
    }
    return OZ_OK;
}

OzStatus oz_element_stage_timing_measure(double seconds[OZ_ELEMENT_PHASE_COUNT], OzSim *sim,
                                         const char *source_dir)
{
    OzStatus status = OZ_OK;
    Job job = {.seconds = seconds};
    OZ_TRY(oz_timing_build(sim, sim->arrays.switches, source_dir, "kernels/element_stage_timing.cl",
                           &job.program));
    OZ_TRY(oz_timing_restored(sim, time_all, &job));
done:
    CL_RELEASE(Program, job.program);
    return status;
}
