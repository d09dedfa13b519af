/* Sweeps over trigrains. */
#include "sim/part_elements.h"

#include "sim/element_meet.h"
#include "sim/element_pairs.h"
#include "sim/element_start.h"

#include <math.h>

static void move(OzGrains *grains, int grain, const double push[2], double way)
{
    OzElements *p = grains->elements;
    for (int64_t i = p->first[grain]; i < p->first[grain + 1]; i++) {
        p->position[2 * i] += way * push[0];
        p->position[2 * i + 1] += way * push[1];
    }
    grains->position[3 * (int64_t)grain] += way * push[0];
    grains->position[3 * (int64_t)grain + 1] += way * push[1];
}

/* Where contacts do not know inside from outside: grains from each other's centres, which all their
 * elements agree about; an element from the middle of a wall's that nothing pushes it out of. */
static void aim_apart(OzElementMeeting *m, const OzGrains *grains, OzElementPair pair, bool wall)
{
    const OzElements *p = grains->elements;
    const double *from =
        wall ? &p->position[2 * (int64_t)pair.a] : &grains->position[3 * (int64_t)p->body[pair.a]];
    const double *to =
        wall ? &p->position[2 * (int64_t)pair.b] : &grains->position[3 * (int64_t)p->body[pair.b]];
    double x = to[0] - from[0], y = to[1] - from[1], size = hypot(x, y);
    m->push[0] = size > 0 ? x / size : 0;
    m->push[1] = size > 0 ? y / size : 1;
    m->depth = fmin(p->reach[pair.a], p->reach[pair.b]);
}

static void part_pair(OzGrains *grains, const OzScene *scene, OzElementPair pair, double *deepest)
{
    const OzElements *p = grains->elements;
    OzElementMeeting m = oz_element_meet_pair(scene, grains, pair.a, pair.b);
    int a = p->body[pair.a], b = p->body[pair.b];
    bool wall = b >= p->grain_count;
    if (m.broken && (!wall || (m.push[0] == 0 && m.push[1] == 0))) {
        aim_apart(&m, grains, pair, wall);
    }
    if (!(m.depth > 0)) {
        return;
    }
    double radius = oz_element_start_radius(grains, a), mass_a = grains->mass[a];
    radius = wall ? radius : fmin(radius, oz_element_start_radius(grains, b));
    double share = wall ? 1 : grains->mass[b] / (mass_a + grains->mass[b]);
    *deepest = fmax(*deepest, m.broken ? INFINITY : m.depth / radius);
    move(grains, a, m.push, -m.depth * share);
    if (!wall) {
        move(grains, b, m.push, m.depth * (1 - share));
    }
}

OzStatus oz_part_elements_sweep(OzGrains *grains, const OzScene *scene, double *deepest)
{
    OzStatus status = OZ_OK;
    OzElementPairs pairs = {0};
    OZ_TRY(oz_element_pairs_renew(&pairs, grains->elements, grains->elements->position));
    for (int64_t k = 0; k < pairs.count; k++) {
        part_pair(grains, scene, pairs.pair[k], deepest);
    }
done:
    oz_element_pairs_free(&pairs);
    return status;
}
