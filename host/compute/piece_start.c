/* Overlaps of triangles and discs at the start, and grains outside of everything. */
#include "compute/piece_start.h"

#include "base/memory.h"
#include "compute/piece_dialect.h"
#include "compute/piece_pairs.h"

#include <math.h>
#include <stdlib.h>

typedef struct Look {
    OzStart *start;
    const OzScene *scene;
    const OzGrains *grains;
    double load;  /* N                                                  */
    int64_t *met; /* bodies: the last one, from 1, with which each overlaps */
} Look;

static OzTriangle triangle_of(const OzPieces *pieces, int i)
{
    double corners[6];
    OzTriangle t;
    oz_pieces_corners(pieces, i, &pieces->position[2 * (int64_t)i], pieces->angle[i], corners);
    for (int c = 0; c < 3; c++) {
        t.corner[c] = oz_vec2(corners[2 * c], corners[2 * c + 1]);
    }
    return t;
}

/* Of the circle of the same area. */
static double radius_of(const OzPieces *pieces, int body)
{
    double area = 0;
    for (int64_t i = pieces->first[body]; i < pieces->first[body + 1]; i++) {
        area += pieces->area[i];
    }
    return sqrt(area / 3.14159265358979323846);
}

/* What two pieces do to each other. */
typedef struct Meeting {
    double force, energy; /* N, J                          */
    double depth;         /* m                             */
    bool broken;          /* beyond what contacts can tell */
} Meeting;

static Meeting meet_triangles(const Look *look, int a, int b)
{
    OzTriangle one = triangle_of(look->grains->pieces, a);
    OzTriangle other = triangle_of(look->grains->pieces, b);
    Meeting m = {0};
    if (oz_triangle_near(&one, &other, 0)) {
        OzOverlap o = oz_triangle_overlap(&one, &other);
        m.broken = o.deep || o.swallowed;
        m.force = look->scene->triangles.stiffness * o.area;
        m.energy = look->scene->triangles.stiffness * o.energy;
        m.depth = o.area > 0 ? 2 * o.energy / o.area : 0;
    }
    return m;
}

static Meeting meet_disc(const Look *look, int a, int b)
{
    const OzPieces *p = look->grains->pieces;
    const double *x = &p->position[2 * (int64_t)a], *y = &p->position[2 * (int64_t)b];
    OzVec2 at_a = oz_vec2(x[0], x[1]), at_b = oz_vec2(y[0], y[1]);
    OzDiscPlace place;
    int wall = b < p->free_count ? -1 : p->body[b] - (int)p->grain_count;
    double mass = wall < 0 ? p->mass[a] * p->mass[b] / (p->mass[a] + p->mass[b]) : p->mass[a];
    if (p->radius[a] > 0 && p->radius[b] > 0) {
        place = oz_disc_meet(at_a, p->radius[a], at_b, p->radius[b]);
    } else {
        OzTriangle t = triangle_of(p, p->radius[a] > 0 ? b : a);
        place = oz_disc_meet_triangle(&t, p->radius[a] > 0 ? at_a : at_b,
                                      fmax(p->radius[a], p->radius[b]));
    }
    OzDiscForce force =
        oz_disc_force(place, oz_vec2(0, 0), mass, oz_piece_laws_disc(look->scene, wall));
    Meeting m = {0};
    if (force.touching) {
        m.force = sqrt(oz_dot2(force.force, force.force));
        m.energy = force.energy;
        m.depth = place.overlap;
    }
    return m;
}

static void look_at_pair(Look *look, OzPiecePair pair)
{
    const OzPieces *p = look->grains->pieces;
    bool disc = p->radius[pair.a] > 0 || p->radius[pair.b] > 0;
    Meeting m = disc ? meet_disc(look, pair.a, pair.b) : meet_triangles(look, pair.a, pair.b);
    int body = p->body[pair.b], wall = body - (int)p->grain_count;
    double radius = radius_of(p, p->body[pair.a]);
    radius = wall < 0 ? fmin(radius, radius_of(p, body)) : radius;
    OzStartOverlap overlap = {.a = p->body[pair.a],
                              .b = wall < 0 ? body : -1,
                              .wall = wall,
                              .depth = m.depth,
                              .share = m.depth / radius,
                              .energy = m.energy,
                              .behind = m.broken};
    look->start->energy += m.energy;
    if (m.broken || (overlap.share > OZ_START_ROUNDING && m.force > look->load)) {
        oz_start_add(look->start, &overlap, OZ_START_MOST, m.broken);
        look->start->count -= look->met[body] == overlap.a + 1; /* pairs come grain by grain */
        look->met[body] = overlap.a + 1;
    }
}

/* The energy of all contacts of the two that the worst one is between. */
static void sum_worst(Look *look, const OzPiecePairs *pairs)
{
    const OzPieces *p = look->grains->pieces;
    OzStartOverlap *worst = &look->start->worst;
    int64_t other = worst->b < 0 ? p->grain_count + worst->wall : worst->b;
    worst->energy = 0;
    for (int64_t k = 0; k < pairs->count; k++) {
        OzPiecePair pair = pairs->pair[k];
        if (p->body[pair.a] == worst->a && p->body[pair.b] == other) {
            bool disc = p->radius[pair.a] > 0 || p->radius[pair.b] > 0;
            worst->energy +=
                (disc ? meet_disc(look, pair.a, pair.b) : meet_triangles(look, pair.a, pair.b))
                    .energy;
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
    const OzPieces *p = look->grains->pieces;
    OzVec2 down = oz_vec2(look->scene->gravity[0], look->scene->gravity[1]);
    for (int64_t i = p->free_count; i < p->count; i++) {
        OzTriangle t = triangle_of(p, (int)i);
        for (int c = 0; c < 3; c++) {
            if (crosses(oz_vec2(x[0], x[1]), down, t.corner[c], t.corner[(c + 1) % 3])) {
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

OzStatus oz_piece_start_look(OzStart *start, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    OzPiecePairs pairs = {0};
    Look look = {.start = start, .scene = scene, .grains = grains};
    bool falls = hypot(scene->gravity[0], scene->gravity[1]) > 0;
    oz_piece_dialect_set(scene);
    OZ_TRY(OZ_NEW(&look.met, grains->pieces->grain_count + grains->pieces->wall_count));
    look.load = oz_start_load(scene, grains);
    OZ_TRY(oz_piece_pairs_renew(&pairs, grains->pieces, grains->pieces->position));
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
    oz_piece_pairs_free(&pairs);
    return status;
}
