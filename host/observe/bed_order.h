/* What the order columns of rods say (observe.order), found once for each row. */
#pragma once

#include "model/local_order.h"

/* Zeroed is empty; memory is kept from row to row. */
typedef struct OzBedOrder {
    OzLocalOrder local;
    int64_t rods;
    double nematic_axis; /* mean of (3 (u.a)^2 - 1)/2 over the rods, a the container's axis */
    double psi6;         /* mean over the rods (model/local_order.h)                        */
    bool has_contacts;
    int64_t rattlers; /* grains that touch less than two others or walls (Thornton 2000)  */
    int32_t *touches; /* on the way: of each grain                                        */
    int64_t capacity;
} OzBedOrder;

/* Fails with OZ_ERR_MEMORY. */
OzStatus oz_bed_order_find(OzBedOrder *order, const OzSnapshot *snapshot);

void oz_bed_order_free(OzBedOrder *order);
