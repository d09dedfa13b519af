/* Overlaps of triangles and discs at the start, and grains outside of everything. */
#include "sim/element_start.h"

#include "base/memory.h"
#include "sim/element_meet.h"
#include "sim/element_pairs.h"

#include "kernels/vec2.h"

#include <math.h>
#include <stdlib.h>

typedef struct Look {
    OzStart *start;
    const OzScene *scene;
    const OzGrains *grains;
    double load;  /* N                                                  */
    int64_t *met; /* bodies: the last one, from 1, with which each overlaps */
} Look;

double oz_element_start_radius(const OzGrains *grains, int grain)
{
    const OzElements *p = grains->elements;
    double area = 0;
    for (int64_t i = p->first[grain]; i < p->first[grain + 1]; i++) {
        area += p->area[i];
    }
    return sqrt(area / 3.14159265358979323846);
}

static void look_at_pair(Look *look, OzElementPair pair)
{
    const OzElements *p = look->grains->elements;
    OzElementMeeting m = oz_element_meet_pair(look->scene, look->grains, pair.a, pair.b);
    int body = p->body[pair.b], wall = body - (int)p->grain_count;
    double radius = oz_element_start_radius(look->grains, p->body[pair.a]);
    radius = wall < 0 ? fmin(radius, oz_element_start_radius(look->grains, body)) : radius;
    OzStartOverlap overlap = {.a = p->body[pair.a],
                              .b = wall < 0 ? body : -1,
                              .wall = wall,
                              .depth = m.depth,
                              .share = m.depth / radius,
                              .energy = m.energy,
                              .behind = m.broken};
    look->start->energy += m.energy;
    if (m.broken || (overlap.share > OZ_START_ROUNDING && m.force > look->load)) {
        oz_start_overlap_add(look->start, &overlap, OZ_START_MOST, m.broken);
        look->start->count -= look->met[body] == overlap.a + 1; /* pairs come grain by grain */
        look->met[body] = overlap.a + 1;
    }
}

/* The energy of all contacts of the two that the worst one is between. */
static void sum_worst(Look *look, const OzElementPairs *pairs)
{
    const OzElements *p = look->grains->elements;
    OzStartOverlap *worst = &look->start->worst;
    int64_t other = worst->b < 0 ? p->grain_count + worst->wall : worst->b;
    worst->energy = 0;
    for (int64_t k = 0; k < pairs->count; k++) {
        OzElementPair pair = pairs->pair[k];
        if (p->body[pair.a] == worst->a && p->body[pair.b] == other) {
            worst->energy += oz_element_meet_pair(look->scene, look->grains, pair.a, pair.b).energy;
        }
    }
}

static bool holds(const OzWall *wall, const double x[3])
{
    double aside = fabs(x[0] - wall->point[0]);
    switch (wall->kind) {
    case OZ_WALL_DRUM:
        return hypot(aside, x[1] - wall->point[1]) < wall->diameter / 2;
    case OZ_WALL_HOPPER:
    case OZ_WALL_VESSEL:
        return aside < wall->width / 2 && x[1] > wall->point[1];
    default:
        return false;
    }
}

/* Whether the way from x along a direction meets the edge from a to b. */
static bool crosses(OzVec2 x, OzVec2 along, OzVec2 a, OzVec2 b)
{
    double side_a = oz_cross2(along, oz_minus2(a, x)), side_b = oz_cross2(along, oz_minus2(b, x));
    if (side_a == side_b || (side_a > 0) == (side_b > 0)) {
        return false;
    }
    double share = side_a / (side_a - side_b);
    return oz_dot2(along, oz_minus2(oz_along2(a, share, oz_minus2(b, a)), x)) > 0;
}

static bool has_wall_below(const Look *look, const double x[3])
{
    const OzElements *p = look->grains->elements;
    OzVec2 down = oz_vec2(look->scene->gravity[0], look->scene->gravity[1]);
    for (int64_t i = p->free_count; i < p->count; i++) {
        double t[6];
        oz_element_meet_corners(p, (int)i, t);
        for (int c = 0, d = 1; c < 3; c++, d = (c + 1) % 3) {
            if (crosses(oz_vec2(x[0], x[1]), down, oz_vec2(t[2 * c], t[2 * c + 1]),
                        oz_vec2(t[2 * d], t[2 * d + 1]))) {
                return true;
            }
        }
    }
    return false;
}

static void look_outside(Look *look, int64_t i)
{
    const OzScene *scene = look->scene;
    const double *x = &look->grains->position[3 * i];
    bool held = scene->populations[look->grains->population[i]].kind == OZ_GRAINS_RANDOM;
    for (int w = 0; w < scene->wall_count; w++) {
        held = held || holds(&scene->walls[w], x);
    }
    if (!held && !has_wall_below(look, x)) {
        look->start->outside_first = look->start->outside++ ? look->start->outside_first : i;
    }
}

OzStatus oz_element_start_look(OzStart *start, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    OzElementPairs pairs = {0};
    Look look = {.start = start, .scene = scene, .grains = grains};
    bool falls = hypot(scene->gravity[0], scene->gravity[1]) > 0;
    OZ_TRY(OZ_NEW(&look.met, grains->elements->grain_count + grains->elements->wall_count));
    look.load = oz_start_overlap_load(scene, grains);
    OZ_TRY(oz_element_pairs_renew(&pairs, grains->elements, grains->elements->position));
    for (int64_t k = 0; k < pairs.count; k++) {
        look_at_pair(&look, pairs.pair[k]);
    }
    if (start->count > 0) {
        sum_worst(&look, &pairs);
    }
    for (int64_t i = 0; falls && scene->wall_count > 0 && i < grains->count; i++) {
        look_outside(&look, i);
    }
done:
    free(look.met);
    oz_element_pairs_free(&pairs);
    return status;
}
