/* Rods' part of a simulation, what its guards say, and the model's row. */
#include "sim/rods.h"

#include "base/memory.h"
#include "model/motion.h"
#include "scene/boundary.h"
#include "scene/wall_mesh.h"
#include "sim/advice.h"
#include "sim/constants.h"
#include "sim/gates.h"
#include "sim/host_lists.h"
#include "sim/launch.h"
#include "sim/law_table.h"
#include "sim/mesh_pack.h"
#include "sim/pack.h"
#include "sim/rods_private.h"
#include "sim/rods_read_snapshot.h"
#include "sim/servos.h"
#include "sim/sides.h"
#include "sim/sizes.h"
#include "sim/swings.h"
#include "sim/units.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

enum { JUDGE_STEPS = 128 };

_Static_assert(offsetof(OzSwitches, ledger) == offsetof(OzSwitchesHead, ledger) &&
                   offsetof(OzSwitches, lanes) == offsetof(OzSwitchesHead, lanes) &&
                   offsetof(OzSwitches, group) == offsetof(OzSwitchesHead, group),
               "switches begin with what the driver reads");

static const OzSwitch switch_rows[] = {
#define ROW(name, member, left_out) {#name, left_out},
    OZ_SWITCHES(ROW)
#undef ROW
};

static void derive(void *switches, const OzScene *scene, const OzGrains *grains,
                   const OzDevice *device)
{
    *(OzSwitches *)switches = oz_switches_derive(scene, grains, device);
}

static void print_more_left_out(const void *switches, const char *separator, FILE *file)
{
    const OzSwitches *s = switches;
    if (s->round) {
        fprintf(file, "%sshafts (spheres only)", separator);
        separator = ", ";
    }
    if (s->equal) {
        fprintf(file, "%ssize and mass of each grain (all equal)", separator);
    }
}

static int64_t count_grains(const OzGrains *grains)
{
    return grains->count;
}

static OzStatus fill(void *parameters, const OzScene *scene, const OzGrains *grains,
                     const void *running)
{
    int order[OZ_WALLS_MAX];
    return oz_constants_refill(parameters, order, scene, grains, running);
}

/* Walls are numbered by kind in the kernels, one numbering for all members. */
static bool same_walls(const OzScene *a, const OzScene *b)
{
    OzWallSide one[OZ_WALLS_MAX], other[OZ_WALLS_MAX];
    int count = oz_sides_list(one, a), other_count = oz_sides_list(other, b);
    for (int k = 0; k < count && k < other_count && k < OZ_WALLS_MAX; k++) {
        if (one[k].shape.kind != other[k].shape.kind || one[k].wall != other[k].wall) {
            return false;
        }
    }
    return count == other_count;
}

/* A size and a way of making lists that one work-group a scene can do. */
static bool fits(const OzMember *a, const OzMember *b, const void *switches)
{
    const OzSwitches *s = switches;
    return !s->resort && !s->host_lists && a->grains->count == b->grains->count &&
           same_walls(a->scene, b->scene);
}

static OzStatus open(OzSim *sim)
{
    OzRods *own = NULL;
    OzParameters parameters;
    const OzMember *first = &sim->batch.members[0];
    OZ_PASS(OZ_NEW(&own, 1));
    sim->own = own;
    OZ_PASS(OZ_NEW(&own->spring_start, sim->batch.member_count));
    return oz_constants_fill(&parameters, own->wall_order, first->scene, first->grains);
}

static void close(OzSim *sim)
{
    OzRods *own = sim->own;
    if (own) {
        free(own->spring_start);
        free(own);
    }
}

static OzStatus start(OzSim *sim)
{
    int made = 0;
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(oz_pack_start(&sim->arrays, m, oz_rods_parameters(sim, m),
                              sim->batch.members[m].grains));
        *oz_rods_control(sim, m) = (OzControl){.stale_step = OZ_NEVER,
                                               .stale_positions = OZ_NEVER,
                                               .stop_step = OZ_NEVER,
                                               .stop_index = OZ_NEVER,
                                               .truth = OZ_SPRINGS_AT_NONE};
    }
    OZ_PASS(oz_sim_write_parameters(sim));
    return oz_launch_steps(sim, 0, &made);
}

static OzStatus write_parameters(OzSim *sim, int member)
{
    const OzParameters *parameters = oz_rods_parameters(sim, member);
    OZ_PASS(oz_pack_parameters(&sim->arrays, member, parameters));
    OZ_PASS(oz_law_table_write(&sim->arrays, member, &sim->batch.members[member],
                               oz_rods_own(sim)->wall_order, parameters));
    return oz_mesh_pack_write(&sim->arrays, member, sim->batch.members[member].scene, parameters);
}

