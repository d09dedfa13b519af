/* Copying a saved member into others, field by field. It knows no model and no array by name, but
 * that an empty ledger is no loss. */
#include "sim/branch.h"

#include "base/memory.h"
#include "sim/launch.h"
#include "sim/read_snapshot.h"
#include "sim/sim_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The entry under the prefix, or NULL. */
static const OzStateEntry *find(const OzBranchSource *source, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%ssim/%s", source->prefix, name);
    return oz_state_find(source->state, path);
}

/* The same of the member. */
static const OzStateEntry *find_own(const OzBranchSource *source, const char *name)
{
    char path[128];
    snprintf(path, sizeof path, "member_%d/%s", source->member, name);
    return find(source, path);
}

/* Switches that change what a step does with the words and not what they are. */
static bool may_differ(const char *name)
{
    static const char *const names[] = {
        "LEDGER",     "INTEGRATOR_ID", /* MOVES_BEFORE and ORDER tell */
        "FRICTION",   "HISTORY",       "SLIP_SCALE",    "ATTRACTION_CLAMP", "SURFACES",
        "ADHESION",   "DRAG",          "ROLLING",       "ROLLING_SPRING",   "LAW_ID",
        "LINE",       "SMOOTH",        "AT_CONTACT",    "GYROSCOPIC",       "MOVING",
        "ALL_PAIRS",  "FORCE_POINT",   "DAMPING_SHEAR", "TRIANGLE_FIELD",   "SERVOS",
        "FREE_MOTION"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(name, names[i]) == 0) {
            return true;
        }
    }
    return false;
}

/* A cell that was not sheared stands upright, as one that will be begins. */
static bool begins_upright(const char *name, int saved, int own)
{
    return strcmp(name, "SHEAR") == 0 && saved < own;
}

static OzStatus check_switches(const OzSim *sim, const OzBranchSource *source)
{
    const int *own = sim->arrays.switches;
    for (int k = -1; k < sim->model->switch_count; k++) {
        const char *name = k < 0 ? "DOUBLE" : sim->model->switches[k].name;
        char path[64];
        snprintf(path, sizeof path, "switches/%s", name);
        const OzStateEntry *saved = find(source, path);
        int value = saved && saved->kind == OZ_STATE_INT32 ? *(const int *)saved->data : -1;
        if (value != own[k + 1] && !may_differ(name) && !begins_upright(name, value, own[k + 1])) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: the state to begin from has the kernel switch %s %d, and "
                                  "this scene %d; expected a scene of the same precision, kind of "
                                  "integrator, grains and kinds of walls, on the same device",
                                  sim->batch.members[0].scene->path, name, value, own[k + 1]);
        }
    }
    return OZ_OK;
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

/* Lists at least as long as those in which springs were saved. */
static OzStatus take_sizes(OzSim *sim, const OzBranchSource *source, OzSizesHead *sizes)
{
    const OzStateEntry *saved = find(source, "sizes");
    const OzSizesHead *head = saved ? saved->data : NULL;
    int64_t most = INT32_MAX / 16 / (sizes->regions > sizes->slots ? sizes->regions : sizes->slots);
    if (!head || (size_t)saved->count * sizeof(int) != sim->model->sizes_bytes ||
        head->slots != sizes->slots || head->regions != sizes->regions ||
        head->outer_capacity < 1 || head->outer_capacity > most || head->inner_capacity < 1 ||
        head->inner_capacity > most || head->back_capacity < 1 || head->back_capacity > most) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: the state to begin from is of another number of grains or "
                              "another device",
                              sim->batch.members[0].scene->path);
    }
    sizes->outer_capacity = larger(sizes->outer_capacity, head->outer_capacity);
    sizes->inner_capacity = larger(sizes->inner_capacity, head->inner_capacity);
    sizes->back_capacity = larger(sizes->back_capacity, head->back_capacity);
    return OZ_OK;
}

static OzStatus take_all_sizes(OzSim *sim, const OzBranchSource *sources)
{
    OzStatus status = OZ_OK;
    OzSizesHead *sizes = NULL;
    size_t bytes = sim->model->sizes_bytes;
    OZ_TRY(oz_memory_new((void **)&sizes, bytes, 1, "sizes"));
    memcpy(sizes, sim->arrays.sizes, bytes);
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_TRY(take_sizes(sim, &sources[m], sizes));
    }
    OZ_TRY(oz_arrays_resize(&sim->arrays, sizes));
