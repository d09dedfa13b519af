/* The physics of elements compiled for the host: real is double, and the switches that are
 * constants on a device are fields of one struct here. For .c files alone: each that includes this
 * has a struct of its own for each thread, to be set to the scene's switches before any of the
 * physics is called. */
#pragma once

#include "sim/element_laws.h"

static _Thread_local struct {
    int midpoint; /* the force point of triangles' contacts                */
    int balanced; /* beams' damping moments are balanced by a shear force  */
} element_dialect;

#define OZ_FORCE_POINT   element_dialect.midpoint
#define OZ_DAMPING_SHEAR element_dialect.balanced

#include "kernels/beam.h"
#include "kernels/disc.h"
#include "kernels/triangle.h"

OZ_INLINE void oz_element_dialect_set(const OzScene *scene)
{
    element_dialect.midpoint = scene->triangles.force_point == OZ_FORCE_MIDPOINT;
    element_dialect.balanced = scene->beams.damping_shear == OZ_SHEAR_BALANCED;
}