/* velocity-verlet needs the first accelerations: forces at the start, over no time. */
static OzStatus prime(OzSim *sim)
{
    int made = 0;
    if (!oz_rods_switches(sim)->moves_before || oz_rods_own(sim)->primed) {
        return OZ_OK;
    }
    double step = oz_rods_parameters(sim, 0)->dt;
    for (int m = 0; m < sim->batch.member_count; m++) {
        oz_rods_parameters(sim, m)->dt = 0;
    }
    OZ_PASS(oz_sim_write_parameters(sim));
    OZ_PASS(oz_launch_steps(sim, 1, &made));
    sim->batch.step -= 1;
    sim->batch.counts.steps -= 1;
    oz_rods_own(sim)->primed = true;
    for (int m = 0; m < sim->batch.member_count; m++) {
        sim->batch.reached[m] -= 1;
        oz_rods_parameters(sim, m)->dt = step;
    }
    return oz_sim_write_parameters(sim);
}

static void put_motion(double words[OZ_MOTION], const OzMotion *motion, double time,
                       const OzParameters *p)
{
    double offset, speed;
    oz_motion_offset(motion, time, &offset, &speed);
    words[OZ_M_OFFSET] = offset / p->units.length;
    words[OZ_M_SPEED] = speed / oz_units_speed(&p->units);
    words[OZ_M_RISE] = rint(offset / p->length_unit);
    words[OZ_M_RISE_REST] = offset / p->length_unit - words[OZ_M_RISE];
    words[OZ_M_RATE] = oz_motion_rate(motion, time) * p->units.time;
}

/* How a sheared cell stands, for the same steps. */
static OzStatus move_cell(OzSim *sim, int member, int steps)
{
    OzStatus status = OZ_OK;
    const OzBoundary *cell = &sim->batch.members[member].scene->boundary;
    const OzParameters *p = oz_rods_parameters(sim, member);
    double *words = NULL, turns = 0;
    size_t count = OZ_SHEAR_WORDS * (size_t)(steps + 1);
    if (!oz_rods_switches(sim)->shear) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&words, count));
    for (int k = 0; k < steps + 1; k++) {
        double time = oz_batch_time(&sim->batch, member, sim->batch.step + (p->dt > 0 ? k : 0));
        double strain = oz_boundary_strain(cell, time, sim->batch.walls_still), before = turns;
        double tilt = oz_boundary_tilt(cell, strain), *at = words + OZ_SHEAR_WORDS * k;
        turns = oz_boundary_turns(cell, strain);
        at[OZ_H_TILT] = oz_rods_switches(sim)->is_double ? tilt : (double)(float)tilt;
        at[OZ_H_TILT_REST] = tilt - at[OZ_H_TILT];
        at[OZ_H_RATE] = sim->batch.walls_still ? 0 : cell->shear_rate * p->units.time;
        at[OZ_H_TURNS] = k > 0 ? turns - before : 0;
    }
    OZ_TRY(oz_arrays_write_scalars(&sim->arrays, OZ_FIELD_shear, member, words, count));
done:
    free(words);
    return status;
}

OzStatus oz_rods_move_walls(OzSim *sim, int member, int steps)
{
    OzStatus status = OZ_OK;
    int64_t first = sim->batch.step;
    const OzScene *scene = sim->batch.members[member].scene;
    const OzParameters *p = oz_rods_parameters(sim, member);
    const int *order = oz_rods_own(sim)->wall_order;
    int walls = oz_rods_switches(sim)->walls, swung = oz_rods_switches(sim)->swung;
    size_t count = OZ_MOTION * (size_t)(steps + 1) * (size_t)walls;
    double *motion = NULL, *swing = NULL;
    if (oz_rods_switches(sim)->servos > 0) {
        OZ_TRY(oz_servos_hold(sim, member));
    }
    OZ_TRY(move_cell(sim, member, steps));
    OZ_TRY(OZ_NEW(&motion, count));
    OZ_TRY(OZ_NEW(&swing, swung ? count / OZ_MOTION * OZ_SWING : 1));
    for (int k = 0; k < steps + 1; k++) {
        double times[3];
        for (int i = 0; i < 3; i++) {
            times[i] = oz_batch_time(&sim->batch, member, p->dt > 0 ? first + k + i - 1 : first);
        }
        for (int w = 0; w < walls; w++) {
            size_t at = (size_t)k * (size_t)walls + (size_t)w;
            double *words = motion + OZ_MOTION * at;
            const OzWall *wall = &scene->walls[order[w]];
            if (!sim->batch.walls_still) {
                put_motion(words, &wall->motion, times[1], p);
            }
            words[OZ_M_GATE] = oz_gates_bits(wall, times, sim->batch.walls_still);
            if (swung) {
                oz_swings_words(swing + OZ_SWING * at, scene, order, w, times[1],
                                sim->batch.walls_still, &p->units);
            }
        }
    }
    OZ_TRY(oz_arrays_write_scalars(&sim->arrays, OZ_FIELD_motion, member, motion, count));
    if (swung) {
        OZ_TRY(oz_arrays_write_scalars(&sim->arrays, OZ_FIELD_swing, member, swing,
                                       count / OZ_MOTION * OZ_SWING));
    }
done:
    free(motion);
    free(swing);
    return status;
}

