/* Queueing the phases of large scenes. */
#include "sim/large.h"

#include "base/memory.h"
#include "compute/cl_try.h"

#include <stdlib.h>

/* THE phases: kernel and whether one work-item does it all. */
#define PHASES(X)                                                                                  \
    X(before, false)                                                                               \
    X(tiles, false)                                                                                \
    X(pairs, false)                                                                                \
    X(grains, false)                                                                               \
    X(sum, false)                                                                                  \
    X(total, true)                                                                                 \
    X(after, false)                                                                                \
    X(measure, false)                                                                              \
    X(mark, true)                                                                                  \
    X(save, false)                                                                                 \
    X(clear, false)                                                                                \
    X(bin, false)                                                                                  \
    X(scan, true)                                                                                  \
    X(fill, false)                                                                                 \
    X(arrange, false)                                                                              \
    X(plan, true)                                                                                  \
    X(move_out, false)                                                                             \
    X(move_in, false)                                                                              \
    X(search, false)                                                                               \
    X(restore, false)                                                                              \
    X(reset, false)                                                                                \
    X(select, false)                                                                               \
    X(order, false)                                                                                \
    X(forget, false)

typedef enum Phase {
#define ID(name, alone) PHASE_##name,
    PHASES(ID)
#undef ID
        PHASE_COUNT
} Phase;

struct OzLarge {
    const OzDevice *device;
    cl_kernel kernel[PHASE_COUNT]; /* NULL: the program has none                         */
    double interval;               /* steps that the inner lists lasted lately           */
};

static const char *const kernel_names[] = {
#define NAME(name, alone) "oz_" #name,
    PHASES(NAME)
#undef NAME
};

static const bool single[] = {
#define ALONE(name, alone) alone,
    PHASES(ALONE)
#undef ALONE
};

/* Phases that not every program has. */
static bool may_be_absent(Phase phase)
{
    return phase == PHASE_before || phase == PHASE_tiles || phase == PHASE_pairs ||
           phase == PHASE_grains || phase == PHASE_sum || phase == PHASE_total ||
           phase == PHASE_after || phase == PHASE_plan || phase == PHASE_move_out ||
           phase == PHASE_move_in;
}

OzStatus oz_large_create(OzLarge **out, cl_program program, const OzDevice *device)
{
    OzStatus status = OZ_OK;
    OzLarge *large = NULL;
    cl_int code = CL_SUCCESS;
    OZ_TRY(OZ_NEW(&large, 1));
    large->device = device;
    large->interval = 8;
    for (int p = 0; p < PHASE_COUNT; p++) {
        large->kernel[p] = clCreateKernel(program, kernel_names[p], &code);
        if (code != CL_INVALID_KERNEL_NAME || !may_be_absent((Phase)p)) {
            CL_TRY(code);
        }
    }
    *out = large;
    large = NULL;
done:
    oz_large_free(large);
    return status;
}

void oz_large_free(OzLarge *large)
{
    for (int p = 0; large && p < PHASE_COUNT; p++) {
        CL_RELEASE(Kernel, large->kernel[p]);
    }
    free(large);
}

/* Puts one phase in the queue; number is the kernel's last argument. */
static OzStatus queue_phase(OzLarge *large, OzArrays *arrays, Phase phase, int number)
{
    cl_kernel kernel = large->kernel[phase];
    size_t group = (size_t)oz_arrays_switches(arrays)->group, items = group;
    if (!kernel) {
        return OZ_OK;
    }
    if (!single[phase]) {
        items = ((size_t)oz_arrays_sizes(arrays)->regions + group - 1) / group * group;
    }
    CL_PASS(
        clSetKernelArg(kernel, (cl_uint)arrays->model->field_count + 1, sizeof number, &number));
    CL_PASS(clEnqueueNDRangeKernel(large->device->queue, kernel, 1, NULL, &items, &group, 0, NULL,
                                   NULL));
    return OZ_OK;
}

static OzStatus queue_phases(OzLarge *large, OzArrays *arrays, const Phase *phases, int count)
{
    for (int i = 0; i < count; i++) {
        OZ_PASS(queue_phase(large, arrays, phases[i], 0));
    }
    return OZ_OK;
}

static OzStatus queue_save(OzLarge *large, OzArrays *arrays, const OzControlHead *control)
{
    if (control->truth == OZ_SPRINGS_AT_OUTER) {
        OZ_PASS(queue_phase(large, arrays, PHASE_save, 0));
        OZ_PASS(queue_phase(large, arrays, PHASE_mark, OZ_SPRINGS_AT_SAVED));
    }
    return OZ_OK;
}

/* The outer lists anew, with the grains put in the order of cells on the way. */
static OzStatus queue_rebuild(OzLarge *large, OzArrays *arrays, const OzControlHead *control)
{
    static const Phase sort[] = {PHASE_clear,   PHASE_bin,    PHASE_scan,     PHASE_fill,
                                 PHASE_arrange, PHASE_plan,   PHASE_move_out, PHASE_move_in,
                                 PHASE_search,  PHASE_restore};
    OZ_PASS(queue_save(large, arrays, control));
    OZ_PASS(queue_phases(large, arrays, sort, sizeof sort / sizeof sort[0]));
    return queue_phase(large, arrays, PHASE_mark, OZ_SPRINGS_AT_OUTER);
}

