/* Checks of walls' motion. */
#include "scene/check_motion.h"

#include "scene/wall_shape.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

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

/* A wall that goes on goes along one line, and any ends after it starts.
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
    bool moves = motion->frequency > 0 || goes_on(motion) || motion->file || motion->has_turning;
    if (is_timed && !moves) {
        FAULT(timed, "a wall that does not move starts or stops; expected motion.frequency, "
                     "motion.velocity, motion.angular_velocity or motion.file with it");
    }
    if (motion->phase != 0 && !(motion->frequency > 0)) {
        FAULT(".phase", "a wall that is not shaken has a phase; expected motion.frequency with it");
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

/* Where it was built, whatever its phase. */
static void start(OzMotion *motion)
{
    double phase = motion->phase * PI / 180;
    motion->shake = (OzShake){.since = motion->from,
                              .phase = phase,
                              .base = motion->amplitude * sin(phase),
                              .taps = motion->from * motion->frequency};
}

void oz_check_motion_derive(OzMotion *motion, double gravity, int index, OzNode *root,
                            OzFaults *faults)
{
    double omega = 2 * PI * motion->frequency;
    if (!motion->present || omega == 0) {
        return;
    }
    if (motion->written_amplitude != 0) {
        motion->amplitude = motion->written_amplitude;
        motion->acceleration_ratio = gravity > 0 ? motion->amplitude * omega * omega / gravity : 0;
    } else {
        motion->amplitude = motion->acceleration_ratio * gravity / (omega * omega);
    }
    start(motion);
    if (motion->written_amplitude == 0 && gravity == 0 && motion->acceleration_ratio > 0) {
        FAULT(".acceleration_ratio", "%s without gravity; expected amplitude", path_);
    }
}
