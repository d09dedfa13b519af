/* Trigrains' part of a simulation, what its guards say, and the model's row. In a snapshot free
 * elements are downloaded, those of walls follow from the time, and the host finds the contacts. */
#include "sim/trigrains.h"

#include "base/memory.h"
#include "compute/cl_try.h"
#include "kernels/element_layout.h"
#include "model/wall_motion.h"
#include "sim/element_advice.h"
#include "sim/element_forces.h"
#include "sim/element_mend.h"
#include "sim/element_motion.h"
#include "sim/element_pack.h"
#include "sim/element_private.h"
#include "sim/element_sizes.h"
#include "sim/element_upload.h"
#include "sim/element_wear.h"
#include "sim/launch.h"
#include "sim/read_snapshot.h"
#include "sim/units.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static int64_t count_elements(const OzGrains *grains)
{
    return grains->elements->count;
}

/* Numbers of elements may differ, if one work-group a scene can do them. */
static bool fits(const OzMember *a, const OzMember *b, const void *switches)
{
    return !((const OzElementSwitches *)switches)->resort &&
           a->scene->wall_count == b->scene->wall_count;
}

static OzStatus open(OzSim *sim)
{
    cl_int code = CL_SUCCESS;
    OzTrigrains *own = NULL;
    OZ_PASS(OZ_NEW(&own, 1));
    sim->own = own;
    OZ_PASS(OZ_NEW(&own->present, sim->batch.member_count));
    OZ_PASS(OZ_NEW(&own->outlined, sim->batch.member_count));
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
        free(own->outlined);
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

/* Beams bear anything while grains settle. */
static OzStatus write_parameters(OzSim *sim, int member)
{
    OzElementParameters p = *oz_element_parameters(sim, member);
    if (sim->batch.walls_still) {
        p.strength = p.yield = (OzBeamStrength){0};
    }
    return oz_element_pack_parameters(&sim->arrays, member, &p);
}

static OzStatus prepare(OzSim *sim, int member, int steps)
{
    if (oz_element_switches(sim)->strength) {
        OZ_PASS(write_parameters(sim, member)); /* settling may have ended */
        OZ_PASS(oz_element_mend_outline(sim, member));
    }
    return oz_element_motion_prepare(sim, member, steps);
}

static OzStatus own_state(OzSim *sim, OzStateVisit *visit)
{
    size_t members = (size_t)sim->batch.member_count;
    memset(oz_element_own(sim)->outlined, 0, members * sizeof(bool)); /* to be made again */
    return oz_state_items(visit, "present", "bits, one a wall", OZ_STATE_INT32,
                          oz_element_own(sim)->present, sim->batch.member_count);
}

/* States are counted in powers of the step, as many as the integrator keeps. */
static OzStatus adopt(OzSim *sim, const OzSim *from, int member, double step)
{
    return oz_element_pack_adopt(&sim->arrays, &from->arrays, member,
                                 oz_element_parameters(sim, member)->dt / step);
}

enum { PREDICT, CLASSIFY, CONTACTS, BEAMS, LOADS, CORRECT, REFRESH, REBUILD, STAGES };

#define REPEATED "kernel, repeated on the state as it is"

/* The rows of Table 1 of Poeschel and Buchholtz (1995). */
static const OzTimedStage stages[STAGES] = {
    [PREDICT] = {"predictor", "oz_repeat_predict_correct", OZ_TIMED_STEP, CORRECT, false,
                 "kernel, corrector and predictor, difference"},
    [CLASSIFY] = {"classifying", "oz_repeat_classify", OZ_TIMED_STEP, OZ_TIMED_NONE, false,
                  REPEATED},
    [CONTACTS] = {"contact forces", "oz_repeat_contacts", OZ_TIMED_STEP, OZ_TIMED_NONE, false,
                  REPEATED},
    [BEAMS] = {"beams", "oz_repeat_beams", OZ_TIMED_STEP, OZ_TIMED_NONE, false, REPEATED},
    [LOADS] = {"adding up", "oz_repeat_loads", OZ_TIMED_STEP, OZ_TIMED_NONE, false, REPEATED},
    [CORRECT] = {"corrector", "oz_repeat_correct", OZ_TIMED_STEP, OZ_TIMED_NONE, false, REPEATED},
    [REFRESH] = {"inner list", "oz_repeat_refresh", OZ_TIMED_REFRESH, OZ_TIMED_NONE, false,
                 "made anew"},
    [REBUILD] = {"outer list", "oz_repeat_rebuild", OZ_TIMED_REBUILD, REFRESH, false,
                 "the same with the outer list, difference"},
};

static const OzStop stops[] = {
    {OZ_ELEMENT_STOP_NAN, "its state is not a number"},
    {OZ_ELEMENT_STOP_ESCAPED, "it has left its container"},
    {OZ_ELEMENT_STOP_SWALLOWED, "a triangle of it is wholly inside another, or around one"},
    {OZ_ELEMENT_STOP_DEEP, "an element of it overlaps another body by more than half"},
    {OZ_ELEMENT_STOP_STRETCHED, "a beam of it is shorter than half or longer than 1.5 times its "
                                "length at rest"},
    {OZ_ELEMENT_STOP_BENT, "a beam of it is bent by more than 1 rad"},
    {OZ_ELEMENT_STOP_FAST, "an element of it moves more than half its thickness in one step"},
};

static int grain_of(const OzGrains *grains, int slot)
{
    const OzElements *elements = grains->elements;
    return slot >= 0 && slot < elements->free_count ? elements->body[slot] : -1;
}

/* What would help: the step only where it is to blame. */
static void advise(char *text, size_t size, const OzControlHead *control, const OzSnapshot *now)
{
    static const struct {
        int bits;
        OzElementSoft soft;
    } soft[] = {
        {OZ_ELEMENT_STOP_SWALLOWED | OZ_ELEMENT_STOP_DEEP, OZ_ELEMENT_SOFT_CONTACT},
        {OZ_ELEMENT_STOP_BENT, OZ_ELEMENT_SOFT_BENDING},
        {OZ_ELEMENT_STOP_STRETCHED, OZ_ELEMENT_SOFT_STRETCH},
    };
    bool known = grain_of(now->grains, control->stop_index) >= 0;
    snprintf(text, size, "`orzo check` says what step is stable");
    if (control->stop_bits & OZ_ELEMENT_STOP_FAST) {
        snprintf(text, size, "try a smaller time.step (`orzo check` says what is stable)");
        return;
    }
    if (control->stop_bits == OZ_ELEMENT_STOP_ESCAPED) {
        snprintf(text, size, "no wall holds it");
        return;
    }
    for (size_t i = 0; i < sizeof soft / sizeof soft[0]; i++) {
        if (known && !(control->stop_bits & OZ_ELEMENT_STOP_NAN) &&
            (control->stop_bits & soft[i].bits)) {
            oz_element_advice_write(text, size, now, control->stop_index, soft[i].soft);
            return;
        }
    }
}

static OzStatus unpack(OzSim *sim, int member, OzSnapshot *snapshot)
{
    const OzScene *scene = sim->batch.members[member].scene;
    const OzElementParameters *p = oz_element_parameters(sim, member);
    OZ_PASS(oz_element_pack_state(&sim->arrays, member, p, snapshot));
    OZ_PASS(oz_element_wear_read(&sim->arrays, member, &p->units, &snapshot->wear));
    OZ_PASS(oz_snapshot_split(snapshot));
    oz_wall_motion_place(snapshot->grains->elements, scene, snapshot->time, sim->batch.walls_still,
                         snapshot->element_position, snapshot->element_angle,
                         snapshot->element_velocity, snapshot->element_angular_velocity);
    oz_snapshot_join_elements(snapshot);
    return OZ_OK;
}

/* Impulses of walls about their points, from those about the origin. */
static OzStatus find_impulses(OzSim *sim, int member, OzSnapshot *snapshot)
{
    double sum[OZ_ELEMENT_WALLS_MAX][OZ_ELEMENT_IMPULSE_WORDS] = {{0}};
    const OzScene *scene = sim->batch.members[member].scene;
    const OzUnits *units = &oz_element_parameters(sim, member)->units;
    double push = oz_units_force(units) * units->time, turn = oz_units_energy(units) * units->time;
    OZ_PASS(oz_read_snapshot_sums(sim, member, OZ_ELEMENT_FIELD_wall_impulse,
                                  scene->wall_count * OZ_ELEMENT_IMPULSE_WORDS, sum[0]));
    memset(snapshot->wall_impulse, 0, (size_t)scene->wall_count * sizeof *snapshot->wall_impulse);
    for (int w = 0; w < scene->wall_count; w++) {
        double *to = snapshot->wall_impulse[w];
        const double *home = scene->walls[w].point;
        to[0] = sum[w][0] * push;
        to[1] = sum[w][1] * push;
        to[5] = sum[w][2] * turn - (home[0] * to[1] - home[1] * to[0]);
    }
    snapshot->has_wall_impulse = true;
    return OZ_OK;
}

static OzStatus find_contacts(OzSim *sim, int member, OzSnapshot *snapshot)
{
    if (sim->batch.stopped[member]) {
        return OZ_OK;
    }
    OZ_PASS(oz_element_forces_contacts(snapshot));
    if (oz_element_switches(sim)->impulses) {
        OZ_PASS(find_impulses(sim, member, snapshot));
    }
    if (oz_element_switches(sim)->ledger) {
        double sum[OZ_ELEMENT_LEDGER_WORDS] = {0};
        OZ_PASS(oz_read_snapshot_ledger(sim, member, sum));
#define TAKE(NAME, entry, column, meaning) snapshot->element_ledger.entry = sum[OZ_PL_##NAME];
        OZ_ELEMENT_LEDGER_LOSSES(TAKE)
        OZ_LEDGER_WORK(TAKE)
#undef TAKE
        snapshot->element_ledger.beam_broken = oz_wear_lost(&snapshot->wear);
        snapshot->element_ledger.beam_yielded = oz_wear_yielded(&snapshot->wear);
        snapshot->has_ledger = true;
    }
    return OZ_OK;
}

/* Elements move against each other: the energy is theirs, not the grains'. */
static double energy_of(const OzSnapshot *now)
{
    const OzElements *elements = now->grains->elements;
    double energy = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *v = &now->element_velocity[2 * i], w = now->element_angular_velocity[i];
        energy +=
            0.5 * (elements->mass[i] * (v[0] * v[0] + v[1] * v[1]) + elements->inertia[i] * w * w);
    }
    return energy;
}

