/* Walls of trigrains from launch to launch: where they are, and which are there. */
#include "sim/element_motion.h"

#include "base/memory.h"
#include "model/wall_motion.h"
#include "sim/element_pack.h"
#include "sim/element_private.h"
#include "sim/units.h"

#include <math.h>
#include <stdlib.h>

static OzWallPose pose_at(const OzSim *sim, int member, int wall, int64_t step)
{
    const OzScene *scene = sim->batch.members[member].scene;
    return oz_wall_motion_pose(&scene->walls[wall], oz_batch_time(&sim->batch, member, step),
                               sim->batch.walls_still);
}

static bool is_there(const OzSim *sim, int member, int wall, int64_t step)
{
    const OzScene *scene = sim->batch.members[member].scene;
    return oz_wall_motion_present(&scene->walls[wall], oz_batch_time(&sim->batch, member, step),
                                  sim->batch.walls_still);
}

/* The walls whose elements are there at a step. */
static unsigned present_at(const OzSim *sim, int member, int64_t step)
{
    unsigned present = 0;
    for (int w = 0; w < sim->batch.members[member].scene->wall_count; w++) {
        present |= is_there(sim, member, w, step) ? 1U << w : 0;
    }
    return present;
}

/* How many of these steps can be made before a wall of the member comes or goes: a step feels the
 * walls as they are at its end. */
int64_t oz_element_motion_steps_alike(const OzSim *sim, int member, int64_t steps)
{
    int64_t low = 1, high = steps;
    unsigned first = present_at(sim, member, sim->batch.step + 1);
    if (present_at(sim, member, sim->batch.step + steps) == first) {
        return steps; /* a wall that has gone never comes back */
    }
    while (high - low > 1) {
        int64_t middle = (low + high) / 2;
        *(present_at(sim, member, sim->batch.step + middle) == first ? &low : &high) = middle;
    }
    return low;
}

/* The motion of every wall of a member at each step of the launch, and at its end. */
OzStatus oz_element_motion_write_motion(OzSim *sim, int member, int steps)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->batch.members[member].scene;
    int walls = oz_element_sizes(sim)->walls;
    size_t count = (size_t)(steps + 1) * (size_t)walls * OZ_ELEMENT_MOTION;
    const OzUnits *units = &oz_element_parameters(sim, member)->units;
    double *motion = NULL;
    if (!oz_element_switches(sim)->moving) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&motion, count));
    for (int k = 0; k <= steps; k++) {
        for (int w = 0; w < scene->wall_count; w++) {
            double *words = motion + ((size_t)k * (size_t)walls + (size_t)w) * OZ_ELEMENT_MOTION;
            OzWallPose pose = pose_at(sim, member, w, sim->batch.step + k);
            words[OZ_PM_OFFSET] = pose.rise / units->length;
            words[OZ_PM_COS] = cos(pose.turn);
            words[OZ_PM_SIN] = sin(pose.turn);
            words[OZ_PM_ANGLE] = pose.turn;
            words[OZ_PM_POINT] = scene->walls[w].point[0] / units->length;
            words[OZ_PM_POINT + 1] = scene->walls[w].point[1] / units->length;
            words[OZ_PM_VELOCITY] = pose.speed / oz_units_speed(units);
            words[OZ_PM_ANGULAR_VELOCITY] = pose.angular_velocity * units->time;
        }
    }
    OZ_TRY(oz_arrays_write_scalars(&sim->arrays, OZ_ELEMENT_FIELD_motion, member, motion, count));
done:
    free(motion);
    return status;
}

OzStatus oz_element_motion_prepare(OzSim *sim, int member, int steps)
{
    OzElementControl *control = oz_element_control(sim, member);
    unsigned present = present_at(sim, member, sim->batch.step + 1);
    if (present != oz_element_own(sim)->present[member]) {
        OZ_PASS(oz_element_pack_bodies(&sim->arrays, member, sim->batch.members[member].grains,
                                       present));
        control->truth = OZ_SPRINGS_AT_NONE; /* all lists anew */
        oz_element_own(sim)->present[member] = present;
    }
    return oz_element_motion_write_motion(sim, member, steps);
}
