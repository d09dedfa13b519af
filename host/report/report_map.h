/* `orzo report --map`: where a lasting contact comes to rest, for each integrator, over steps per
 * contact and restitution; measured with the reference, the theory drawn in. */
#pragma once

#include "scene/scene.h"

typedef enum OzMapVerdict {
    OZ_MAP_STABLE,   /* the swing dies out, or keeps its size without damping */
    OZ_MAP_DRIFTING, /* it lasts or grows, and stays below a hundred times its start */
    OZ_MAP_EXPLODED
} OzMapVerdict;

/* A sphere resting on a plane, nudged, after 100 contact times in double. *amplitude receives the
 * size of its swing over that of the nudge (INFINITY after a blow-up). */
OzStatus oz_report_map_try(OzMapVerdict *verdict, double *amplitude, OzIntegrator integrator,
                           double steps_per_contact, double restitution);

/* Leaves folder/stability.csv and, with gnuplot, folder/stability.png. */
OzStatus oz_report_map_draw(const char *folder);
