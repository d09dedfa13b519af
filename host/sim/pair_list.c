/* Renewing a pair list. Knows nothing of forces. */
#include "sim/pair_list.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* In smallest diameters: longer lists against fewer rebuilds, nearly flat from 0.2 to 0.6. */
static const double skin_diameters = 0.3;

static double smallest_diameter(const OzGrains *grains)
{
    double smallest = grains->count > 0 ? grains->diameter[0] : 1;
    for (int64_t i = 1; i < grains->count; i++) {
        smallest = fmin(smallest, grains->diameter[i]);
    }
    return smallest;
}

/* What pairs remember that are still listed; both lists are sorted. */
static void keep_memories(OzPairList *near, const OzPairList *old)
{
    int64_t k = 0;
    OzVec3 zero = oz_vec3(0, 0, 0);
    const OzMemory none = {zero, zero};
    for (int64_t p = 0; p < near->pairs.count; p++) {
        OzPair pair = near->pairs.pair[p];
        const OzPair *was = old->pairs.pair;
        while (k < old->pairs.count &&
               (was[k].a < pair.a || (was[k].a == pair.a && was[k].b < pair.b))) {
            k++;
        }
        bool found = k < old->pairs.count && was[k].a == pair.a && was[k].b == pair.b;
        near->memory[p] = found ? old->memory[k] : none;
    }
}

/* How far any point of the shaft can have moved about a flow that strained the cell by so much
 * more, squared. */
static double moved2(const double x[3], const double u[3], const double old_x[3],
                     const double old_u[3], double half_length, double strained)
{
    double centre2 = 0, turn2 = 0, both = 0;
    for (int c = 0; c < 3; c++) {
        double dx = x[c] - old_x[c] - (c == 0 ? strained * old_x[1] : 0),
               da = half_length * (u[c] - old_u[c]);
        centre2 += dx * dx;
        turn2 += da * da;
        both += dx * da;
    }
    return centre2 + turn2 + 2 * fabs(both);
}

/* As kernels/near.h. */
static bool holds(const OzPairList *near, const OzGrains *grains, const double *position,
                  const double *axis, const OzBoundary *boundary)
{
    double strained = boundary->strain - near->strain;
    for (int64_t i = 0; i < 3 * grains->count && near->position; i += 3) {
        double moved = moved2(&position[i], &axis[i], &near->position[i], &near->axis[i],
                              grains->length[i / 3] / 2, strained);
        double reach = (grains->length[i / 3] + grains->diameter[i / 3] + near->skin) / 2;
        double left = near->skin / 2 - fabs(strained) * reach;
        if (!(left >= 0 && moved <= left * left)) {
            return false;
        }
    }
    return near->position != NULL;
}

OzStatus oz_pair_list_renew(OzPairList *near, bool *renewed, const OzGrains *grains,
                            const double *position, const double *axis, const OzBoundary *boundary)
{
    OzStatus status = OZ_OK;
    OzPairList next = {0};
    size_t bytes = 3 * (size_t)grains->count * sizeof *position;
    *renewed = !holds(near, grains, position, axis, boundary);
    if (!*renewed) {
        return OZ_OK;
    }
    next.skin = skin_diameters * smallest_diameter(grains);
    next.strain = boundary->strain;
    OZ_TRY(oz_sort_axis_pairs(&next.pairs, grains, position, axis, next.skin, boundary));
    OZ_TRY(OZ_NEW(&next.memory, next.pairs.count));
    OZ_TRY(OZ_NEW(&next.position, 3 * grains->count));
    OZ_TRY(OZ_NEW(&next.axis, 3 * grains->count));
    memcpy(next.position, position, bytes);
    memcpy(next.axis, axis, bytes);
    keep_memories(&next, near);
    oz_pair_list_free(near);
    *near = next;
done:
    if (status != OZ_OK) {
        oz_pair_list_free(&next);
    }
    return status;
}

void oz_pair_list_free(OzPairList *near)
{
    oz_sort_axis_free(&near->pairs);
    free(near->memory);
    free(near->position);
    free(near->axis);
    memset(near, 0, sizeof *near);
}
