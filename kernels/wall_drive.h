/* How a driven wall moves: as a whole along a direction, and about an axis through its point that
 * leaves its shape as it is, or through another one (wall_swing.h). */
#ifndef OZ_KERNELS_WALL_DRIVE_H
#define OZ_KERNELS_WALL_DRIVE_H

#include "kernels/vec3.h"

typedef struct OzWallDrive {
    OzVec3 direction, axis; /* unit vectors                          */
    real offset, speed;     /* m, m/s along direction                */
    real rate;              /* rad/s about axis                      */
#if defined(OZ_HOST) || OZ_SWUNG
    OzVec3 away, lead; /* m, m/s: of the wall's point, by its turning     */
#endif
} OzWallDrive;

/* The velocity of the wall at a place that is seen from its point, where that is now. */
OZ_INLINE OzVec3 oz_wall_drive_velocity(OzWallDrive drive, OzVec3 place)
{
    OzVec3 velocity =
        oz_along(oz_scale(drive.direction, drive.speed), drive.rate, oz_cross(drive.axis, place));
#if defined(OZ_HOST) || OZ_SWUNG
    velocity = oz_add(velocity, drive.lead);
#endif
    return velocity;
}

#endif
