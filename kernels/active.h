/* Items that a sieve picks from blocks of lanes, kept until they fill blocks again: what costs much
 * is then done for full blocks of those that need it. A load that spans two stores still under way
 * waits for both, so picks are kept for several blocks before they are read. OpenCL C only. */
#pragma once

#include "kernels/lanes.h"

enum {
    OZ_ACTIVE_BLOCKS =
        OZ_LANES == 1 ? 1
                      : 8, /* sieved before the picked items' turn; then less than one is left */
    OZ_ACTIVE_MOST = (OZ_ACTIVE_BLOCKS + 2) * OZ_LANES
};

typedef struct OzActive {
    int count;
    int item[OZ_ACTIVE_MOST];
} OzActive;

/* A lane that counts among the first `count`. */
#define OZ_ACTIVE_BEFORE(count) oz_lanes_mask_of(OZ_LANES_IOTA < (count))

OZ_INLINE void oz_active_add(OzActive *active, index items, int bits)
{
    oz_lanes_close_up(active->item + active->count, items, bits);
    active->count += popcount(bits);
}

/* How many picked items are to have their turn now: whole blocks; the last ones all, filled up to a
 * block. */
OZ_INLINE int oz_active_due(const OzActive *active, int last)
{
    return (active->count + (last ? OZ_LANES - 1 : 0)) / OZ_LANES * OZ_LANES;
}

/* Fills the block that ends at `due` with its first item again: what is written for it twice is the
 * same. */
OZ_INLINE void oz_active_fill(OzActive *active, int due)
{
    for (int l = active->count; l < due; l++) {
        active->item[l] = active->item[due - OZ_LANES];
    }
}

/* Forgets the items before `due`. */
OZ_INLINE void oz_active_drop(OzActive *active, int due)
{
    OZ_LANES_STORE(OZ_LANES_LOAD(active->item + due), active->item);
    active->count = max(active->count - due, 0);
}

/* A number that goes along with each item. */
OZ_INLINE void oz_active_add_word(const OzActive *active, scalar *word, real values, int bits)
{
    oz_lanes_close_up_real(word + active->count, values, bits);
}

OZ_INLINE void oz_active_fill_word(const OzActive *active, scalar *word, int due)
{
    for (int l = active->count; l < due; l++) {
        word[l] = word[due - OZ_LANES];
    }
}

OZ_INLINE void oz_active_drop_word(scalar *word, int due)
{
    OZ_LANES_STORE(OZ_LANES_LOAD(word + due), word);
}
