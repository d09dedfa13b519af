/* Servo walls between scene, device and snapshot. */
#include "sim/servos.h"

#include "model/servo_nature.h"
#include "scene/servo.h"
#include "sim/rods_private.h"
#include "sim/units.h"

#include <stdlib.h>

/* The number of the servo that bounds an area; -1: none does. */
static int bound_of(const OzScene *scene, int wall)
{
    return wall >= 0 && scene->walls[wall].servo.present ? oz_servo_number(scene, wall) : -1;
}

static OzServoConstants constants_of(const OzScene *scene, const OzGrains *grains, int wall)
{
    const OzServo *servo = &scene->walls[wall].servo;
    OzServoNature nature = oz_servo_nature_of(scene, grains, wall);
    OzServoConstants to = {.mass = nature.mass,
                           .damping = nature.damping,
                           .force = servo->force,
                           .pressure = nature.has_area ? servo->pressure : 0};
    for (int c = 0; c < 3 && servo->weight; c++) {
        to.force += nature.mass * scene->gravity[c] * scene->walls[wall].normal[c];
    }
    for (int k = 0; k < 2; k++) {
        to.gap[k] = nature.has_area ? nature.area.side[k] : 1;
        to.bound[2 * k] = bound_of(scene, nature.area.bound[k][0]);
        to.bound[2 * k + 1] = bound_of(scene, nature.area.bound[k][1]);
    }
    return to;
}

void oz_servos_fill(OzParameters *parameters, const int *order, int count, const OzScene *scene,
                    const OzGrains *grains)
{
    for (int k = 0; k < count; k++) {
        int number = oz_servo_number(scene, order[k]);
        if (scene->walls[order[k]].servo.present && number < OZ_SERVOS_MAX) {
            parameters->servo[number] = constants_of(scene, grains, order[k]);
            parameters->servo[number].wall = k;
        }
    }
}

OzStatus oz_servos_hold(OzSim *sim, int member)
{
    int held = sim->batch.walls_still;
    return oz_arrays_write(&sim->arrays, OZ_FIELD_servo_held, member, &held, sizeof held);
}

OzStatus oz_servos_read(const OzSim *sim, int member, OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    const OzUnits *units = &oz_rods_parameters(sim, member)->units;
    double *words = NULL;
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_servo, member, &words));
    for (int w = 0; w < snapshot->scene->wall_count; w++) {
        const double *from = words + OZ_SERVO * oz_servo_number(snapshot->scene, w);
        if (snapshot->scene->walls[w].servo.present) {
            snapshot->wall_offset[w] = from[OZ_SERVO_PLACE] * units->length;
            snapshot->wall_velocity[w] = from[OZ_SERVO_SPEED] * oz_units_speed(units);
            snapshot->wall_push[w] = from[OZ_SERVO_PUSH] * oz_units_force(units);
        }
    }
done:
    free(words);
    return status;
}