/* Springs and slots are those of these triangles. */
static OzStatus meshes_state(const OzScene *scene, OzStateVisit *visit)
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        int64_t own = wall->mesh ? (int64_t)wall->mesh->hash : 0, saved = own;
        if (!wall->mesh) {
            continue;
        }
        oz_state_enter_one(visit, "mesh", w);
        OZ_PASS(oz_state_int64(visit, "hash", "none", &saved));
        oz_state_leave(visit);
        if (saved != own) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "state: %s has changed since it was saved; expected the same "
                                  "triangles",
                                  wall->path);
        }
    }
    return OZ_OK;
}

static OzStatus own_state(OzSim *sim, OzStateVisit *visit)
{
    OzRods *own = oz_rods_own(sim);
    for (int m = 0; m < sim->batch.member_count; m++) {
        oz_state_enter_one(visit, "meshes", m);
        OZ_PASS(meshes_state(sim->batch.members[m].scene, visit));
        oz_state_leave(visit);
    }
    OZ_PASS(oz_state_bool(visit, "primed", &own->primed));
    return oz_state_double(visit, "spring_start", "J", own->spring_start, sim->batch.member_count);
}

/* Accelerations are kept by integrators that move first alone. */
static OzStatus adopt(OzSim *sim, const OzSim *from, int member, double step)
{
    (void)member;
    (void)step;
    oz_rods_own(sim)->primed &= oz_rods_switches(from)->moves_before != 0;
    return OZ_OK;
}

static OzStatus push(OzSim *sim, int member, const double *force, const double *torque)
{
    OzStatus status = OZ_OK;
    const OzUnits *units = &oz_rods_parameters(sim, member)->units;
    double newton = oz_units_force(units), newton_metre = oz_units_energy(units), *words = NULL;
    size_t count = (size_t)oz_rods_sizes(sim)->slots * OZ_LOAD;
    OZ_TRY(OZ_NEW(&words, count));
    for (int i = 0; i < 3 * oz_rods_sizes(sim)->count; i++) {
        double *load = &words[OZ_LOAD * (i / 3) + i % 3];
        load[0] = force[i] / newton;
        load[OZ_LOAD / 2] = torque[i] / newton_metre;
    }
    OZ_TRY(oz_arrays_write_scalars(&sim->arrays, OZ_FIELD_push, member, words, count));
done:
    free(words);
    return status;
}

enum { PAIRS, GRAINS, WALLS, REFRESH, REBUILD, STAGES };

/* Grains: gather, integration, record, guards. */
static const OzTimedStage stages[STAGES] = {
    [PAIRS] = {"pairs", "oz_repeat_pairs", OZ_TIMED_STEP, OZ_TIMED_NONE, false,
               "kernel, repeated on a standing bed"},
    [GRAINS] = {"gather and integrate", "oz_repeat_grains", OZ_TIMED_STEP, OZ_TIMED_NONE, true,
                "kernel, repeated on a standing bed, without walls"},
    [WALLS] = {"walls", "oz_repeat_grains", OZ_TIMED_STEP, GRAINS, false,
               "kernel, the same with walls, difference"},
    [REFRESH] = {"inner list", "oz_repeat_refresh", OZ_TIMED_REFRESH, OZ_TIMED_NONE, false,
                 "made anew on a standing bed"},
    [REBUILD] = {"outer list", "oz_repeat_rebuild", OZ_TIMED_REBUILD, REFRESH, false,
                 "the same with the outer list (large beds: and re-sort), difference"},
};

/* A step of no length, walls where the bed meets them: repeated parts leave what no step would.
 * Walls' forces pile up in the loads, for only the pairs' part clears them, and an integrator that
 * carries accelerations would go on with the pile. */
