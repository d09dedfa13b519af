/* Running the kernels: launches, growth of lists, guards. */
#include "compute/sim_private.h"

#include "base/clock.h"
#include "base/log.h"
#include "base/memory.h"
#include "compute/cl_try.h"
#include "compute/host_lists.h"
#include "compute/pack.h"
#include "compute/program.h"
#include "compute/sizes.h"

#include <stdlib.h>
#include <string.h>

/* A launch is kept below this so that Ctrl-C and watchdogs are served, s. */
static const double launch_seconds = 0.04;

enum { FIRST_LAUNCH = 16 };

/* The device's idea of the shared structs against ours. */
static OzStatus check_layout(const OzSim *sim, const OzSwitches *switches)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS, sizes[5] = {0};
    cl_mem buffer = NULL;
    size_t one = 1, scalar = switches->is_double ? 8 : 4;
    cl_kernel kernel = clCreateKernel(sim->program, "oz_layout", &code);
    CL_TRY(code);
    buffer = clCreateBuffer(sim->device->context, CL_MEM_READ_WRITE, sizeof sizes, NULL, &code);
    CL_TRY(code);
    CL_TRY(clSetKernelArg(kernel, 0, sizeof buffer, &buffer));
    CL_TRY(clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &one, &one, 0, NULL, NULL));
    CL_TRY(clEnqueueReadBuffer(sim->device->queue, buffer, CL_TRUE, 0, sizeof sizes, sizes, 0, NULL,
                               NULL));
    if ((size_t)sizes[0] != sizeof(OzParameters) / sizeof(double) * scalar ||
        (size_t)sizes[1] != sizeof(OzControl) || (size_t)sizes[2] != sizeof(OzSizes) ||
        (size_t)sizes[3] != scalar || sizes[4] != switches->lanes) {
        status = oz_status_fail(OZ_ERR_DEVICE,
                                "host and %s disagree about struct sizes (parameters %d, control "
                                "%d, sizes %d bytes): rebuild orzo",
                                sim->device->name, sizes[0], sizes[1], sizes[2]);
    }
done:
    if (buffer) {
        clReleaseMemObject(buffer);
    }
    if (kernel) {
        clReleaseKernel(kernel);
    }
    return status;
}

static OzStatus write_control(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->member_count; m++) {
        OZ_TRY(oz_arrays_write(&sim->arrays, OZ_FIELD_control, m, &sim->control[m],
                               sizeof(OzControl)));
    }
done:
    return status;
}

static OzStatus read_control(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->member_count; m++) {
        OZ_TRY(oz_arrays_read(&sim->arrays, OZ_FIELD_control, m, &sim->control[m],
                              sizeof(OzControl)));
    }
done:
    return status;
}

OzStatus oz_sim_write_parameters(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->member_count; m++) {
        OZ_TRY(oz_pack_parameters(&sim->arrays, m, &sim->parameters[m]));
    }
done:
    return status;
}

/* Parameters, lists' sizes and the start of every member. */
static OzStatus upload_start(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->member_count; m++) {
        OZ_TRY(oz_pack_start(&sim->arrays, m, &sim->parameters[m], sim->members[m].grains));
        sim->control[m] = (OzControl){.stale_step = OZ_NEVER,
                                      .stop_step = OZ_NEVER,
                                      .stop_grain = OZ_NEVER,
                                      .truth = OZ_TRUTH_NONE};
    }
    OZ_TRY(oz_sim_write_parameters(sim));
    OZ_TRY(write_control(sim));
done:
    return status;
}

