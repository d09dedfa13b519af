/* Mixing the values of two materials. */
#include "scene/mixing.h"

#include "base/log.h"

#include <math.h>
#include <string.h>

int oz_mixing_count(const OzScene *scene)
{
    int count = 1;
    for (int i = 0; i < scene->material_count; i++) {
        int kind = scene->materials[i].kind;
        count = kind >= count ? kind + 1 : count;
    }
    return count;
}

int oz_mixing_material(const OzScene *scene, int population)
{
    return population < scene->population_count
               ? scene->populations[population].material_number - 1
               : -1;
}

int oz_mixing_kind(const OzScene *scene, int population)
{
    int material = oz_mixing_material(scene, population);
    return material >= 0 ? scene->materials[material].kind : 0;
}

/* The number of the material of a kind, from 1; 0: none. */
static int number_of(const OzScene *scene, int kind)
{
    for (int i = 0; i < scene->material_count; i++) {
        if (scene->materials[i].kind == kind) {
            return i + 1;
        }
    }
    return 0;
}

static const char *name_of(const OzScene *scene, int number)
{
    return number > 0 ? scene->materials[number - 1].name : "";
}

const char *oz_mixing_name(const OzScene *scene, int kind)
{
    return name_of(scene, number_of(scene, kind));
}

const char *oz_mixing_wall_name(const OzScene *scene, int wall)
{
    return name_of(scene, scene->walls[wall].material_number);
}

/* share: of the compliance of both, that of `a`. */
static double mix_series(double a, double b, double share)
{
    (void)share;
    return sqrt((a * a + b * b) / 2);
}

static double mix_energy(double a, double b, double share)
{
    return sqrt(share * a * a + (1 - share) * b * b);
}

static double mix_harmonic(double a, double b, double share)
{
    (void)share;
    return 2 / (1 / a + 1 / b);
}

static double mix_mean(double a, double b, double share)
{
    (void)share;
    return (a + b) / 2;
}

static double mix_geometric(double a, double b, double share)
{
    (void)share;
    return sqrt(a * b);
}

static double compliance(const OzContactValues *values, OzLaw law)
{
    switch (law) {
    case OZ_LAW_HERTZ_MINDLIN:
        return (1 - values->poisson_ratio * values->poisson_ratio) / values->youngs_modulus;
    case OZ_LAW_HERTZ:
        return 1 / values->hertz_stiffness;
    default:
        return values->contact_time * values->contact_time;
    }
}

bool oz_mixing_joins(const OzMaterialPair *pair, const char *one, const char *other)
{
    const char *a = pair->between[0], *b = pair->between[1];
    return a && b &&
           ((strcmp(a, one) == 0 && strcmp(b, other) == 0) ||
            (strcmp(a, other) == 0 && strcmp(b, one) == 0));
}

const OzMaterialPair *oz_mixing_pair(const OzScene *scene, int one, int other)
{
    for (int i = 0; i < scene->pair_count; i++) {
        if (oz_mixing_joins(&scene->pairs[i], name_of(scene, one), name_of(scene, other))) {
            return &scene->pairs[i];
        }
    }
    return NULL;
}

/* Materials of these numbers; what they do not say themselves is the scene's. */
static void mix(OzContactValues *values, const OzScene *scene, int one, int other)
{
    const OzContactValues *a = &scene->materials[one - 1].contact;
    const OzContactValues *b = &scene->materials[other - 1].contact;
    const OzMaterialPair *pair = oz_mixing_pair(scene, one, other);
    double soft = compliance(a, scene->told.law), softer = compliance(b, scene->told.law);
    double share = soft / (soft + softer);
    *values = scene->told;
    values->youngs_modulus = a->youngs_modulus;
    values->poisson_ratio = a->poisson_ratio;
    values->other_modulus = b->youngs_modulus;
    values->other_ratio = b->poisson_ratio;
#define MIX(name, rule)                                                                            \
    values->name = a->name == b->name ? a->name : mix_##rule(a->name, b->name, share);             \
    if (pair && pair->has_##name) {                                                                \
        values->name = pair->contact.name;                                                         \
    }
    OZ_MIXED(MIX)
#undef MIX
}

void oz_mixing_grains(OzContactValues *values, const OzScene *scene, int one, int other)
{
    int a = number_of(scene, one < other ? one : other);
    int b = number_of(scene, one < other ? other : one);
    *values = scene->contact;
    if (a > 0 && b > 0) {
        mix(values, scene, a, b);
    }
}

void oz_mixing_wall(OzContactValues *values, const OzScene *scene, int wall, int kind)
{
    int grains = number_of(scene, kind), own = scene->walls[wall].material_number;
    *values = scene->walls[wall].contact;
    if (own > 0 && grains > 0) {
        mix(values, scene, own, grains);
    } else if (grains > 0) {
        values->other_modulus = scene->materials[grains - 1].contact.youngs_modulus;
        values->other_ratio = scene->materials[grains - 1].contact.poisson_ratio;
    }
}

int oz_mixing_contacts(const OzScene *scene)
{
    int kinds = oz_mixing_count(scene);
    return kinds * (kinds + 1) / 2 + scene->wall_count * kinds;
}

void oz_mixing_contact(OzMixed *mixed, const OzScene *scene, int i)
{
    int kinds = oz_mixing_count(scene), at_walls = i - kinds * (kinds + 1) / 2;
    *mixed = (OzMixed){.wall = -1, .other = i};
    if (at_walls >= 0) {
        mixed->wall = at_walls / kinds;
        mixed->one = mixed->other = at_walls % kinds;
        oz_mixing_wall(&mixed->values, scene, mixed->wall, mixed->one);
        return;
    }
    while (mixed->other >= kinds) { /* rows of a triangle, each a place shorter */
        mixed->one++;
        mixed->other -= kinds - mixed->one;
    }
    oz_mixing_grains(&mixed->values, scene, mixed->one, mixed->other);
}

void oz_mixing_resolve(OzScene *scene)
{
    scene->contact = scene->told;
    for (int w = 0; w < scene->wall_count; w++) {
        scene->walls[w].contact = scene->walls[w].told;
    }
    if (number_of(scene, 0) > 0) {
        mix(&scene->contact, scene, number_of(scene, 0), number_of(scene, 0));
        for (int w = 0; w < scene->wall_count; w++) {
            OzContactValues values;
            oz_mixing_wall(&values, scene, w, 0);
            scene->walls[w].contact = values;
        }
    }
}

void oz_mixing_say(const OzScene *scene)
{
    for (int i = 0; i < scene->material_count; i++) {
        bool used = scene->materials[i].kind >= 0;
        for (int w = 0; w < scene->wall_count; w++) {
            used |= scene->walls[w].material_number == i + 1;
        }
        if (!used) {
            oz_log_line("%s:%d: warning: no grain and no wall is of material %s", scene->path,
                        scene->materials[i].line, scene->materials[i].name);
        }
    }
}