static OzStatus stand_still(OzSim *sim)
{
    oz_rods_parameters(sim, 0)->dt = 0;
    OZ_PASS(oz_sim_write_parameters(sim));
    return oz_rods_move_walls(sim, 0, 1);
}

static void leave_out_walls(void *switches)
{
    OzSwitches *s = switches;
    s->walls = s->edged = s->meshes = s->wall_kinds = s->wall_kinds_more = 0;
    s->moving = s->gated = s->swung = s->impulses = s->servos = 0;
}

static const OzStop stops[] = {
    {OZ_STOP_NAN, "its state is not a number"},
    {OZ_STOP_ESCAPED, "it has left its container"},
    {OZ_STOP_MET, "it overlaps another body so far that shafts meet, or a centre lies behind "
                  "a wall"},
    {OZ_STOP_DEEP, "it overlaps another body by more than guards.overlap.stop"},
    {OZ_STOP_FAST, "an end of it moves more than half its radius in one step"},
    {OZ_STOP_SERVO, "a piston has left the scene"},
    {OZ_STOP_CROWDED, "it touches a mesh in more places than a grain can, eight"},
};

static int grain_of(const OzGrains *grains, int index)
{
    (void)grains;
    return index;
}

/* A grain beyond the domain. */
static void advise_escaped(char *text, size_t size, const OzSnapshot *now)
{
    OzParameters parameters;
    int order[OZ_WALLS_MAX];
    bool is_float = now->scene->precision == OZ_PRECISION_FLOAT;
    snprintf(text, size, "no wall holds it");
    if (oz_constants_fill(&parameters, order, now->scene, now->grains) == OZ_OK) {
        snprintf(text, size, "it is beyond %.3g m, where no wall holds it%s",
                 parameters.domain * parameters.length_unit,
                 is_float ? " and precision: float no place (double does)" : "");
    }
}

/* What would help: the guards of depth know, the others say where to look. */
static void advise(char *text, size_t size, const OzControlHead *control, const OzSnapshot *now)
{
    if (control->stop_bits & OZ_STOP_NAN) {
        snprintf(text, size, "`orzo check` says what step is stable");
    } else if (control->stop_bits & OZ_STOP_FAST) {
        snprintf(text, size, "try a smaller time.step (`orzo check` says what is stable)");
    } else if (control->stop_bits & OZ_STOP_SERVO) {
        snprintf(text, size,
                 "expected grains in its way, or a heavier piston (`orzo check` says its "
                 "largest step)");
    } else if (control->stop_bits & (OZ_STOP_DEEP | OZ_STOP_MET)) {
        oz_advice_write(text, size, now, control->stop_index);
    } else {
        advise_escaped(text, size, now);
    }
}

const OzModel oz_rods_model = {
    .name = "rods",
    .field_count = OZ_FIELD_COUNT,
    .control_field = OZ_FIELD_control,
    .fields = oz_rods_fields_rows,
    .field_items = oz_rods_fields_items,
    .body = "grain",
    .body_count = count_grains,
    .switches_bytes = sizeof(OzSwitches),
    .sizes_bytes = sizeof(OzSizes),
    .parameters_bytes = sizeof(OzParameters),
    .control_bytes = sizeof(OzControl),
    .switch_count = sizeof switch_rows / sizeof switch_rows[0],
    .switches = switch_rows,
    .derive = derive,
    .more_left_out = print_more_left_out,
    .program = "kernels/rods.cl",
    .fill = fill,
    .choose = oz_sizes_choose,
    .join = oz_sizes_join,
    .fits = fits,
    .alike = "features, number of grains, step and settling",
    .open = open,
    .start = start,
    .close = close,
    .write_parameters = write_parameters,
    .prime = prime,
    .prepare = oz_rods_move_walls,
    .supply = oz_host_lists_make,
    .state = own_state,
    .adopt = adopt,
    .unpack = oz_rods_read_snapshot_state,
    .contacts = oz_rods_read_snapshot_contacts,
    .push = push,
    .energy = oz_rods_read_snapshot_energy,
    .judge_steps = JUDGE_STEPS,
    .stage_count = STAGES,
    .contact_stage = PAIRS,
    .stages = stages,
    .stage_program = "kernels/stage_timing.cl",
    .repeats_most = 1 << 24,
    .stand_still = stand_still,
    .leave_out_walls = leave_out_walls,
    .ledger_field = OZ_FIELD_ledger,
    .ledger_words = OZ_LEDGER_WORDS,
    .start_ledger = oz_rods_read_snapshot_start_ledger,
    .stop_count = sizeof stops / sizeof stops[0],
    .stops = stops,
    .grain_of = grain_of,
    .advise = advise,
};