static OzStatus queue_refresh(OzLarge *large, OzArrays *arrays)
{
    static const Phase phases[] = {PHASE_reset, PHASE_select, PHASE_order, PHASE_forget};
    OzStatus status = queue_phases(large, arrays, phases, sizeof phases / sizeof phases[0]);
    return status == OZ_OK ? queue_phase(large, arrays, PHASE_mark, OZ_SPRINGS_AT_INNER) : status;
}

static OzStatus read_control(const OzArrays *arrays, OzControlHead *control)
{
    return oz_arrays_read(arrays, arrays->model->control_field, 0, control,
                          arrays->model->control_bytes);
}

static OzStatus write_control(OzArrays *arrays, const OzControlHead *control)
{
    return oz_arrays_write(arrays, arrays->model->control_field, 0, control,
                           arrays->model->control_bytes);
}

/* Whether the lists hold, for the next step and for places that it has moved already. */
static bool hold(const OzControlHead *control)
{
    return control->truth == OZ_SPRINGS_AT_INNER && control->stale_step == OZ_NEVER &&
           control->stale_positions == OZ_NEVER;
}

/* Skins as they are used up now, and springs back to the outer lists. */
static OzStatus harvest(OzLarge *large, OzArrays *arrays, OzControlHead *control)
{
    OZ_PASS(queue_phase(large, arrays, PHASE_measure, 0));
    OZ_PASS(read_control(arrays, control));
    if (control->truth == OZ_SPRINGS_AT_INNER) {
        control->truth = OZ_SPRINGS_AT_OUTER; /* measuring has harvested the springs */
        OZ_PASS(write_control(arrays, control));
    }
    return OZ_OK;
}

/* Lists that hold, from whatever there is. *waits: the host has to make one. */
static OzStatus renew(OzLarge *large, OzArrays *arrays, OzControlHead *control, bool *waits)
{
    *waits = false;
    OZ_PASS(harvest(large, arrays, control));
    bool holds = control->truth == OZ_SPRINGS_AT_OUTER && !control->outer_stale;
    if (!holds && oz_arrays_switches(arrays)->host_lists) {
        *waits = true;
        return OZ_OK;
    }
    if (!holds) {
        OZ_PASS(queue_rebuild(large, arrays, control));
    }
    OZ_PASS(queue_refresh(large, arrays));
    int refreshes = control->refreshes + 1, rebuilds = control->rebuilds + !holds;
    OZ_PASS(read_control(arrays, control));
    control->refreshes = refreshes;
    control->rebuilds = rebuilds;
    OZ_PASS(write_control(arrays, control));
    return OZ_OK;
}

static OzStatus queue_step(OzLarge *large, OzArrays *arrays, int step)
{
    static const Phase phases[] = {PHASE_before, PHASE_tiles, PHASE_pairs, PHASE_grains,
                                   PHASE_sum,    PHASE_total, PHASE_after};
    for (size_t i = 0; i < sizeof phases / sizeof phases[0]; i++) {
        OZ_PASS(queue_phase(large, arrays, phases[i], step));
    }
    return OZ_OK;
}

/* Queues about as many steps as the lists will last, and waits. */
static OzStatus run_batch(OzLarge *large, OzArrays *arrays, OzControlHead *control, int steps)
{
    int first = control->step, count = (int)large->interval + 2;
    int last = first + count < steps ? first + count : steps;
    for (int step = first; step < last; step++) {
        OZ_PASS(queue_step(large, arrays, step));
    }
    OZ_PASS(read_control(arrays, control));
    if (control->stale_positions != OZ_NEVER) {
        control->moved = 1; /* the step goes on with its forces once lists hold */
        OZ_PASS(write_control(arrays, control));
    }
    bool used_up = !hold(control);
    double lasted = control->step - first;
    large->interval = used_up ? 0.5 * (large->interval + lasted) : large->interval + 1;
    return OZ_OK;
}

static OzStatus bind_all(OzLarge *large, OzArrays *arrays)
{
    for (int p = 0; p < PHASE_COUNT; p++) {
        cl_uint next = 0;
        if (large->kernel[p]) {
            OZ_PASS(oz_arrays_bind(arrays, large->kernel[p], &next));
        }
    }
    return OZ_OK;
}

OzStatus oz_large_steps(OzLarge *large, OzArrays *arrays, OzControlHead *control, int steps)
{
    bool waits = false;
    OZ_PASS(bind_all(large, arrays));
    for (;;) {
        if (control->stop_bits || control->full || waits ||
            (hold(control) && control->step >= steps)) {
            break;
        }
        if (!hold(control)) {
            OZ_PASS(renew(large, arrays, control, &waits));
        } else {
            OZ_PASS(run_batch(large, arrays, control, steps));
        }
    }
    return OZ_OK;
}

OzStatus oz_large_renew(OzLarge *large, OzArrays *arrays, OzControlHead *control, bool outer)
{
    bool waits = false;
    OZ_PASS(bind_all(large, arrays));
    OZ_PASS(read_control(arrays, control));
    control->outer_stale = outer;
    OZ_PASS(write_control(arrays, control));
    return renew(large, arrays, control, &waits);
}

OzStatus oz_large_save_springs(OzLarge *large, OzArrays *arrays, OzControlHead *control)
{
    OZ_PASS(bind_all(large, arrays));
    OZ_PASS(harvest(large, arrays, control));
    OZ_PASS(queue_save(large, arrays, control));
    return read_control(arrays, control);
}
