/* The checks of rods' scenes that need more than one value: whether grains find room. */
#include "scene/check_solid.h"

#include "scene/boundary.h"
#include "scene/check_motion.h"
#include "scene/check_servo.h"
#include "scene/trace.h"
#include "scene/wall_shape.h"

#include <math.h>
#include <stdio.h>

static const double PI = 3.14159265358979323846;

/* Diameter of the narrowest cylinder, or infinity. */
static double cylinder_of(const OzScene *scene)
{
    double least = INFINITY;
    for (int i = 0; i < scene->wall_count; i++) {
        const OzWall *wall = &scene->walls[i];
        if (oz_wall_shape_is_upright(wall) && wall->diameter > 0 && !(wall->since > 0)) {
            least = fmin(least, wall->diameter);
        }
    }
    return least;
}

/* Height between the level planes that face each other, or infinity. */
static double height_of(const OzScene *scene)
{
    double floor = -INFINITY, ceiling = INFINITY;
    for (int i = 0; i < scene->wall_count; i++) {
        const OzWall *wall = &scene->walls[i];
        if (wall->kind != OZ_WALL_PLANE || wall->since > 0) {
            continue;
        }
        if (wall->normal[2] == 1) {
            floor = fmax(floor, wall->point[2]);
        } else if (wall->normal[2] == -1) {
            ceiling = fmin(ceiling, wall->point[2]);
        }
    }
    return fmax(ceiling - floor, 0);
}

/* Mean volume of a population's grain, m^3: diameter and aspect are uniform and independent. */
static double mean_volume(const OzPopulation *grains)
{
    double a = grains->diameter.low, b = grains->diameter.high;
    double cubed = (a + b) * (a * a + b * b) / 4;
    double aspect = (grains->aspect.low + grains->aspect.high) / 2;
    return PI * cubed * (aspect / 4 + 1.0 / 6);
}

/* A cheap bound; the placement itself may still find no room. */
static void check_room(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    /* Grains put down at random without overlap jam far below this volume fraction. */
    const double densest = 0.6;
    double diameter = cylinder_of(scene), height = height_of(scene);
    double room = densest * height * PI * diameter * diameter / 4, volume = 0;
    for (int i = 0; i < scene->population_count; i++) {
        const OzPopulation *grains = &scene->populations[i];
        char path[64];
        if (grains->diameter.high > diameter) {
            snprintf(path, sizeof path, "grains.%d.diameter", i);
            oz_tree_fault(root, faults, path,
                          "grains up to %g m cannot fit; expected at most the cylinder's %g m",
                          grains->diameter.high, diameter);
        }
        double before = volume;
        volume +=
            grains->kind == OZ_GRAINS_RANDOM ? (double)grains->count * mean_volume(grains) : 0;
        if (before <= room && volume > room) {
            snprintf(path, sizeof path, "grains.%d.count", i);
            oz_tree_fault(
                root, faults, path,
                "grains of %.3g m^3 cannot fit; expected at most %.3g m^3 between the walls",
                volume, room);
        }
    }
}

static void check_singles(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    for (int i = 0; i < scene->population_count; i++) {
        char path[64];
        snprintf(path, sizeof path, "grains.%d.position", i);
        bool known =
            scene->populations[i].kind == OZ_GRAINS_SINGLE && oz_tree_at(root, path) != NULL;
        for (int j = 0; known && j < scene->wall_count; j++) {
            const OzWall *wall = &scene->walls[j];
            if (!(wall->since > 0) &&
                oz_wall_shape_distance(wall, 0, scene->populations[i].position, NULL) < 0) {
                oz_tree_fault(root, faults, path,
                              "%s lies behind walls.%d; expected it on the free side", path, j);
            }
        }
    }
}

/* Sizes of which the rows do not know enough. */
static void check_sizes(const OzWall *wall, int i, OzNode *root, OzFaults *faults)
{
    char path[64];
    double least = fmin(wall->size[0], fmin(wall->size[1], wall->size[2]));
    snprintf(path, sizeof path, "walls.%d.size", i);
    bool is_read = oz_tree_at(root, path) && !oz_faults_name(faults, path);
    if (wall->kind == OZ_WALL_BOX && is_read && !(least > 0)) {
        oz_tree_fault(root, faults, path, "%s has a side of %g m; expected more than 0", path,
                      least);
    }
    snprintf(path, sizeof path, "walls.%d.diameter", i);
    const OzNode *diameter = oz_tree_at(root, path);
    if (wall->kind == OZ_WALL_CONE && diameter && diameter->kind == OZ_NODE_LIST &&
        !(fmax(wall->diameters[0], wall->diameters[1]) > 0)) {
        oz_tree_fault(root, faults, path, "%s is 0 at both ends; expected more than 0 at one",
                      path);
    }
}

