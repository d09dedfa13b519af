/* Checks of walls' motion. */
#include "scene/check_motion.h"

#include "scene/wall_shape.h"

/* A fault at a key of the wall's motion, or at the motion itself (name: ""). */
#define FAULT(name, ...)                                                                           \
    do {                                                                                           \
        char path_[64];                                                                            \
        snprintf(path_, sizeof path_, "walls.%d.motion%s", index, name);                           \
        oz_tree_fault(root, faults, path_, __VA_ARGS__);                                           \
    } while (0)

/* Whether the wall's motion is a group of keys, as it should be. */
static bool is_group(OzNode *root, int index)
{
    char path[64];
    snprintf(path, sizeof path, "walls.%d.motion", index);
    const OzNode *node = oz_tree_at(root, path);
    return node && (node->kind == OZ_NODE_MAP ||
                    (node->kind == OZ_NODE_SCALAR && node->text && node->text[0] == '\0'));
}

static bool is_written(OzNode *root, int index, const char *name)
{
    char path[64];
    snprintf(path, sizeof path, "walls.%d.motion.%s", index, name);
    return oz_tree_at(root, path) != NULL;
}

static bool goes_on(const OzMotion *motion)
{
    return motion->velocity[0] != 0 || motion->velocity[1] != 0 || motion->velocity[2] != 0;
}

/* A wall that goes on goes along one line, and ends after it starts, as one that turns does.
 * Upright cylinders hold pictures and the room for grains in place. */
static void check_steady(const OzWall *wall, int index, OzNode *root, OzFaults *faults)
{
    const OzMotion *motion = &wall->motion;
    const double *v = motion->velocity;
    if (goes_on(motion) && motion->frequency > 0) {
        FAULT(".velocity", "a wall that is shaken has a velocity, too; expected one of the two");
    }
    if (goes_on(motion) && oz_wall_shape_is_upright(wall) && (v[0] != 0 || v[1] != 0)) {
        FAULT(".velocity", "an upright cylinder goes sideways; expected another wall");
    }
    bool is_timed = motion->from > 0 || motion->until > 0;
    const char *timed = motion->from > 0 ? ".from" : ".until";
    if (is_timed && motion->frequency > 0) {
        FAULT(timed, "a wall that is shaken starts or stops; expected one of the two");
    } else if (is_timed && !goes_on(motion) && !motion->file && !motion->has_turning) {
        FAULT(timed, "a wall that neither goes on nor turns starts or stops; expected "
                     "motion.velocity, motion.angular_velocity or motion.file with it");
    }
    if (motion->until > 0 && motion->until <= motion->from) {
        FAULT(".until", "a wall stops at %g s and starts at %g s; expected a later end",
              motion->until, motion->from);
    }
}

/* A trace says all of the way. */
static void check_trace(const OzWall *wall, int index, OzNode *root, OzFaults *faults)
{
    const OzMotion *motion = &wall->motion;
    const bool told[] = {motion->column != NULL, motion->measured != OZ_MEASURED_OFFSET,
                         motion->scale != 1, motion->closed};
    static const char *const names[] = {".column", ".measured", ".scale", ".closed"};
    for (int k = 0; k < 4 && !motion->file; k++) {
        if (told[k]) {
            FAULT(names[k], "a wall without a trace has a motion%s; expected motion.file with it",
                  names[k]);
        }
    }
    if (motion->file && (motion->frequency > 0 || goes_on(motion))) {
        FAULT(".file", "a wall that is shaken or has a velocity follows a trace, too; expected one "
                       "of them");
    }
}

/* What turns about another point than its own does turn. */
static void check_turning(const OzWall *wall, int index, OzNode *root, OzFaults *faults)
{
    const OzMotion *motion = &wall->motion;
    if (motion->has_point && !motion->has_turning) {
        FAULT(".point", "a wall without an angular_velocity has a point to turn about; expected "
                        "motion.angular_velocity with it");
    }
}

void oz_check_motion_wall(const OzWall *wall, int index, OzNode *root, OzFaults *faults)
{
    const OzMotion *motion = &wall->motion;
    bool shaken =
        is_written(root, index, "amplitude") || is_written(root, index, "acceleration_ratio");
    bool has_frequency = is_written(root, index, "frequency");
    if (!motion->present || !is_group(root, index)) {
        return;
    }
    if (shaken && !has_frequency) {
        FAULT("", "a wall moves up and down without a frequency; expected both");
    } else if (!shaken && has_frequency) {
        FAULT(".frequency",
              "a wall has a frequency alone; expected acceleration_ratio or amplitude with it");
    } else if (!shaken && !is_written(root, index, "angular_velocity") && !goes_on(motion) &&
               !is_written(root, index, "file")) {
        FAULT("", "motion says nothing; expected velocity, angular_velocity, file, or frequency "
                  "with acceleration_ratio or amplitude");
    }
    check_trace(wall, index, root, faults);
    check_steady(wall, index, root, faults);
    check_turning(wall, index, root, faults);
}
