/* Saving and loading simulations. It knows no model and no array by name. */
#include "sim/sim_state.h"

#include "base/memory.h"
#include "model/motion.h"
#include "sim/launch.h"
#include "sim/sim_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is loaded: all of it as it was saved, or what another program of the same grains can use. */
typedef enum Way { WHOLE, FITTING } Way;

/* Words must mean what they meant: the program is the same. */
static OzStatus switches_state(OzSim *sim, OzStateVisit *visit, Way way)
{
    const int *own = sim->arrays.switches;
    OZ_PASS(oz_state_enter(visit, "switches", 1));
    for (int k = -1; k < sim->model->switch_count; k++) {
        const char *name = k < 0 ? "DOUBLE" : sim->model->switches[k].name;
        int value = own[k + 1];
        OZ_PASS(oz_state_int(visit, name, "none", &value));
        if (value != own[k + 1] && way == WHOLE) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "state: the kernel switch %s was %d and is %d in this run", name,
                                  value, own[k + 1]);
        }
    }
    oz_state_leave(visit);
    return OZ_OK;
}

/* Takes the capacities of lists in which springs were saved. */
static OzStatus resize(OzSim *sim, OzSizesHead *saved, Way way)
{
    size_t bytes = sim->model->sizes_bytes;
    const OzSizesHead *own = oz_arrays_sizes(&sim->arrays);
    OzSizesHead rest, capacities = *saved;
    if (way == FITTING) {
        memcpy(saved, own, bytes);
        saved->outer_capacity = capacities.outer_capacity;
        saved->inner_capacity = capacities.inner_capacity;
        saved->back_capacity = capacities.back_capacity;
    }
    saved->face_capacity = own->face_capacity; /* no springs are there */
    memcpy(&rest, saved, sizeof rest);
    rest.outer_capacity = own->outer_capacity;
    rest.inner_capacity = own->inner_capacity;
    rest.back_capacity = own->back_capacity;
    bool alike = memcmp(&rest, own, sizeof rest) == 0 &&
                 memcmp(saved + 1, own + 1, bytes - sizeof rest) == 0;
    int64_t most = INT32_MAX / 16 / (own->regions > own->slots ? own->regions : own->slots);
    if (!alike || saved->outer_capacity < 1 || saved->outer_capacity > most ||
        saved->inner_capacity < 1 || saved->inner_capacity > most || saved->back_capacity < 1 ||
        saved->back_capacity > most) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "state: %s: saved for another number of grains, other "
                              "triangles of meshes or another device",
                              sim->batch.members[0].scene->path);
    }
    return oz_arrays_resize(&sim->arrays, saved);
}

static OzStatus sizes_state(OzSim *sim, OzStateVisit *visit, Way way)
{
    OzStatus status = OZ_OK;
    OzSizesHead *sizes = NULL;
    size_t bytes = sim->model->sizes_bytes;
    OZ_TRY(oz_memory_new((void **)&sizes, bytes, 1, "sizes"));
    memcpy(sizes, sim->arrays.sizes, bytes);
    OZ_TRY(oz_state_items(visit, "sizes", "none", OZ_STATE_INT32, sizes,
                          (int64_t)(bytes / sizeof(int))));
    if (visit->is_loading) {
        OZ_TRY(resize(sim, sizes, way));
    }
done:
    free(sizes);
    return status;
}

/* Whether the entry that comes next was saved in just this shape. */
static bool is_there(const OzStateVisit *visit, const char *name, OzStateKind kind, int64_t count)
{
    char path[sizeof visit->path + 64];
    snprintf(path, sizeof path, "%s%s", visit->path, name);
    const OzStateEntry *entry = oz_state_find(visit->state, path);
    return entry && entry->kind == kind && entry->count == count;
}

