/* Drag of a fluid that flows by single grains, whatever stands around them, and leaves the fluid as
 * it is: that of the sphere of a grain's volume, of the diameter d. Against the velocity v through
 * the fluid act Stokes' 3 pi eta d v, of slow ones, and pi/8 rho C_d d^2 |v| v; against the
 * rotation w Stokes' pi eta d^3 w. Switch OZ_ROUND. */
#pragma once

#include "kernels/body.h"
#include "kernels/layout.h"

/* rate: rad/s, of the grain. */
OZ_INLINE OzLoad oz_drag_load(OzDragConstants drag, OzShape shape, OzVec3 velocity, OzVec3 rate)
{
    OzLoad load;
    real r = shape.radius, cubed = r * r * (REAL(8.0) * r + REAL(12.0) * shape.half_length);
    real size = OZ_ROUND ? REAL(2.0) * r : cbrt(cubed);
    OzVec3 wind = oz_vec3(REAL(drag.wind[0]), REAL(drag.wind[1]), REAL(drag.wind[2]));
    OzVec3 through = oz_minus(wind, velocity);
    real speed = sqrt(oz_dot(through, through));
    load.force = oz_scale(through, size * (drag.linear + drag.square * size * speed));
    load.torque = oz_scale(rate, REAL(-1.0 / 3) * drag.linear * cubed);
    return load;
}