/* Switches and sizes, which all members must share. */
static OzStatus choose_layout(OzSim *sim, OzSwitches *switches, OzSizes *sizes)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->member_count; m++) {
        const OzMember *member = &sim->members[m];
        OzSwitches s = oz_switches_derive(member->scene, member->grains, sim->device);
        OzSizes z;
        OZ_TRY(oz_constants_fill(&sim->parameters[m], sim->wall_order, member->scene,
                                 member->grains));
        oz_sizes_choose(&z, &sim->parameters[m], member->scene, member->grains, &s,
                        sim->member_count);
        bool same = memcmp(&s, switches, sizeof s) == 0 && z.count == sizes->count &&
                    member->scene->step == sim->members[0].scene->step;
        if (m > 0 && !same) {
            status = oz_status_fail(OZ_ERR_INPUT, "%s: members of one launch must have the same "
                                                  "features, number of grains and step",
                                    member->scene->path);
            goto done;
        }
        *switches = s;
        *sizes = z;
    }
done:
    return status;
}

static OzStatus build(OzSim *sim, const OzSwitches *switches, const char *source_dir)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    char options[1024];
    if ((switches->is_double || switches->ledger) && !sim->device->has_double) {
        return oz_status_fail(OZ_ERR_DEVICE,
                              "%s computes in float only: use precision: float without "
                              "observe.ledger",
                              sim->device->name);
    }
    oz_switches_options(switches, options, sizeof options);
    const char *name = switches->resort ? "kernels/rods_large.cl" : "kernels/rods.cl";
    OZ_TRY(oz_program_build(&sim->program, sim->device, source_dir, name, options));
    if (switches->resort) {
        OZ_TRY(oz_large_create(&sim->large, sim->program, sim->device, switches));
    } else {
        sim->advance = clCreateKernel(sim->program, "oz_advance", &code);
        CL_TRY(code);
    }
    OZ_TRY(check_layout(sim, switches));
done:
    return status;
}

OzStatus oz_sim_create(OzSim **out, const OzDevice *device, const OzMember *members,
                       int member_count, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OzSwitches switches = {0};
    OzSizes sizes = {0};
    *out = NULL;
    OZ_TRY(OZ_NEW(&sim, 1));
    sim->device = device;
    sim->member_count = member_count;
    sim->launch_steps = FIRST_LAUNCH;
    OZ_TRY(OZ_NEW(&sim->members, member_count));
    OZ_TRY(OZ_NEW(&sim->parameters, member_count));
    OZ_TRY(OZ_NEW(&sim->control, member_count));
    OZ_TRY(OZ_NEW(&sim->spring_start, member_count));
    memcpy(sim->members, members, (size_t)member_count * sizeof *members);
    OZ_TRY(choose_layout(sim, &switches, &sizes));
    OZ_TRY(build(sim, &switches, source_dir));
    OZ_TRY(oz_arrays_create(&sim->arrays, device, &switches, &sizes));
    OZ_TRY(upload_start(sim));
    OZ_TRY(oz_sim_steps(sim, 0));
    *out = sim;
    sim = NULL;
done:
    oz_sim_free(sim);
    return status;
}

void oz_sim_free(OzSim *sim)
{
    if (!sim) {
        return;
    }
    oz_arrays_free(&sim->arrays);
    oz_large_free(sim->large);
    if (sim->advance) {
        clReleaseKernel(sim->advance);
    }
    if (sim->program) {
        clReleaseProgram(sim->program);
    }
    free(sim->members);
    free(sim->parameters);
    free(sim->control);
    free(sim->spring_start);
    free(sim);
}

/* Offset and velocity of every wall of a member at each step of the launch, and at its end. */
static OzStatus write_motion(OzSim *sim, int member, int64_t first, int steps)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->members[member].scene;
    int walls = sim->arrays.switches.planes + sim->arrays.switches.cylinders;
    size_t count = 2 * (size_t)(steps + 1) * (size_t)walls;
    double *motion = NULL;
    void *narrow = NULL;
    OZ_TRY(OZ_NEW(&motion, count));
    OZ_TRY(oz_memory_new(&narrow, count, sizeof(double), "wall motion"));
    for (int k = 0; k < (sim->walls_still ? 0 : steps + 1); k++) {
        double time = (double)(sim->parameters[member].dt > 0 ? first + k : first) * scene->step;
        for (int w = 0; w < walls; w++) {
            double *words = motion + 2 * ((size_t)k * (size_t)walls + (size_t)w);
            oz_constants_motion(&scene->walls[sim->wall_order[w]].motion, time, &words[0],
                                &words[1]);
        }
    }
    oz_pack_scalars(narrow, motion, count, sim->arrays.switches.is_double);
    OZ_TRY(oz_arrays_write(&sim->arrays, OZ_FIELD_motion, member, narrow,
                           count * (sim->arrays.switches.is_double ? sizeof(double)
                                                                   : sizeof(float))));