/* In float a wall's way has 24 bits, and grains at it must be told to a ten-thousandth of their
 * diameters. */
static void check_way(const OzScene *scene, int i, OzNode *root, OzFaults *faults)
{
    const OzMotion *motion = &scene->walls[i].motion;
    const double *v = motion->velocity, bits = 16777216, share = 1e-4;
    double end = motion->until > 0 ? fmin(motion->until, scene->duration) : scene->duration;
    double way = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * fmax(end - motion->from, 0);
    way = motion->trace ? motion->trace->reach : way;
    double least = INFINITY;
    char path[64];
    for (int p = 0; p < scene->population_count; p++) {
        double diameter = scene->populations[p].diameter.low;
        least = diameter > 0 ? fmin(least, diameter) : least;
    }
    if (scene->precision == OZ_PRECISION_FLOAT && motion->present && way > bits * share * least) {
        snprintf(path, sizeof path, "walls.%d.motion.%s", i, motion->trace ? "file" : "velocity");
        oz_tree_fault(
            root, faults, path,
            "a wall goes %.3g m, of which float tells %.2g m; expected precision: double, "
            "or motion.until",
            way, way / bits);
    }
}

static void check_times(const OzWall *wall, int i, OzNode *root, OzFaults *faults)
{
    char path[64];
    snprintf(path, sizeof path, "walls.%d.until", i);
    if (wall->until > 0 && !(wall->until > wall->since)) {
        oz_tree_fault(root, faults, path, "%s is %g s; expected later than its from, %g s", path,
                      wall->until, wall->since);
    }
}

/* Each wall's own values. */
static void check_walls(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    for (int i = 0; i < scene->wall_count; i++) {
        const OzWall *wall = &scene->walls[i];
        char path[64];
        oz_check_motion_wall(wall, i, root, faults);
        check_way(scene, i, root, faults);
        snprintf(path, sizeof path, "walls.%d.ends", i);
        if (wall->kind == OZ_WALL_CYLINDER && wall->length == 0 && wall->ends == OZ_ENDS_CLOSED) {
            oz_tree_fault(root, faults, path,
                          "closed ends of an endless cylinder; expected a length with it");
        }
        check_sizes(wall, i, root, faults);
        check_times(wall, i, root, faults);
    }
}

static bool has_free(const OzView *views, int count)
{
    return (count > 0 && views[0] == OZ_VIEW_FREE) || (count > 1 && views[1] == OZ_VIEW_FREE);
}

/* What only the view free has, and no picture shows. */
static void check_views(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    const OzMovieSettings *movie = &scene->movie;
    const OzSnapshotSettings *stills = &scene->snapshots;
    bool is_shown =
        has_free(movie->views, movie->view_count) || has_free(stills->views, stills->view_count);
    if (!is_shown && (movie->has_azimuth || movie->has_elevation)) {
        const char *path = movie->has_azimuth ? "movie.azimuth" : "movie.elevation";
        oz_tree_fault(root, faults, path,
                      "%s is of the view free, which no picture has; expected it in movie.views",
                      path);
    }
}

/* A step in which a fluid would stop a grain and more throws it back. Stokes' torque stops a
 * sphere's rotation at 60 eta / (rho d^2), the wind its motion at 3/4 rho_f C_d v / (rho d). */
static void check_drag(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    const OzDrag *drag = &scene->drag;
    const double *v = drag->wind, wind = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    double fastest = 0, of = 0;
    for (int i = 0; i < scene->population_count; i++) {
        const OzPopulation *grains = &scene->populations[i];
        double d = grains->diameter.low, heavy = grains->density * d;
        double rate = 60 * drag->viscosity / (heavy * d) +
                      0.75 * drag->density * drag->coefficient * wind / heavy;
        if (heavy > 0 && rate > fastest) {
            fastest = rate;
            of = d;
        }
    }
    if (scene->step * fastest > 1) {
        oz_tree_fault(root, faults, "time.step",
                      "a fluid stops grains of %g m within %.3g s; expected a step below that", of,
                      1 / fastest);
    }
}

void oz_check_solid_scene(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    check_walls(scene, root, faults);
    oz_check_servo_scene(scene, root, faults);
    oz_boundary_check(scene, root, faults);
    check_room(scene, root, faults);
    check_singles(scene, root, faults);
    check_views(scene, root, faults);
    check_drag(scene, root, faults);
}
