/* Repeating a model's stages against the clock. */
#include "sim/stage_timing.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/order.h"
#include "compute/buffers.h"
#include "compute/cl_try.h"
#include "compute/program.h"
#include "sim/sim_private.h"

#include <stdlib.h>
#include <string.h>

/* s that a timed launch shall take: long against its overhead, short for the one who waits. */
static const double launch_seconds = 0.02;

enum { LAUNCHES = 5 };

/* bare: without walls, NULL where the model has no such stage. */
typedef struct Programs {
    cl_program whole, bare;
} Programs;

double oz_stage_timing_clock(const OzDevice *device)
{
    return device->is_cpu ? oz_clock_processor() : oz_clock_now();
}

static OzStatus time_launch(OzSim *sim, cl_kernel kernel, cl_uint index, int repeats,
                            double *seconds)
{
    size_t group = (size_t)oz_arrays_switches(&sim->arrays)->group, items = group;
    if (sim->large) {
        size_t regions = (size_t)oz_arrays_sizes(&sim->arrays)->regions;
        items = (regions + group - 1) / group * group;
    }
    CL_PASS(clSetKernelArg(kernel, index, sizeof repeats, &repeats));
    double start = oz_stage_timing_clock(sim->device);
    CL_PASS(
        clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &items, &group, 0, NULL, NULL));
    CL_PASS(clFinish(sim->device->queue));
    *seconds = oz_stage_timing_clock(sim->device) - start;
    return OZ_OK;
}

static OzStatus time_kernel(OzSim *sim, cl_program program, const char *name, double *seconds)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_uint index = 0;
    double times[LAUNCHES], spent = 0;
    int repeats = 1;
    cl_kernel kernel = clCreateKernel(program, name, &code);
    CL_TRY(code);
    OZ_TRY(oz_arrays_bind(&sim->arrays, kernel, &index));
    OZ_TRY(time_launch(sim, kernel, index, repeats, &spent)); /* compiles */
    OZ_TRY(time_launch(sim, kernel, index, repeats, &spent));
    while (spent < launch_seconds && repeats < sim->model->repeats_most) {
        repeats *= 2;
        OZ_TRY(time_launch(sim, kernel, index, repeats, &spent));
    }
    for (int k = 0; k < LAUNCHES; k++) {
        OZ_TRY(time_launch(sim, kernel, index, repeats, &times[k]));
    }
    *seconds = oz_order_middle(times, LAUNCHES) / repeats;
done:
    CL_RELEASE(Kernel, kernel);
    return status;
}

/* Seconds of making the lists of a large scene anew. */
static OzStatus time_renewal(OzSim *sim, bool outer, double *seconds)
{
    double times[LAUNCHES];
    for (int k = 0; k < LAUNCHES; k++) {
        double start = oz_stage_timing_clock(sim->device);
        OZ_PASS(oz_large_renew(sim->large, &sim->arrays, oz_sim_control(sim, 0), outer));
        times[k] = oz_stage_timing_clock(sim->device) - start;
    }
    *seconds = oz_order_middle(times, LAUNCHES);
    return OZ_OK;
}

static OzStatus time_all(double *seconds, OzSim *sim, const Programs *programs)
{
    const OzModel *model = sim->model;
    double whole[OZ_TIMED_MOST];
    for (int i = 0; i < model->stage_count; i++) {
        const OzTimedStage *stage = &model->stages[i];
        OZ_PASS(sim->large && stage->rate != OZ_TIMED_STEP
                    ? time_renewal(sim, stage->rate == OZ_TIMED_REBUILD, &whole[i])
                    : time_kernel(sim, stage->bare ? programs->bare : programs->whole,
                                  stage->kernel, &whole[i]));
    }
    for (int i = 0; i < model->stage_count; i++) {
        int less = model->stages[i].less;
        seconds[i] = whole[i] - (less == OZ_TIMED_NONE ? 0 : whole[less]);
    }
    return OZ_OK;
}

/* On a bed that stands still if the model can make it; what the host knows is then put back. */
static OzStatus time_standing(double *seconds, OzSim *sim, const Programs *programs)
{
    OzStatus status = OZ_OK;
    void *control = NULL;
    double step = oz_sim_parameters(sim, 0)->dt;
    OZ_TRY(oz_memory_new(&control, sim->model->control_bytes, 1, "control words"));
    memcpy(control, sim->control, sim->model->control_bytes);
    status = sim->model->stand_still ? sim->model->stand_still(sim) : OZ_OK;
    status = status == OZ_OK ? time_all(seconds, sim, programs) : status;
    memcpy(sim->control, control, sim->model->control_bytes);
    oz_sim_parameters(sim, 0)->dt = step;
done:
    free(control);
    return status;
}

/* With every array of the device saved and put back. */
static OzStatus time_restored(double *seconds, OzSim *sim, const Programs *programs)
{
    OzStatus status = OZ_OK;
    int count = sim->model->field_count;
    void **copies = NULL;
    OZ_TRY(OZ_NEW(&copies, count));
    OZ_TRY(oz_buffers_save(sim->device, sim->arrays.buffer, count, copies));
    status = time_standing(seconds, sim, programs);
    OzStatus back = oz_buffers_restore(sim->device, sim->arrays.buffer, count, copies);
    status = status == OZ_OK ? back : status;
done:
    for (int f = 0; copies && f < count; f++) {
        free(copies[f]);
    }
    free(copies);
    return status;
}

static OzStatus build(cl_program *program, const OzSim *sim, const void *switches,
                      const char *source_dir)
{
    char options[1024];
    oz_model_options(sim->model, switches, options, sizeof options);
    return oz_program_build(program, sim->device, source_dir, sim->model->stage_program, options);
}

OzStatus oz_stage_timing_measure(double seconds[OZ_TIMED_MOST], OzSim *sim, const char *source_dir)
{
    OzStatus status = OZ_OK;
    Programs programs = {NULL, NULL};
    void *switches = NULL;
    OZ_TRY(build(&programs.whole, sim, sim->arrays.switches, source_dir));
    if (sim->model->leave_out_walls) {
        OZ_TRY(oz_memory_new(&switches, sim->model->switches_bytes, 1, "switches"));
        memcpy(switches, sim->arrays.switches, sim->model->switches_bytes);
        sim->model->leave_out_walls(switches);
        OZ_TRY(build(&programs.bare, sim, switches, source_dir));
    }
    OZ_TRY(time_restored(seconds, sim, &programs));
done:
    CL_RELEASE(Program, programs.bare);
    CL_RELEASE(Program, programs.whole);
    free(switches);
    return status;
}
