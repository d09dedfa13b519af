/* Checks of servo walls. */
#include "scene/check_servo.h"

#include "scene/servo.h"
#include "scene/servo_area.h"

#include <stdio.h>

enum { MOST = 6 }; /* as OZ_SERVOS_MAX of kernels/layout.h, which is not for scenes */

/* A fault at a key of the wall's servo (name: "servo.mass"). */
#define FAULT(name, ...)                                                                           \
    do {                                                                                           \
        char path_[64];                                                                            \
        snprintf(path_, sizeof path_, "walls.%d.%s", index, name);                                 \
        oz_tree_fault(root, faults, path_, __VA_ARGS__);                                           \
    } while (0)

static void check_wall(const OzScene *scene, int index, OzNode *root, OzFaults *faults)
{
    const OzWall *wall = &scene->walls[index];
    OzServoArea area;
    if (wall->motion.present) {
        FAULT("servo", "walls.%d has a motion and a servo; expected one of the two", index);
    }
    if (oz_servo_number(scene, index) == MOST) {
        FAULT("servo", "walls.%d is the seventh servo wall; expected at most %d", index, MOST);
    }
    if (wall->servo.has_pressure && !oz_servo_area_find(&area, scene, index)) {
        FAULT("servo.pressure",
              "walls.%d closes no area; expected a cylinder along its normal, planes or a box "
              "around it, a periodic cell, or servo.force instead",
              index);
    }
}

void oz_check_servo_scene(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].servo.present) {
            check_wall(scene, w, root, faults);
        }
    }
}