done:
    free(motion);
    free(narrow);
    return status;
}

/* Larger lists, after which the kernel takes up where it stopped. */
static OzStatus grow_lists(OzSim *sim)
{
    OzSizes sizes = sim->arrays.sizes;
    for (int m = 0; m < sim->member_count; m++) {
        oz_sizes_grow(&sizes, &sim->control[m], &sim->arrays.switches);
        sim->control[m].full = 0;
    }
    oz_log_detail("lists grown at step %lld: outer %d, inner %d, back %d",
                  (long long)sim->step, sizes.outer_capacity, sizes.inner_capacity,
                  sizes.back_capacity);
    sim->counts.growths++;
    return oz_arrays_resize(&sim->arrays, &sizes);
}

static OzStatus enqueue(OzSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    cl_uint next = 0;
    size_t group = (size_t)sim->arrays.switches.group;
    size_t all = group * (size_t)sim->member_count;
    OZ_TRY(oz_arrays_bind(&sim->arrays, sim->advance, &next));
    CL_TRY(clSetKernelArg(sim->advance, next, sizeof steps, &steps));
    CL_TRY(clEnqueueNDRangeKernel(sim->device->queue, sim->advance, 1, NULL, &all, &group, 0, NULL,
                                  NULL));
    CL_TRY(clFinish(sim->device->queue));
done:
    return status;
}

/* What a guard found, in words. */
static OzStatus guard_spoke(const OzSim *sim, int member)
{
    static const struct {
        int bit;
        const char *text;
    } reasons[] = {
        {OZ_STOP_NAN, "its state is not a number"},
        {OZ_STOP_ESCAPED, "it has left its container"},
        {OZ_STOP_DEEP, "it overlaps another body by more than its radius"},
        {OZ_STOP_FAST, "it moves more than its radius in one step"},
    };
    const OzControl *control = &sim->control[member];
    const OzScene *scene = sim->members[member].scene;
    char text[256] = "";
    for (size_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++) {
        if (control->stop_bits & reasons[i].bit) {
            size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? "; " : "", reasons[i].text);
        }
    }
    int64_t step = sim->launch_first + control->stop_step + 1;
    return oz_status_fail(OZ_ERR_BLOWUP,
                          "%s: stopped at step %lld%s, time %.9g s, grain %d: %s; try a smaller "
                          "time.step (`orzo check` says what is stable)",
                          scene->path, (long long)step, sim->walls_still ? " of settling" : "",
                          (double)step * scene->step, control->stop_grain, text);
}

/* Whether a member has made its steps and its lists hold, or a guard spoke. */
static bool is_through(const OzControl *control, int steps)
{
    bool lists_hold = control->truth == OZ_TRUTH_INNER && control->stale_step == OZ_NEVER;
    return control->stop_bits || (control->step >= steps && lists_hold);
}

/* Repeats the launch until every member is through. */
static OzStatus finish_launch(OzSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    for (bool more = true; more;) {
        OZ_TRY(write_control(sim));
        if (sim->large) {
            OZ_TRY(oz_large_steps(sim->large, &sim->arrays, &sim->control[0], steps));
        } else {
            OZ_TRY(enqueue(sim, steps));
            OZ_TRY(read_control(sim));
        }
        sim->counts.launches++;
        bool full = false;
        more = false;
        for (int m = 0; m < sim->member_count; m++) {
            full |= sim->control[m].full != 0;
            more |= !is_through(&sim->control[m], steps);
        }
        if (full) {
            OZ_TRY(grow_lists(sim));
        } else if (more) {
            OZ_TRY(oz_host_lists_make(sim));
        }
    }
done:
    return status;
}

