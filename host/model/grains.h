/* The grains as the host holds them: arrays indexed by id (0 first, in scene order), double, SI.
 * Geometry and mass never change during a run; position to spin are the start. */
#pragma once

#include "base/status.h"
#include "model/elements.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct OzGrains {
    int64_t count;
    double *diameter;         /* m                                                     */
    double *length;           /* m, shaft: aspect x diameter                           */
    double *mass;             /* kg                                                    */
    double *inertia;          /* kg m^2, about an axis across the shaft (P eq. 10)     */
    double *inertia_axis;     /* kg m^2, about the shaft                             */
    int *population;          /* row of the scene's grains list                        */
    double *position;         /* 3 x count: x y z of grain 0, then of grain 1, ...     */
    double *quaternion;       /* 4 x count: w x y z; turns body z into the shaft axis  */
    double *velocity;         /* 3 x count, m/s                                        */
    double *angular_velocity; /* 3 x count, rad/s, world frame                         */
    OzElements *elements;     /* owned: what trigrains and their walls are made of; NULL for rods.
                               * Grains then lie in the plane z = 0, turn about z, and diameter is
                               * that of the smallest circle about the centre of mass; length is 0 */
} OzGrains;

/* Allocates count zeroed grains; the caller frees with oz_grains_free. */
OzStatus oz_grains_create(OzGrains *grains, int64_t count);
void oz_grains_free(OzGrains *grains);

/* Mass and both moments of inertia of grain i from its diameter and length (Pournin et al. 2005,
 * eq. 10). */
void oz_grains_set_mass(OzGrains *grains, int64_t i, double density);

/* The unit axis of a unit quaternion (w x y z): body z turned into the world. */
void oz_grains_axis(const double quaternion[4], double axis[3]);

/* A unit quaternion that turns body z into axis (unit vector). */
void oz_grains_quaternion(const double axis[3], double quaternion[4]);

/* Volume of a spherocylinder, m^3. */
double oz_grains_volume(double diameter, double length);

/* Refuses, with OZ_ERR_INPUT, more grains than this machine's memory holds whatever else the scene
 * asks for. */
OzStatus oz_grains_check_memory(const char *scene_path, int64_t count);

/* One scene of a simulation, which copies what it needs of it, and its grains, borrowed, which must
 * outlive it. */
typedef struct OzMember {
    const OzScene *scene;
    const OzGrains *grains;
} OzMember;
