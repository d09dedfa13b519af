/* Saving and loading simulations. It knows no model and no array by name. */
#include "sim/sim_state.h"

#include "base/memory.h"
#include "sim/launch.h"
#include "sim/sim_private.h"

#include <stdlib.h>
#include <string.h>

/* Words must mean what they meant: the program is the same. */
static OzStatus switches_state(OzSim *sim, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    const int *own = sim->arrays.switches;
    OZ_TRY(oz_state_enter(visit, "switches", 1));
    for (int k = -1; k < sim->model->switch_count; k++) {
        const char *name = k < 0 ? "DOUBLE" : sim->model->switches[k].name;
        int value = own[k + 1];
        OZ_TRY(oz_state_int(visit, name, "none", &value));
        if (value != own[k + 1]) {
            status = oz_status_fail(OZ_ERR_INPUT,
                                    "state: the kernel switch %s was %d and is %d in this run",
                                    name, value, own[k + 1]);
            goto done;
        }
    }
    oz_state_leave(visit);
done:
    return status;
}

/* Takes the capacities of lists in which springs were saved. */
static OzStatus resize(OzSim *sim, OzSizesHead *saved)
{
    size_t bytes = sim->model->sizes_bytes;
    const OzSizesHead *own = oz_arrays_sizes(&sim->arrays);
    OzSizesHead rest;
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
                              "state: %s: saved for another number of grains or "
                              "another device",
                              sim->batch.members[0].scene->path);
    }
    return oz_arrays_resize(&sim->arrays, saved);
}

static OzStatus sizes_state(OzSim *sim, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    OzSizesHead *sizes = NULL;
    size_t bytes = sim->model->sizes_bytes;
    OZ_TRY(oz_memory_new((void **)&sizes, bytes, 1, "sizes"));
    memcpy(sizes, sim->arrays.sizes, bytes);
    OZ_TRY(oz_state_items(visit, "sizes", "none", OZ_STATE_INT32, sizes,
                          (int64_t)(bytes / sizeof(int))));
    if (visit->is_loading) {
        OZ_TRY(resize(sim, sizes));
    }
done:
    free(sizes);
    return status;
}

/* A member's stretch of a field, in its own kind of word. */
static OzStatus field_state(OzSim *sim, int field, int member, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    const OzField *row = &sim->model->fields[field];
    size_t bytes = oz_arrays_bytes(&sim->arrays, field);
    bool wide = oz_arrays_switches(&sim->arrays)->is_double && row->widens;
    OzStateKind kind = wide ? OZ_STATE_DOUBLE : row->kind;
    void *words = NULL;
    if (bytes == 0 || (row->class != OZ_FIELD_STATE && row->class != OZ_FIELD_SPRING)) {
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
    OzStatus status = OZ_OK;
    OzUnits *own = &oz_sim_parameters(sim, member)->units, saved = *own;
    OZ_TRY(oz_state_double(visit, "unit_length", "m", &saved.length, 1));
    OZ_TRY(oz_state_double(visit, "unit_time", "s", &saved.time, 1));
    OZ_TRY(oz_state_double(visit, "unit_mass", "kg", &saved.mass, 1));
    if (saved.length != own->length || saved.time != own->time || saved.mass != own->mass) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "state: %s: saved in other units of length, time or "
                                "mass",
                                sim->batch.members[member].scene->path);
    }
done:
    return status;
}

static OzStatus member_state(OzSim *sim, int member, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    oz_state_enter_one(visit, "member", member);
    OZ_TRY(units_state(sim, member, visit));
    for (int f = 0; f < sim->model->field_count; f++) {
        OZ_TRY(field_state(sim, f, member, visit));
    }
    oz_state_leave(visit);
done:
    return status;
}

/* Lists that hold again, where there is anything to list. */
static OzStatus renew(OzSim *sim)
{
    int made = 0;
    bool any = false;
    for (int m = 0; m < sim->batch.member_count; m++) {
        any = any || !sim->batch.stopped[m];
    }
    return any ? oz_launch_steps(sim, 0, &made) : OZ_OK;
}

OzStatus oz_sim_state_visit(OzSim *sim, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_state_enter(visit, "sim", 1));
    OZ_TRY(switches_state(sim, visit));
    OZ_TRY(sizes_state(sim, visit));
    OZ_TRY(oz_batch_state(&sim->batch, visit));
    if (!visit->is_loading) {
        OZ_TRY(oz_launch_write_control(sim));
        OZ_TRY(sim->model->save_springs(sim));
        OZ_TRY(oz_launch_write_control(sim));
    }
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_TRY(member_state(sim, m, visit));
    }
    if (sim->model->state) {
        OZ_TRY(sim->model->state(sim, visit));
    }
    oz_state_leave(visit);
    OZ_TRY(renew(sim));
done:
    return status;
}