OzStatus oz_sim_steps(OzSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    sim->launch_first = sim->step;
    for (int m = 0; m < sim->member_count; m++) {
        sim->control[m].step = 0;
        OZ_TRY(write_motion(sim, m, sim->step, steps));
    }
    OZ_TRY(finish_launch(sim, steps));
    int made = steps;
    for (int m = 0; m < sim->member_count; m++) {
        if (sim->control[m].stop_bits) {
            status = guard_spoke(sim, m);
            made = sim->control[m].stop_step + 1;
        }
    }
    sim->step += made;
    sim->counts.steps += made;
done:
    return status;
}

/* velocity-verlet needs the first accelerations: forces at the start, over no time. */
OzStatus oz_sim_prime(OzSim *sim)
{
    OzStatus status = OZ_OK;
    if (sim->arrays.switches.integrator != OZ_INTEGRATOR_VELOCITY_VERLET || sim->primed) {
        return OZ_OK;
    }
    double step = sim->parameters[0].dt;
    for (int m = 0; m < sim->member_count; m++) {
        sim->parameters[m].dt = 0;
    }
    OZ_TRY(oz_sim_write_parameters(sim));
    OZ_TRY(oz_sim_steps(sim, 1));
    sim->step -= 1;
    sim->counts.steps -= 1;
    sim->primed = true;
    for (int m = 0; m < sim->member_count; m++) {
        sim->parameters[m].dt = step;
    }
    OZ_TRY(oz_sim_write_parameters(sim));
done:
    return status;
}

OzStatus oz_sim_launch(OzSim *sim, int64_t step)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_sim_prime(sim));
    if (sim->step >= step || sim->arrays.sizes.count == 0) {
        sim->step = step > sim->step ? step : sim->step;
        goto done;
    }
    int64_t left = step - sim->step;
    int steps = left < sim->launch_steps ? (int)left : sim->launch_steps;
    double start = oz_clock_now();
    OZ_TRY(oz_sim_steps(sim, steps));
    double wanted = launch_seconds / ((oz_clock_now() - start) / steps);
    double most = fmin(4.0 * sim->launch_steps, sim->arrays.sizes.motion_steps);
    if (steps == sim->launch_steps || wanted < sim->launch_steps) {
        sim->launch_steps = (int)fmax(1, fmin(wanted, most));
    }
done:
    return status;
}

OzStatus oz_sim_advance(OzSim *sim, int64_t step)
{
    OzStatus status = OZ_OK;
    while (status == OZ_OK && sim->step < step) {
        status = oz_sim_launch(sim, step);
    }
    return status;
}

int64_t oz_sim_step(const OzSim *sim)
{
    return sim->step;
}

OzSimCounts oz_sim_counts(const OzSim *sim)
{
    OzSimCounts counts = sim->counts;
    counts.refreshes = sim->control[0].refreshes;
    counts.rebuilds = sim->control[0].rebuilds;
    counts.crossed = sim->control[0].crossed;
    return counts;
}

OzStatus oz_sim_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                         FILE *file)
{
    OzStatus status = OZ_OK;
    OzParameters parameters;
    int order[OZ_WALLS_MAX];
    OzSizes sizes;
    OzSwitches switches = oz_switches_derive(scene, grains, device);
    OZ_TRY(oz_constants_fill(&parameters, order, scene, grains));
    oz_sizes_choose(&sizes, &parameters, scene, grains, &switches, 1);
    oz_switches_print(&switches, file);
    fprintf(file, "device memory of one scene on %s:\n", device->name);
    oz_arrays_print(&switches, &sizes, file);
done:
    return status;
}