/* A member's stretch of a field, in its own kind of word. */
static OzStatus field_state(OzSim *sim, int field, int member, OzStateVisit *visit, Way way)
{
    OzStatus status = OZ_OK;
    const OzField *row = &sim->model->fields[field];
    size_t bytes = oz_arrays_bytes(&sim->arrays, field);
    OzStateKind kind = oz_model_field_kind(row, oz_arrays_switches(&sim->arrays)->is_double);
    void *words = NULL;
    if (bytes == 0 || (row->class != OZ_FIELD_STATE && row->class != OZ_FIELD_SPRING)) {
        return OZ_OK;
    }
    if (way == FITTING && visit->is_loading &&
        !is_there(visit, row->name, kind, (int64_t)(bytes / oz_state_kind_bytes(kind)))) {
        return OZ_OK;
    }
    OZ_TRY(oz_arrays_download(&sim->arrays, field, member, &words));
    OZ_TRY(oz_state_items(visit, row->name, "as in the device's memory", kind, words,
                          (int64_t)(bytes / oz_state_kind_bytes(kind))));
    if (visit->is_loading) {
        OZ_TRY(oz_arrays_write(&sim->arrays, field, member, words, bytes));
    }
    if (field == sim->model->control_field) {
        memcpy(oz_sim_control(sim, member), words, bytes);
    }
done:
    free(words);
    return status;
}

/* What a word of the arrays is worth. */
static OzStatus units_state(OzSim *sim, int member, OzStateVisit *visit)
{
    OzUnits *own = &oz_sim_parameters(sim, member)->units, saved = *own;
    OZ_PASS(oz_state_double(visit, "unit_length", "m", &saved.length, 1));
    OZ_PASS(oz_state_double(visit, "unit_time", "s", &saved.time, 1));
    OZ_PASS(oz_state_double(visit, "unit_mass", "kg", &saved.mass, 1));
    if (saved.length != own->length || saved.time != own->time || saved.mass != own->mass) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "state: %s: saved in other units of length, time or "
                              "mass",
                              sim->batch.members[member].scene->path);
    }
    return OZ_OK;
}

static OzStatus member_state(OzSim *sim, int member, OzStateVisit *visit, Way way)
{
    oz_state_enter_one(visit, "member", member);
    OZ_PASS(units_state(sim, member, visit));
    OZ_PASS(oz_motion_state(&sim->batch.scenes[member], visit));
    OZ_PASS(oz_motion_trace_state(&sim->batch.scenes[member], visit));
    for (int f = 0; f < sim->model->field_count; f++) {
        OZ_PASS(field_state(sim, f, member, visit, way));
    }
    oz_state_leave(visit);
    return OZ_OK;
}

OzStatus oz_sim_state_save_springs(OzSim *sim)
{
    OZ_PASS(oz_launch_write_control(sim));
    OZ_PASS(oz_launch_save_springs(sim));
    return oz_launch_write_control(sim);
}

/* Where there is anything to list. */
OzStatus oz_sim_state_renew(OzSim *sim)
{
    int made = 0;
    bool any = false;
    for (int m = 0; m < sim->batch.member_count; m++) {
        any = any || !sim->batch.stopped[m];
    }
    return any ? oz_launch_steps(sim, 0, &made) : OZ_OK;
}

static OzStatus visit_all(OzSim *sim, OzStateVisit *visit, Way way)
{
    OZ_PASS(oz_state_enter(visit, "sim", 3));
    OZ_PASS(switches_state(sim, visit, way));
    OZ_PASS(sizes_state(sim, visit, way));
    OZ_PASS(oz_batch_state(&sim->batch, visit));
    if (!visit->is_loading) {
        OZ_PASS(oz_sim_state_save_springs(sim));
    }
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(member_state(sim, m, visit, way));
    }
    if (sim->model->state) {
        OZ_PASS(sim->model->state(sim, visit));
    }
    oz_state_leave(visit);
    return OZ_OK;
}

OzStatus oz_sim_state_visit(OzSim *sim, OzStateVisit *visit)
{
    OZ_PASS(visit_all(sim, visit, WHOLE));
    return oz_sim_state_renew(sim);
}

OzStatus oz_sim_state_move(OzSim *to, OzSim *from)
{
    OzStatus status = OZ_OK;
    OzState state = {0};
    OzStateVisit save = oz_state_save(&state), load = oz_state_load(&state);
    OZ_TRY(visit_all(from, &save, WHOLE));
    OZ_TRY(visit_all(to, &load, FITTING));
    for (int m = 0; to->model->adopt && m < to->batch.member_count; m++) {
        OZ_TRY(to->model->adopt(to, from, m, oz_sim_parameters(from, m)->dt));
    }
done:
    oz_state_free(&state);
    return status;
}
