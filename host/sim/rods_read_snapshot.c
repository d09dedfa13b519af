/* Rods' part of a snapshot. Contacts are those of the inner list, which holds between launches;
 * slots become ids here. */
#include "sim/rods_read_snapshot.h"

#include "base/memory.h"
#include "scene/wall_swing.h"
#include "sim/contacts.h"
#include "sim/pack.h"
#include "sim/read_snapshot.h"
#include "sim/rods_private.h"
#include "sim/scalars.h"
#include "sim/servos.h"
#include "sim/sides.h"
#include "sim/units.h"

#include <stdlib.h>
#include <string.h>

/* The words of springs, tangential and rolling. */
typedef struct Words {
    void *history, *rolling;
} Words;

static OzStatus download(Words *words, const OzSim *sim, int member, OzFieldId history,
                         OzFieldId rolling)
{
    OZ_PASS(oz_arrays_download(&sim->arrays, history, member, &words->history));
    return oz_arrays_download(&sim->arrays, rolling, member, &words->rolling);
}

static void free_words(Words *words)
{
    free(words->history);
    free(words->rolling);
}

/* One word of each, in m and rad; 0 in a scene without such springs. */
static void take_word(const OzSim *sim, int member, const Words *words, size_t at, double *stretch,
                      double *turned)
{
    const OzSwitches *s = oz_rods_switches(sim);
    double length = oz_rods_parameters(sim, member)->units.length;
    *stretch = s->history ? oz_scalars_get(words->history, at, s->is_double) * length : 0;
    *turned = s->rolling_spring ? oz_scalars_get(words->rolling, at, s->is_double) : 0;
}

static OzMemory memory_of(const double stretch[3], const double turned[3])
{
    return (OzMemory){{stretch[0], stretch[1], stretch[2]}, {turned[0], turned[1], turned[2]}};
}

static OzStatus find_pairs(OzSim *sim, int member, OzContacts *contacts)
{
    OzStatus status = OZ_OK;
    const OzSizes *z = oz_rods_sizes(sim);
    int *a = NULL, *b = NULL, *count = NULL, *id = NULL;
    Words words = {0};
    double stretch[3], turned[3];
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_a, member, &a));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_b, member, &b));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_count, member, &count));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_id, member, &id));
    OZ_TRY(download(&words, sim, member, OZ_FIELD_pair_history, OZ_FIELD_pair_rolling));
    for (int r = 0; r < z->regions; r++) {
        int64_t begin = (int64_t)r * z->inner_capacity;
        for (int64_t p = begin; p < begin + count[r]; p++) {
            if (!oz_rods_fields_counts(&sim->arrays, r, a[p])) {
                continue;
            }
            for (int c = 0; c < 3; c++) {
                take_word(sim, member, &words, (size_t)(p * OZ_SPRING + c), &stretch[c],
                          &turned[c]);
            }
            OzMemory memory = memory_of(stretch, turned);
            OZ_TRY(oz_contacts_pair(contacts, id[a[p]], id[b[p]], &memory));
        }
    }
done:
    free(a);
    free(b);
    free(count);
    free(id);
    free_words(&words);
    return status;
}

static OzStatus find_walls(OzSim *sim, int member, OzContacts *contacts)
{
    OzStatus status = OZ_OK;
    int indices = contacts->physics.touches;
    int *id = NULL;
    int words = contacts->physics.meshes * OZ_MESH_SLOTS * OZ_MESH_MEMORY;
    Words springs = {0};
    void *kept = NULL;
    double stretch[3], turned[3], *memory = NULL;
    OZ_TRY(OZ_NEW(&memory, words));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_id, member, &id));
    OZ_TRY(download(&springs, sim, member, OZ_FIELD_wall_history, OZ_FIELD_wall_rolling));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_mesh_memory, member, &kept));
    contacts->memory = memory;
    for (int slot = 0; slot < oz_rods_sizes(sim)->count; slot++) {
        for (int k = 0; k < words; k++) {
            memory[k] = oz_scalars_get(kept, oz_pack_lane(oz_rods_switches(sim), slot, words, k),
                                       oz_rods_switches(sim)->is_double);
        }
        for (int index = 0; index < indices; index++) {
            for (int c = 0; c < 3; c++) {
                size_t at = oz_pack_lane(oz_rods_switches(sim), slot, 3 * indices, 3 * index + c);
                take_word(sim, member, &springs, at, &stretch[c], &turned[c]);
            }
            OzMemory stored = memory_of(stretch, turned);
            OZ_TRY(oz_contacts_wall(contacts, id[slot], index, &stored));
        }
    }
done:
    contacts->memory = NULL;
    free(id);
    free_words(&springs);
    free(kept);
    free(memory);
    return status;
}

/* Impulses of the scene's walls from those of the kernels' sides, whose points are not the walls';
 * but those of walls that swing are about these. */
