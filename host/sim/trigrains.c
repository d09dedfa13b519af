/* Trigrains' part of a simulation, and the model's row. */
#include "sim/trigrains.h"

#include "base/memory.h"
#include "compute/cl_try.h"
#include "sim/element_guard.h"
#include "sim/element_motion.h"
#include "sim/element_pack.h"
#include "sim/element_private.h"
#include "sim/element_read_snapshot.h"
#include "sim/element_sizes.h"
#include "sim/element_upload.h"
#include "sim/launch.h"

#include <stddef.h>
#include <stdlib.h>

enum { JUDGE_STEPS = 512 };

_Static_assert(offsetof(OzElementSwitches, ledger) == offsetof(OzSwitchesHead, ledger) &&
                   offsetof(OzElementSwitches, lanes) == offsetof(OzSwitchesHead, lanes) &&
                   offsetof(OzElementSwitches, group) == offsetof(OzSwitchesHead, group),
               "switches begin with what the driver reads");

static const OzSwitch switch_rows[] = {
#define ROW(name, member, left_out) {#name, left_out},
    OZ_ELEMENT_SWITCHES(ROW)
#undef ROW
};

static void derive(void *switches, const OzScene *scene, const OzGrains *grains,
                   const OzDevice *device)
{
    *(OzElementSwitches *)switches = oz_element_switches_derive(scene, grains, device);
}

static const char *program(const void *switches)
{
    (void)switches;
    return "kernels/trigrains.cl";
}

static int64_t count_elements(const OzGrains *grains)
{
    return grains->elements->count;
}

/* Numbers of elements may differ, if one work-group a scene can do them. */
static bool fits(const OzMember *a, const OzMember *b, const void *switches)
{
    return !((const OzElementSwitches *)switches)->resort && a->scene->wall_count == b->scene->wall_count;
}

static OzStatus open(OzSim *sim)
{
    cl_int code = CL_SUCCESS;
    OzTrigrains *own = NULL;
    OZ_PASS(OZ_NEW(&own, 1));
    sim->own = own;
    OZ_PASS(OZ_NEW(&own->present, sim->batch.member_count));
    own->begin = clCreateKernel(sim->program, "oz_begin", &code);
    CL_PASS(code);
    return OZ_OK;
}

static void close(OzSim *sim)
{
    OzTrigrains *own = sim->own;
    if (own) {
        CL_RELEASE(Kernel, own->begin);
        free(own->present);
        free(own);
    }
}

/* The start, and the records of elements and walls. */
static OzStatus start(OzSim *sim)
{
    sim->batch.walls_still = sim->batch.members[0].scene->settle.present;
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(oz_element_upload_member(sim, m));
    }
    OZ_PASS(oz_sim_write_parameters(sim));
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(oz_element_motion_write_motion(sim, m, 0));
    }
    OZ_PASS(oz_launch_write_control(sim));
    return oz_launch_enqueue(sim, oz_element_own(sim)->begin, -1);
}

static OzStatus write_parameters(OzSim *sim, int member)
{
    return oz_element_pack_parameters(&sim->arrays, member, oz_element_parameters(sim, member));
}

static OzStatus own_state(OzSim *sim, OzStateVisit *visit)
{
    return oz_state_items(visit, "present", "bits, one a wall", OZ_STATE_INT32,
                          oz_element_own(sim)->present, sim->batch.member_count);
}

/* States are counted in powers of the step, as many as the integrator keeps. */
static OzStatus adopt(OzSim *sim, const OzSim *from, int member, double step)
{
    return oz_element_pack_adopt(&sim->arrays, &from->arrays, member,
                                 oz_element_parameters(sim, member)->dt / step);
}

const OzModel oz_trigrains_model = {
    .name = "trigrains",
    .field_count = OZ_ELEMENT_FIELD_COUNT,
    .control_field = OZ_ELEMENT_FIELD_control,
    .fields = oz_element_fields_rows,
    .field_bytes = oz_element_fields_bytes,
    .body = "piece",
    .body_count = count_elements,
    .switches_bytes = sizeof(OzElementSwitches),
    .sizes_bytes = sizeof(OzElementSizes),
    .parameters_bytes = sizeof(OzElementParameters),
    .control_bytes = sizeof(OzElementControl),
    .switch_count = sizeof switch_rows / sizeof switch_rows[0],
    .switches = switch_rows,
    .derive = derive,
    .program = program,
    .fill = oz_element_sizes_parameters,
    .choose = oz_element_sizes_choose,
    .join = oz_element_sizes_join,
    .fits = fits,
    .alike = "features, walls, step and settling",
    .open = open,
    .start = start,
    .close = close,
    .write_parameters = write_parameters,
    .steps_alike = oz_element_motion_steps_alike,
    .prepare = oz_element_motion_prepare,
    .state = own_state,
    .adopt = adopt,
    .unpack = oz_element_read_snapshot_state,
    .contacts = oz_element_read_snapshot_contacts,
    .energy = oz_element_read_snapshot_energy,
    .judge_steps = JUDGE_STEPS,
    .ledger_field = OZ_ELEMENT_FIELD_ledger,
    .ledger_words = OZ_ELEMENT_LEDGER_WORDS,
    .stop_count = OZ_ELEMENT_GUARD_STOPS,
    .stops = oz_element_guard_stops,
    .grain_of = oz_element_guard_grain,
    .advise = oz_element_guard_advise,
};
