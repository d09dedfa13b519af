/* How far rods stand beside each other as in a crystal: of each rod, the hexagonal order of its
 * neighbours' places across the container's axis, and how parallel they are. From places and axes
 * alone, without contacts.
 *
 * Neighbours of a rod are the rods whose centres lie beside it: at most half a rod's height away
 * along the axis (height: what a rod reaches along the axis, L |u.a| + d; of two rods the mean),
 * and at most OZ_LOCAL_ORDER_REACH mean diameters across it. With theta_k the direction of the way
 * to neighbour k across the axis, psi6 = |sum of exp(6 i theta_k)| / n over n neighbours (Halperin
 * and Nelson 1978, eq. 3; Nelson, Rubinstein and Spaepen 1982): 1 where all directions are whole
 * multiples of 60 degrees apart. Of a rod with less than OZ_LOCAL_ORDER_LEAST neighbours it is 0:
 * any one or two would give a number, and rods that lie have few. Neighbours across the border of a
 * periodic cell count. */
#pragma once

#include "model/snapshot.h"

/* Between the first and the second shell of a hexagonal packing, at 1 and sqrt(3) diameters. */
#define OZ_LOCAL_ORDER_REACH 1.4
enum { OZ_LOCAL_ORDER_LEAST = 3 };

/* Zeroed is empty; memory is kept from one snapshot to the next. */
typedef struct OzLocalOrder {
    double *psi6;    /* 0..1, of each grain; 0 of spheres                                        */
    double *crystal; /* 0..1: psi6 times the mean of (3 (u.u_k)^2 - 1)/2 over its neighbours, not
                        below 0: 1 in a crystal of upright rods                                  */
    double *place;   /* on the way: along two directions across the axis and along it, m */
    int64_t *next, *heads, capacity, head_capacity; /* rods of one cell are chained by next      */
} OzLocalOrder;

/* The unit vector along the scene's first cylinder; z without one. */
void oz_local_order_axis(const OzScene *scene, double axis[3]);

/* Fails with OZ_ERR_MEMORY. */
OzStatus oz_local_order_find(OzLocalOrder *order, const OzSnapshot *snapshot);

void oz_local_order_free(OzLocalOrder *order);