static OzStatus find_impulses(OzSim *sim, int member, OzSnapshot *snapshot)
{
    OzWallSide sides[OZ_WALLS_MAX];
    double sum[OZ_WALLS_MAX][OZ_IMPULSE_WORDS] = {{0}};
    const OzScene *scene = sim->batch.members[member].scene;
    const OzUnits *units = &oz_rods_parameters(sim, member)->units;
    double push = oz_units_force(units) * units->time, turn = oz_units_energy(units) * units->time;
    int count = oz_sides_list(sides, scene);
    OZ_PASS(oz_read_snapshot_sums(sim, member, OZ_FIELD_wall_impulse, count * OZ_IMPULSE_WORDS,
                                  sum[0]));
    memset(snapshot->wall_impulse, 0, (size_t)scene->wall_count * sizeof *snapshot->wall_impulse);
    for (int s = 0; s < count; s++) {
        double *to = snapshot->wall_impulse[sides[s].wall];
        const OzWall *wall = &scene->walls[sides[s].wall];
        const double *home = oz_wall_swing_has(wall) ? sides[s].shape.point : wall->point;
        for (int k = 0; k < 3; k++) {
            int l = (k + 1) % 3, m = (k + 2) % 3;
            to[k] += sum[s][k] * push;
            to[3 + k] += sum[s][3 + k] * turn;
            to[3 + k] += (sides[s].shape.point[l] - home[l]) * sum[s][m] * push -
                         (sides[s].shape.point[m] - home[m]) * sum[s][l] * push;
        }
    }
    snapshot->has_wall_impulse = true;
    return OZ_OK;
}

/* The contacts of a snapshot whose state is there. */
static OzStatus find_all(OzSim *sim, int member, OzSnapshot *snapshot)
{
    OzContacts contacts;
    OZ_PASS(oz_contacts_begin(&contacts, snapshot, &snapshot->contacts));
    OZ_PASS(find_pairs(sim, member, &contacts));
    OZ_PASS(find_walls(sim, member, &contacts));
    oz_contact_list_sort(&snapshot->contacts);
    return OZ_OK;
}

OzStatus oz_rods_read_snapshot_state(OzSim *sim, int member, OzSnapshot *snapshot)
{
    if (oz_rods_switches(sim)->servos > 0) {
        OZ_PASS(oz_servos_read(sim, member, snapshot));
    }
    return oz_pack_state(&sim->arrays, member, oz_rods_parameters(sim, member), snapshot);
}

OzStatus oz_rods_read_snapshot_contacts(OzSim *sim, int member, OzSnapshot *snapshot)
{
    if (oz_rods_control(sim, member)->truth != OZ_SPRINGS_AT_INNER) {
        return OZ_OK;
    }
    OZ_PASS(find_all(sim, member, snapshot));
    snapshot->has_contacts = true;
    if (oz_rods_switches(sim)->impulses) {
        OZ_PASS(find_impulses(sim, member, snapshot));
    }
    OzContactSums sums = oz_contact_list_sum(&snapshot->contacts);
    snapshot->ledger.elastic = sums.energy;
    if (oz_rods_switches(sim)->ledger) {
        OzLedger *ledger = &snapshot->ledger;
        double sum[OZ_LEDGER_WORDS] = {0};
        OZ_PASS(oz_read_snapshot_ledger(sim, member, sum));
#define TAKE(NAME, entry, column, meaning) ledger->entry = sum[OZ_L_##NAME];
        OZ_LEDGER_LOSSES(TAKE)
        OZ_LEDGER_WORK(TAKE)
#undef TAKE
        /* what was given to springs and they do not hold */
        ledger->friction -= sums.spring_energy;
        ledger->friction += oz_rods_own(sim)->spring_start[member];
        snapshot->has_ledger = true;
    }
    return OZ_OK;
}

double oz_rods_read_snapshot_energy(const OzSnapshot *now)
{
    const OzGrains *grains = now->grains;
    double energy = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        const double *v = &now->velocity[3 * i], *w = &now->angular_velocity[3 * i],
                     *u = &now->axis[3 * i];
        double along = w[0] * u[0] + w[1] * u[1] + w[2] * u[2];
        double spin2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
        energy += 0.5 * grains->mass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        energy += 0.5 * grains->inertia[i] * (spin2 - along * along);
        energy += 0.5 * grains->inertia_axis[i] * along * along;
    }
    return energy;
}

OzStatus oz_rods_read_snapshot_start_ledger(OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    const OzMember *of = &sim->batch.members[member];
    OzSnapshot now = {0};
    if (!oz_rods_switches(sim)->ledger ||
        oz_rods_control(sim, member)->truth != OZ_SPRINGS_AT_INNER) {
        return OZ_OK;
    }
    OZ_TRY(oz_snapshot_create(&now, of->scene, of->grains));
    OZ_TRY(oz_read_snapshot_snapshot(sim, member, &now, false));
    OZ_TRY(find_all(sim, member, &now));
    oz_rods_own(sim)->spring_start[member] = oz_contact_list_sum(&now.contacts).spring_energy;
done:
    oz_snapshot_free(&now);
    return status;
}
