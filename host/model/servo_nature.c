/* Pistons' masses and dashpots. */
#include "model/servo_nature.h"

#include "model/calibrate.h"
#include "model/hertz.h"
#include "model/predict.h"

#include <math.h>

static double total_mass(const OzGrains *grains)
{
    double sum = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        sum += grains->mass[i];
    }
    return grains->count > 0 ? sum : 1;
}

/* N/m, of a contact of two mean grains that bears a force; of several materials the stiffest. */
static double contact_stiffness(const OzScene *scene, const OzGrains *grains, double mass,
                                double force)
{
    bool linear = oz_contact_is_linear(scene->contact.law);
    double stiffest = 0;
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        if (mixed.wall < 0) {
            double own = linear ? oz_calibrate_contact(scene, &mixed.values).stiffness
                                : oz_hertz_hit(scene, &mixed, grains).stiffness;
            stiffest = fmax(stiffest, 0.5 * mass * own);
        }
    }
    return linear ? stiffest : 1.5 * cbrt(stiffest * stiffest * force);
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

OzServoNature oz_servo_nature_of(const OzScene *scene, const OzGrains *grains, int wall)
{
    const OzWall *piston = &scene->walls[wall];
    const OzServo *servo = &piston->servo;
    double all = total_mass(grains), count = fmax((double)grains->count, 1), row = cbrt(count);
    OzServoNature nature = {.mass = servo->mass > 0 ? servo->mass : all};
    nature.has_area = oz_servo_area_find(&nature.area, scene, wall);
    double area = nature.has_area ? nature.area.side[0] * nature.area.side[1] : 0;
    nature.load = servo->force + servo->pressure * area;
    nature.load += servo->weight ? nature.mass * dot(scene->gravity, piston->normal) : 0;
    double gravity = sqrt(dot(scene->gravity, scene->gravity));
    double force = fmax(fabs(nature.load), all * gravity) / (row * row);
    double contact = contact_stiffness(scene, grains, all / count, force);
    nature.stiffness = row * contact;
    nature.touching = row * row * contact;
    nature.damping = servo->has_damping ? servo->damping : 2 * sqrt(nature.mass * nature.stiffness);
    bool verlet = scene->integrator == OZ_INTEGRATOR_VELOCITY_VERLET;
    nature.largest_step = oz_predict_largest_step(
        verlet ? OZ_INTEGRATOR_VELOCITY_VERLET : OZ_INTEGRATOR_SYMPLECTIC_EULER,
        nature.touching / nature.mass, nature.damping / nature.mass);
    return nature;
}