done:
    free(sizes);
    return status;
}

static OzStatus check_units(const OzSim *sim, int member, const OzBranchSource *source)
{
    const OzUnits *own = &oz_sim_parameters(sim, member)->units;
    const struct {
        const char *name;
        double value;
    } units[] = {{"unit_length", own->length}, {"unit_time", own->time}, {"unit_mass", own->mass}};
    for (int i = 0; i < 3; i++) {
        const OzStateEntry *saved = find_own(source, units[i].name);
        if (!saved || saved->kind != OZ_STATE_DOUBLE ||
            *(const double *)saved->data != units[i].value) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: the state to begin from counts in another %s; expected the "
                                  "same grains and time.step",
                                  sim->batch.members[member].scene->path, units[i].name);
        }
    }
    return OZ_OK;
}

static OzStatus refuse_field(const OzSim *sim, int field, int member)
{
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s: the state to begin from has no %s that would do here; expected "
                          "a scene of the same grains, precision and integrator",
                          sim->batch.members[member].scene->path, sim->model->fields[field].name);
}

/* Springs lie in rows, one a region, which may be shorter than here. */
static OzStatus take_rows(OzSim *sim, int field, int member, const OzStateEntry *saved)
{
    OzStatus status = OZ_OK;
    size_t rows = (size_t)oz_arrays_sizes(&sim->arrays)->regions;
    size_t bytes = oz_arrays_bytes(&sim->arrays, field), to_row = bytes / rows;
    size_t from_row = (size_t)saved->count * oz_state_kind_bytes(saved->kind) / rows;
    char *words = NULL;
    if (from_row > to_row) {
        return refuse_field(sim, field, member);
    }
    OZ_TRY(OZ_NEW(&words, bytes));
    for (size_t row = 0; row < rows; row++) {
        memcpy(words + row * to_row, (const char *)saved->data + row * from_row, from_row);
    }
    OZ_TRY(oz_arrays_write(&sim->arrays, field, member, words, bytes));
done:
    free(words);
    return status;
}

/* A stretch of the member's from what was saved. Springs that were not kept are none. */
static OzStatus take_field(OzSim *sim, int field, int member, const OzBranchSource *source)
{
    const OzField *row = &sim->model->fields[field];
    size_t bytes = oz_arrays_bytes(&sim->arrays, field);
    bool springs = row->class == OZ_FIELD_SPRING;
    OzStateKind kind = oz_model_field_kind(row, oz_arrays_switches(&sim->arrays)->is_double);
    if (bytes == 0 || (row->class != OZ_FIELD_STATE && !springs) || oz_model_field_sums(row)) {
        return OZ_OK;
    }
    const OzStateEntry *saved = find_own(source, row->name);
    size_t saved_bytes = saved ? (size_t)saved->count * oz_state_kind_bytes(kind) : 0;
    if (!saved && (springs || oz_model_field_begins_empty(row))) {
        return OZ_OK;
    }
    if (!saved || saved->kind != kind || (saved_bytes != bytes && !springs)) {
        return refuse_field(sim, field, member);
    }
    if (saved_bytes != bytes) {
        return take_rows(sim, field, member, saved);
    }
    OZ_PASS(oz_arrays_write(&sim->arrays, field, member, saved->data, bytes));
    if (field == sim->model->control_field) {
        memcpy(oz_sim_control(sim, member), saved->data, bytes);
        oz_sim_control(sim, member)->crossed = 0;
    }
    return OZ_OK;
}

OzStatus oz_branch_take(OzSim *sim, const OzBranchSource *sources)
{
    int made = 0;
    OZ_PASS(take_all_sizes(sim, sources));
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(check_switches(sim, &sources[m]));
        OZ_PASS(check_units(sim, m, &sources[m]));
        sim->batch.scenes[m].boundary.strain = sources[m].strain;
        for (int f = 0; f < sim->model->field_count; f++) {
            OZ_PASS(take_field(sim, f, m, &sources[m]));
        }
    }
    OZ_PASS(oz_launch_write_control(sim));
    OZ_PASS(oz_launch_steps(sim, 0, &made));
    for (int m = 0; m < sim->batch.member_count; m++) {
        oz_sim_control(sim, m)->refreshes = oz_sim_control(sim, m)->rebuilds = 0;
    }
    return oz_read_snapshot_start_ledger(sim);
}
