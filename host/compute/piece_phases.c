/* Timing the kernels of kernels/piece_phases.cl. */
#include "compute/piece_phases.h"

#include "compute/piece_private.h"
#include "compute/timing.h"

#include <string.h>

static const struct {
    const char *name, *kernel, *less;
} phases[] = {
#define ROW(id, name, kernel, less) {name, kernel, less},
    OZ_PIECE_PHASES(ROW)
#undef ROW
};

const char *oz_piece_phases_name(OzPiecePhase phase)
{
    return phases[phase].name;
}

/* Pieces under loads that never change would go too far after more repeats than these. */
static OzStatus time_kernel(OzSim *sim, cl_program program, const char *name, double *seconds)
{
    const OzTiming timing = {
        .items = (size_t)oz_piece_switches(sim)->group, .seconds = 0.01, .repeats_most = 2048};
    return oz_timing_kernel(sim, program, name, &timing, seconds);
}

typedef struct Job {
    double *seconds; /* one a phase */
    cl_program program;
} Job;

static OzStatus time_all(void *context, OzSim *sim)
{
    const Job *job = context;
    memset(job->seconds, 0, OZ_PIECE_PHASE_COUNT * sizeof *job->seconds);
    for (int p = 0; p < OZ_PIECE_PHASE_COUNT; p++) {
        double less = 0;
        if (p == OZ_PIECE_PHASE_BEAMS && !oz_piece_switches(sim)->beams) {
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

OzStatus oz_piece_phases_measure(double seconds[OZ_PIECE_PHASE_COUNT], OzSim *sim,
                                 const char *source_dir)
{
    OzStatus status = OZ_OK;
    Job job = {.seconds = seconds};
    OZ_TRY(oz_timing_build(sim, sim->arrays.switches, source_dir, "kernels/piece_phases.cl",
                           &job.program));
    OZ_TRY(oz_timing_restored(sim, time_all, &job));
done:
    if (job.program) {
        clReleaseProgram(job.program);
    }
    return status;
}
