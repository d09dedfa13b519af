/* Hertzian hits, elastic: overlap and duration as in Johnson, Contact Mechanics (1985), sec. 11.4.
 */
#include "model/hertz.h"

#include "model/motion.h"

#include <math.h>

static double fastest_wall(const OzScene *scene)
{
    double fastest = 0;
    for (int w = 0; w < scene->wall_count; w++) {
        fastest = fmax(fastest, oz_motion_speed(&scene->walls[w].motion));
    }
    return fastest;
}

static double fastest_grain(const OzGrains *grains)
{
    double fastest2 = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        const double *v = &grains->velocity[3 * i];
        fastest2 = fmax(fastest2, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return sqrt(fastest2);
}

static int64_t lightest(const OzGrains *grains)
{
    int64_t least = 0;
    for (int64_t i = 1; i < grains->count; i++) {
        least = grains->mass[i] < grains->mass[least] ? i : least;
    }
    return least;
}

static double approach(const OzScene *scene, const OzGrains *grains, double diameter, bool pair)
{
    const double *g = scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    double start = grains->velocity ? fastest_grain(grains) * (pair ? 2 : 1) : 0;
    double least = fmax(start + fastest_wall(scene), 2 * sqrt(gravity * diameter));
    return least > 0 ? least : 1e-3;
}

OzHertzHit oz_hertz_hit(const OzScene *scene, const OzContactValues *values, int wall,
                        const OzGrains *grains)
{
    bool pair = wall < 0, mindlin = values->law == OZ_LAW_HERTZ_MINDLIN;
    OzContactConstants c = oz_contact_constants_of(values, &scene->contact);
    int64_t i = lightest(grains);
    double mass = (grains->count ? grains->mass[i] : 1e-6) * (pair ? 0.5 : 1);
    double diameter = grains->count ? grains->diameter[i] : 1e-3;
    double radius = diameter * (pair ? 0.25 : 0.5);
    OzHertzHit hit = {.speed = approach(scene, grains, diameter, pair), .damping = c.damping};
    hit.stiffness = c.stiffness * (mindlin ? sqrt(radius) : 1) / mass;
    double overlap = pow(1.25 * hit.speed * hit.speed / hit.stiffness, 0.4);
    hit.linear = c;
    hit.linear.duration = 2.943275 * overlap / hit.speed;
    hit.linear.stiffness = 1.5 * hit.stiffness * sqrt(overlap);
    if (mindlin) {
        hit.linear.damping = c.damping * sqrt(hit.stiffness * sqrt(overlap));
        hit.linear.tangential_damping = c.tangential_damping * hit.linear.damping;
        hit.linear.tangential_stiffness = c.tangential_stiffness * sqrt(radius * overlap) / mass;
    }
    return hit;
}
