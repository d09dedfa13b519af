/* Means over a bed. */
#include "observe/bed_order.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

void oz_bed_order_free(OzBedOrder *order)
{
    oz_local_order_free(&order->local);
    free(order->touches);
    memset(order, 0, sizeof *order);
}

static void see_rods(OzBedOrder *order, const OzSnapshot *snapshot)
{
    double axis[3], along_sum = 0, psi6_sum = 0;
    oz_local_order_axis(snapshot->scene, axis);
    order->rods = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        const double *u = &snapshot->axis[3 * i];
        double along = u[0] * axis[0] + u[1] * axis[1] + u[2] * axis[2];
        if (snapshot->grains->length[i] > 0) {
            along_sum += (3 * along * along - 1) / 2;
            psi6_sum += order->local.psi6[i];
            order->rods++;
        }
    }
    double count = order->rods > 0 ? (double)order->rods : 1;
    order->nematic_axis = along_sum / count;
    order->psi6 = psi6_sum / count;
}

/* The list is sorted: contacts of the same two follow each other, and a rod that lies on a wall
 * with both ends touches it once. */
static OzStatus see_contacts(OzBedOrder *order, const OzSnapshot *snapshot)
{
    order->has_contacts = snapshot->has_contacts;
    if (snapshot->count > order->capacity || !order->touches) {
        free(order->touches);
        OZ_PASS(OZ_NEW(&order->touches, snapshot->count));
        order->capacity = snapshot->count;
    }
    memset(order->touches, 0, (size_t)snapshot->count * sizeof *order->touches);
    for (int64_t c = 0; c < snapshot->contacts.count; c++) {
        const OzContactEntry *e = &snapshot->contacts.entry[c];
        bool again = c > 0 && e[-1].a == e->a && e[-1].b == e->b;
        order->touches[e->a] += !again;
        if (e->b >= 0) {
            order->touches[e->b] += !again;
        }
    }
    order->rattlers = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        order->rattlers += order->touches[i] < 2;
    }
    return OZ_OK;
}

OzStatus oz_bed_order_find(OzBedOrder *order, const OzSnapshot *snapshot)
{
    OZ_PASS(oz_local_order_find(&order->local, snapshot));
    see_rods(order, snapshot);
    return see_contacts(order, snapshot);
}
