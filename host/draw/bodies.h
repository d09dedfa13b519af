/* Rods and spheres in view coordinates, nearest first, and on which side of the cut each lies.
 * Knows no GL. */
#pragma once

#include "draw/camera.h"
#include "draw/pressed.h"
#include "model/local_order.h"

/* A rod or sphere in view coordinates. */
typedef struct OzBody {
    float centre[3], radius;
    float axis[3], half_shaft; /* axis: a unit vector */
} OzBody;

/* Of the cut plane: kept whole, cut, taken away. */
typedef enum OzSide { OZ_SIDE_BEHIND, OZ_SIDE_CROSSING, OZ_SIDE_FRONT, OZ_SIDE_COUNT } OzSide;

typedef struct OzBodies {
    const OzSnapshot *snapshot; /* these three borrowed */
    const OzLook *look;
    const OzCamera *camera;
    double inward[3],
        offset;      /* the cut: its normal into the half that is kept, distance along it */
    OzBody *bodies;  /* nearest first, those of equal depth in the snapshot's order       */
    int64_t *grains; /* of each, which grain of the snapshot it is; from its count on, a chain */
    int64_t count, capacity;
    OzLocalOrder order;     /* for OZ_COLOUR_ORDER alone */
    OzPressed pressed;      /* for what shows contacts   */
    OzBody *unsorted;       /* on the way */
    double low[2], high[2]; /* view coordinates x and y that they may reach */
} OzBodies;

/* Takes the snapshot's grains; memory is kept from one to the next. Fails with OZ_ERR_MEMORY. */
OzStatus oz_bodies_take(OzBodies *bodies, const OzSnapshot *snapshot, const OzLook *look,
                        const OzCamera *camera);

void oz_bodies_free(OzBodies *bodies); /* zeroed is fine */

/* The colour of the k-th. */
void oz_bodies_colour(const OzBodies *bodies, int64_t k, float rgb[3]);

/* The side of the k-th in a view of this kind; in one that cuts nothing all are behind. */
OzSide oz_bodies_side(const OzBodies *bodies, OzView view, int64_t k);

/* What may be painted of a view: grains, and a container that is seen up to this view coordinate y.
 */
OzBox oz_bodies_box(const OzBodies *bodies, int view, double container_high);
