/* Snapshots from device arrays. Contacts are those of the inner list, which holds between launches;
 * slots become ids here. */
#include "compute/capture.h"

#include "base/memory.h"
#include "compute/pack.h"
#include "compute/sim_private.h"
#include "compute/touch.h"
#include "compute/units.h"

#include <stdlib.h>
#include <string.h>

/* A member's field in host memory; the caller frees it. */
static OzStatus download(const OzSim *sim, OzFieldId field, int member, void *data)
{
    size_t bytes = oz_arrays_bytes(field, &sim->arrays.switches, &sim->arrays.sizes);
    OzStatus status = oz_memory_new((void **)data, bytes, 1, "download");
    return status == OZ_OK ? oz_arrays_read(&sim->arrays, field, member, *(void **)data, bytes)
                           : status;
}

/* A word of a spring, m; 0 in a scene without springs. */
static double spring_word(const OzSim *sim, int member, const void *words, size_t at)
{
    const OzSwitches *s = &sim->arrays.switches;
    return s->history
               ? oz_pack_scalar(words, at, s->is_double) * sim->parameters[member].units.length
               : 0;
}

static OzStatus touch_pairs(OzSim *sim, int member, OzTouch *touch)
{
    OzStatus status = OZ_OK;
    const OzSizes *z = &sim->arrays.sizes;
    int *a = NULL, *b = NULL, *count = NULL, *id = NULL;
    void *springs = NULL;
    double spring[3];
    OZ_TRY(download(sim, OZ_FIELD_pair_a, member, &a));
    OZ_TRY(download(sim, OZ_FIELD_pair_b, member, &b));
    OZ_TRY(download(sim, OZ_FIELD_pair_count, member, &count));
    OZ_TRY(download(sim, OZ_FIELD_id, member, &id));
    OZ_TRY(download(sim, OZ_FIELD_pair_history, member, &springs));
    for (int r = 0; r < z->regions; r++) {
        int64_t begin = (int64_t)r * z->inner_capacity;
        for (int64_t p = begin; p < begin + count[r]; p++) {
            for (int c = 0; c < 3; c++) {
                spring[c] = spring_word(sim, member, springs, (size_t)(p * OZ_SPRING + c));
            }
            oz_touch_pair(touch, id[a[p]], id[b[p]], spring);
        }
    }
done:
    free(a);
    free(b);
    free(count);
    free(id);
    free(springs);
    return status;
}

static OzStatus touch_walls(OzSim *sim, int member, OzTouch *touch)
{
    OzStatus status = OZ_OK;
    int ends = touch->physics.ends, indices = ends * touch->physics.wall_count;
    int *id = NULL;
    void *springs = NULL;
    double spring[3];
    OZ_TRY(download(sim, OZ_FIELD_id, member, &id));
    OZ_TRY(download(sim, OZ_FIELD_wall_history, member, &springs));
    for (int slot = 0; slot < sim->arrays.sizes.count; slot++) {
        for (int index = 0; index < indices; index++) {
            for (int c = 0; c < 3; c++) {
                size_t at = oz_pack_lane(&sim->arrays.switches, slot, 3 * indices, 3 * index + c);
                spring[c] = spring_word(sim, member, springs, at);
            }
            oz_touch_wall(touch, id[slot], index / ends, index % ends, spring);
        }
    }
done:
    free(id);
    free(springs);
    return status;
}

/* The contacts of a snapshot whose state is there. */
static OzStatus touch_all(OzSim *sim, int member, const OzSnapshot *snapshot, OzTouch *touch)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_touch_begin(touch, snapshot));
    OZ_TRY(touch_pairs(sim, member, touch));
    OZ_TRY(touch_walls(sim, member, touch));
done:
    return status;
}

static OzStatus read_ledger(OzSim *sim, int member, const OzTouch *touch, OzLedger *ledger)
{
    OzStatus status = OZ_OK;
    double *words = NULL, sum[OZ_LEDGER_WORDS] = {0};
    OZ_TRY(download(sim, OZ_FIELD_ledger, member, &words));
    for (int k = 0; k < sim->arrays.sizes.regions * OZ_LEDGER_WORDS; k++) {
        sum[k % OZ_LEDGER_WORDS] += words[k] * oz_units_energy(&sim->parameters[member].units);
    }
    ledger->dissipated = sum[OZ_L_DISSIPATED];
    ledger->friction = sum[OZ_L_SPRING] - touch->tangential + sim->spring_start[member];
    ledger->work_walls = sum[OZ_L_WALLS];
done:
    free(words);
    return status;
}

static OzStatus read_contacts(OzSim *sim, int member, OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    OzTouch touch;
    OZ_TRY(touch_all(sim, member, snapshot, &touch));
    snapshot->has_contacts = true;
    snapshot->contacts = touch.contacts;
    snapshot->ledger.elastic = touch.elastic;
    if (sim->arrays.switches.ledger) {
        OZ_TRY(read_ledger(sim, member, &touch, &snapshot->ledger));
        snapshot->has_ledger = true;
    }
done:
    return status;
}

OzStatus oz_capture_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts)
{
    OzStatus status = OZ_OK;
    snapshot->step = sim->crew.reached[member];
    snapshot->time = (double)snapshot->step * sim->crew.members[member].scene->step;
    snapshot->deep_count = sim->crew.deep_count[member];
    snapshot->has_contacts = false;
    snapshot->has_ledger = false;
    oz_snapshot_move_walls(snapshot);
    OZ_TRY(oz_pack_state(&sim->arrays, member, &sim->parameters[member], snapshot));
    if (contacts && sim->control[member].truth == OZ_TRUTH_INNER) {
        OZ_TRY(read_contacts(sim, member, snapshot));
    }
done:
    return status;
}

OzStatus oz_capture_start(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OzSnapshot now;
        OzTouch touch = {0};
        if (sim->control[m].truth != OZ_TRUTH_INNER) {
            continue;
        }
        OZ_TRY(oz_snapshot_create(&now, sim->crew.members[m].scene, sim->crew.members[m].grains));
        status = oz_capture_snapshot(sim, m, &now, false);
        status = status == OZ_OK ? touch_all(sim, m, &now, &touch) : status;
        oz_snapshot_free(&now);
        OZ_TRY(status);
        sim->spring_start[m] = touch.tangential;
    }
done:
    return status;
}