const OzModel oz_trigrains_model = {
    .name = "trigrains",
    .field_count = OZ_ELEMENT_FIELD_COUNT,
    .control_field = OZ_ELEMENT_FIELD_control,
    .fields = oz_element_fields_rows,
    .field_items = oz_element_fields_items,
    .body = "element",
    .body_count = count_elements,
    .switches_bytes = sizeof(OzElementSwitches),
    .sizes_bytes = sizeof(OzElementSizes),
    .parameters_bytes = sizeof(OzElementParameters),
    .control_bytes = sizeof(OzElementControl),
    .switch_count = sizeof switch_rows / sizeof switch_rows[0],
    .switches = switch_rows,
    .derive = derive,
    .program = "kernels/trigrains.cl",
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
    .prepare = prepare,
    .mend = oz_element_mend_member,
    .state = own_state,
    .adopt = adopt,
    .unpack = unpack,
    .contacts = find_contacts,
    .energy = energy_of,
    .judge_steps = JUDGE_STEPS,
    .stage_count = STAGES,
    .contact_stage = CONTACTS,
    .stages = stages,
    .stage_program = "kernels/element_stage_timing.cl",
    .repeats_most = 2048, /* elements under loads that never change go too far after more */
    .ledger_field = OZ_ELEMENT_FIELD_ledger,
    .ledger_words = OZ_ELEMENT_LEDGER_WORDS,
    .start_ledger = oz_element_mend_start_ledger,
    .stop_count = sizeof stops / sizeof stops[0],
    .stops = stops,
    .grain_of = grain_of,
    .advise = advise,
};
