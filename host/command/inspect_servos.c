/* Lines of pistons. */
#include "command/inspect_servos.h"

#include "model/servo_nature.h"

#include <math.h>

static void print_servo(FILE *file, const OzScene *scene, const OzGrains *grains, int w)
{
    const OzServo *servo = &scene->walls[w].servo;
    OzServoNature nature = oz_servo_nature_of(scene, grains, w);
    fprintf(file, "  piston %-2d        ", w);
    if (servo->has_pressure && nature.has_area) {
        fprintf(file, "%.4g Pa on %.4g m^2: ", servo->pressure,
                nature.area.side[0] * nature.area.side[1]);
    }
    fprintf(file, "%.4g N%s; mass %.4g kg%s, damping %.4g kg/s%s\n", nature.load,
            servo->weight ? ", its weight included" : "", nature.mass,
            servo->mass > 0 ? "" : " (all grains')", nature.damping,
            servo->has_damping ? "" : " (critical on a cube of the grains)");
    fputs("                   ", file);
    if (nature.damping > 0) {
        fprintf(file, "with nothing in its way it goes at %.3g m/s; ",
                nature.load / nature.damping);
    }
    double swing = 2 * M_PI * sqrt(nature.mass / nature.stiffness);
    if (isfinite(swing)) {
        fprintf(file, "on a cube of the grains it swings in %.3g s; ", swing);
    }
    fprintf(file, "largest step %.3g s%s\n", nature.largest_step,
            scene->step < nature.largest_step ? ""
                                              : ", less than the step: a heavier piston, or "
                                                "less damping");
}

void oz_inspect_servos_print(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].servo.present) {
            print_servo(file, scene, grains, w);
        }
    }
}
