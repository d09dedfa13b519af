/* What a scene says of the ends of space. */
#pragma once

#include <stdbool.h>

typedef enum OzBoundaryKind { OZ_BOUNDARY_OPEN, OZ_BOUNDARY_PERIODIC } OzBoundaryKind;

/* What is at the ends of space, rods. Where it is periodic, what leaves a cell about the origin on
 * one side comes in on the other, and all of it meets its own images there. */
typedef struct OzBoundary {
    bool present;
    OzBoundaryKind along[3]; /* each axis                                        */
    double size[3];          /* m, of the cell; not looked at where space is open */
    bool is_sheared;         /* shear_rate is given                              */
    double shear_rate;       /* 1/s: the flow's velocity along x over y          */
    double strain, since;    /* by which it was sheared at that time, s          */
    double tilt;             /* of its lattice: x = x' + tilt y; 0 as loaded (scene/boundary.h) */
} OzBoundary;
