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

/* kg and m of the lightest grain of a kind. */
static void find_lightest(double *mass, double *diameter, const OzScene *scene,
                          const OzGrains *grains, int kind)
{
    bool all = oz_mixing_count(scene) == 1, any = false;
    *mass = 1e-6;
    *diameter = 1e-3;
    for (int64_t i = 0; i < grains->count; i++) {
        bool is_one = all || oz_mixing_kind(scene, grains->population[i]) == kind;
        if (is_one && (!any || grains->mass[i] < *mass)) {
            *mass = grains->mass[i];
            *diameter = grains->diameter[i];
            any = true;
        }
    }
}

static double approach(const OzScene *scene, const OzGrains *grains, double diameter, bool pair)
{
    const double *g = scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    double start = grains->velocity ? fastest_grain(grains) * (pair ? 2 : 1) : 0;
    double least = fmax(start + fastest_wall(scene), 2 * sqrt(gravity * diameter));
    return least > 0 ? least : 1e-3;
}

OzHertzHit oz_hertz_hit(const OzScene *scene, const OzMixed *mixed, const OzGrains *grains)
{
    bool pair = mixed->wall < 0, mindlin = mixed->values.law == OZ_LAW_HERTZ_MINDLIN;
    OzContactConstants c = oz_contact_constants_of(&mixed->values, &scene->contact);
    double mass, diameter, other_mass, other;
    find_lightest(&mass, &diameter, scene, grains, mixed->one);
    double radius = diameter * (pair ? 0.25 : 0.5);
    if (pair && mixed->one != mixed->other) {
        find_lightest(&other_mass, &other, scene, grains, mixed->other);
        radius = 0.5 * diameter * other / (diameter + other);
        mass = mass * other_mass / (mass + other_mass);
        diameter = fmin(diameter, other);
    } else if (pair) {
        mass *= 0.5;
    }
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
