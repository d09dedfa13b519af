/* The checks of trigrains that need more than one value. Whether a polygon can be cut into
 * triangles, and whether grains find room, is seen when grains are made. */
#include "scene/check_flat.h"

#include "scene/check_motion.h"
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>

typedef struct Checker {
    OzScene *scene;
    OzNode *root;
    OzFaults *faults;
    const char *list; /* "walls" or "grains" */
    int index;
} Checker;

/* A fault at a key of the item that is being checked. */
#define FAULT(checker, name, ...)                                                                  \
    do {                                                                                           \
        char path_[64];                                                                            \
        snprintf(path_, sizeof path_, "%s.%d.%s", (checker)->list, (checker)->index, name);        \
        oz_tree_fault((checker)->root, (checker)->faults, path_, __VA_ARGS__);                     \
    } while (0)

static bool is_written(const Checker *checker, const char *name)
{
    char path[64];
    snprintf(path, sizeof path, "%s.%d.%s", checker->list, checker->index, name);
    return oz_tree_at(checker->root, path) != NULL;
}

static void check_corners(const Checker *checker, const OzPopulation *grains)
{
    const OzRange *corners = &grains->corners;
    bool asked = grains->shape == OZ_SHAPE_POLYGON || grains->shape == OZ_SHAPE_STAR;
    bool whole = corners->low == floor(corners->low) && corners->high == floor(corners->high);
    if (!asked || whole) {
        return;
    }
    if (corners->low == corners->high) {
        FAULT(checker, "corners", "grains.%d.corners is %g; expected a whole number",
              checker->index, corners->low);
    } else {
        FAULT(checker, "corners", "grains.%d.corners is [%g, %g]; expected whole numbers",
              checker->index, corners->low, corners->high);
    }
}

static void check_vertices(const Checker *checker, const OzPopulation *grains)
{
    int count = grains->vertex_count;
    bool wrong = count < 6 || count % 2 || count > 2 * OZ_CORNERS_MAX;
    if (grains->shape == OZ_SHAPE_VERTICES && grains->vertices && wrong) {
        FAULT(checker, "vertices",
              "grains.%d.vertices is a list of %d; expected x and y of 3 to %d corners",
              checker->index, count, OZ_CORNERS_MAX);
    }
}

static void check_teeth(const Checker *checker, const OzWall *wall)
{
    if ((wall->tooth_count > 0) != (wall->tooth_depth > 0)) {
        FAULT(checker, wall->tooth_count > 0 ? "teeth" : "tooth_depth",
              "%lld teeth of depth %g m; expected both or neither", (long long)wall->tooth_count,
              wall->tooth_depth);
    }
    if (wall->kind == OZ_WALL_DRUM && wall->tooth_depth >= wall->diameter / 2) {
        FAULT(checker, "tooth_depth", "teeth of %g m fill the drum; expected less than %g m",
              wall->tooth_depth, wall->diameter / 2);
    }
    if (wall->kind == OZ_WALL_DRUM && wall->tooth_count > 0 && wall->tooth_count < 3) {
        FAULT(checker, "teeth", "a drum of %lld teeth is not round; expected at least 3",
              (long long)wall->tooth_count);
    }
}

static void check_hopper(const Checker *checker, const OzWall *wall)
{
    double rise = (wall->width - wall->opening) / 2 * tan(wall->slope);
    if (wall->opening >= wall->width) {
        FAULT(checker, "opening", "the opening is %g m wide; expected less than the hopper's %g m",
              wall->opening, wall->width);
    } else if (rise > wall->height) {
        FAULT(checker, "height",
              "the hopper is %g m high and its slopes rise %g m; expected at least that",
              wall->height, rise);
    }
}

static void check_wall(const Checker *checker, const OzWall *wall)
{
    oz_check_motion_wall(wall, checker->index, checker->root, checker->faults);
    check_teeth(checker, wall);
    if (wall->kind == OZ_WALL_HOPPER && wall->width > 0) {
        check_hopper(checker, wall);
    }
    if (wall->kind == OZ_WALL_SEGMENT && is_written(checker, "from") && is_written(checker, "to") &&
        wall->from[0] == wall->to[0] && wall->from[1] == wall->to[1]) {
        FAULT(checker, "to", "the segment has length zero; expected two points");
    }
}

static void check_yield(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    const OzBeamYieldValues *y = &scene->beams.yield;
    bool is_said = oz_tree_at(root, "beams.yield.tension") ||
                   oz_tree_at(root, "beams.yield.compression") ||
                   oz_tree_at(root, "beams.yield.moment");
    if (!is_said && isinf(y->tension) && isinf(y->compression) && isinf(y->moment)) {
        oz_tree_fault(root, faults, "beams.yield",
                      "beams.yield says nothing; expected tension, compression or moment");
    }
}

static void check_strength(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    const OzBeamStrengthValues *s = &scene->beams.strength;
    bool is_said = oz_tree_at(root, "beams.strength.tension") ||
                   oz_tree_at(root, "beams.strength.compression") ||
                   oz_tree_at(root, "beams.strength.moment");
    if (!is_said && isinf(s->tension) && isinf(s->compression) && isinf(s->moment)) {
        oz_tree_fault(root, faults, "beams.strength",
                      "beams.strength says nothing; expected tension, compression or moment");
    }
    for (int k = 0; k < scene->export_count; k++) {
        if (scene->exports[k] == OZ_EXPORT_H5MD) {
            oz_tree_fault(root, faults, "export",
                          "h5md is for as many grains as at the start; expected vtk, xyz or csv "
                          "with beams.strength");
        }
    }
}

void oz_check_flat_scene(OzScene *scene, OzNode *root, OzFaults *faults)
{
    Checker checker = {scene, root, faults, "grains", 0};
    for (; checker.index < scene->population_count; checker.index++) {
        check_corners(&checker, &scene->populations[checker.index]);
        check_vertices(&checker, &scene->populations[checker.index]);
    }
    checker.list = "walls";
    for (checker.index = 0; checker.index < scene->wall_count; checker.index++) {
        scene->walls[checker.index].contact = scene->contact;
        check_wall(&checker, &scene->walls[checker.index]);
    }
    if (scene->beams.substeps > 1 && scene->integrator != OZ_INTEGRATOR_VELOCITY_VERLET) {
        oz_tree_fault(root, faults, "beams.substeps",
                      "beams.substeps is %lld; expected 1, or integrator velocity-verlet",
                      (long long)scene->beams.substeps);
    }
    if (scene->beams.strength.present) {
        check_strength(scene, root, faults);
    }
    if (scene->beams.yield.present) {
        check_yield(scene, root, faults);
    }
    if (scene->snapshots.strobe > 0 && oz_scene_shows_contacts(scene)) {
        oz_tree_fault(root, faults, "snapshots.strobe",
                      "snapshots.strobe of pictures that show contacts, which its states do not "
                      "keep; expected another colour, and no movie.chains");
    }
}
