/* Triangles and discs by the contact laws of the kernels. */
#include "sim/element_meet.h"

#include "sim/element_overlap.h"

#include <math.h>

void oz_element_meet_corners(const OzElements *elements, int i, double corners[6])
{
    oz_elements_corners(elements, i, &elements->position[2 * (int64_t)i], elements->angle[i],
                        corners);
}

static OzTriangle triangle_of(const OzElements *elements, int i)
{
    double corners[6];
    OzTriangle t;
    oz_element_meet_corners(elements, i, corners);
    for (int c = 0; c < 3; c++) {
        t.corner[c] = oz_vec2(corners[2 * c], corners[2 * c + 1]);
    }
    return t;
}

static void aim(OzElementMeeting *m, OzVec2 push)
{
    double size = sqrt(oz_dot2(push, push));
    m->push[0] = size > 0 ? push.x / size : 0;
    m->push[1] = size > 0 ? push.y / size : 0;
}

static OzElementMeeting meet_triangles(const OzScene *scene, const OzElements *p, int a, int b)
{
    OzTriangle one = triangle_of(p, a), other = triangle_of(p, b);
    OzElementMeeting m = {0};
    if (oz_triangle_near(&one, &other, 0)) {
        OzOverlap o = oz_element_overlap_find(p, a, b, &one, &other);
        m.broken = o.deep || o.swallowed;
        m.force = scene->triangles.stiffness * o.area;
        m.energy = scene->triangles.stiffness * o.energy;
        m.depth = o.area > 0 ? 2 * o.energy / o.area : 0;
        aim(&m, o.push);
    }
    return m;
}

static OzElementMeeting meet_disc(const OzScene *scene, const OzElements *p, int a, int b)
{
    const double *x = &p->position[2 * (int64_t)a], *y = &p->position[2 * (int64_t)b];
    OzVec2 at_a = oz_vec2(x[0], x[1]), at_b = oz_vec2(y[0], y[1]);
    OzDiscPlace place;
    int wall = b < p->free_count ? -1 : p->body[b] - (int)p->grain_count;
    double mass = wall < 0 ? p->mass[a] * p->mass[b] / (p->mass[a] + p->mass[b]) : p->mass[a];
    bool first = p->radius[a] > 0; /* is a disc */
    if (first && p->radius[b] > 0) {
        place = oz_disc_meet(at_a, p->radius[a], at_b, p->radius[b]);
    } else {
        OzTriangle t = triangle_of(p, first ? b : a);
        place = oz_disc_meet_triangle(&t, first ? at_a : at_b, fmax(p->radius[a], p->radius[b]));
        place.normal = first ? oz_scale2(place.normal, -1) : place.normal;
    }
    OzDiscForce force =
        oz_disc_force(place, oz_vec2(0, 0), mass, oz_element_laws_disc(scene, wall));
    OzElementMeeting m = {0};
    if (force.touching) {
        m.force = sqrt(oz_dot2(force.force, force.force));
        m.energy = force.energy;
        m.depth = place.overlap;
        aim(&m, force.force);
    }
    return m;
}

OzElementMeeting oz_element_meet_pair(const OzScene *scene, const OzGrains *grains, int a, int b)
{
    const OzElements *p = grains->elements;
    bool disc = p->radius[a] > 0 || p->radius[b] > 0;
    OZ_USE_SWITCHES(oz_host_switches_elements(scene));
    return disc ? meet_disc(scene, p, a, b) : meet_triangles(scene, p, a, b);
}
