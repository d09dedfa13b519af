/* Items that a sieve picks from blocks of lanes, kept until they fill blocks again: what costs much is then done
 * for full blocks of those that need it. A load that spans two stores still under way waits for both, so picks
 * are kept for several blocks before they are read. OpenCL C only. */
#ifndef OZ_KERNELS_PICKED_H
#define OZ_KERNELS_PICKED_H

#include "kernels/lanes.h"

enum {
    OZ_PICKED_BLOCKS = OZ_LANES == 1 ? 1 : 8, /* sieved before the picked items' turn; then less than one is left */
    OZ_PICKED_MOST = (OZ_PICKED_BLOCKS + 2) * OZ_LANES
};

typedef struct OzPicked {
    int count;
    int item[OZ_PICKED_MOST];
} OzPicked;

/* A lane that counts among the first `count`. */
#define OZ_PICKED_BEFORE(count) oz_lanes_mask_of(OZ_LANES_IOTA < (count))

OZ_INLINE void oz_picked_add(OzPicked *picked, index items, int bits)
{
    oz_lanes_close_up(picked->item + picked->count, items, bits);
    picked->count += popcount(bits);
}

/* How many picked items are to have their turn now: whole blocks; the last ones all, filled up to a block. */
OZ_INLINE int oz_picked_due(const OzPicked *picked, int last)
{
    return (picked->count + (last ? OZ_LANES - 1 : 0)) / OZ_LANES * OZ_LANES;
}

/* Fills the block that ends at `due` with its first item again: what is written for it twice is the same. */
OZ_INLINE void oz_picked_fill(OzPicked *picked, int due)
{
    for (int l = picked->count; l < due; l++) {
        picked->item[l] = picked->item[due - OZ_LANES];
    }
}

/* Forgets the items before `due`. */
OZ_INLINE void oz_picked_drop(OzPicked *picked, int due)
{
    OZ_LANES_STORE(OZ_LANES_LOAD(picked->item + due), picked->item);
    picked->count = max(picked->count - due, 0);
}

/* A number that goes along with each item. */
OZ_INLINE void oz_picked_add_word(const OzPicked *picked, scalar *word, real values, int bits)
{
    oz_lanes_close_up_real(word + picked->count, values, bits);
}

OZ_INLINE void oz_picked_fill_word(const OzPicked *picked, scalar *word, int due)
{
    for (int l = picked->count; l < due; l++) {
        word[l] = word[due - OZ_LANES];
    }
}

OZ_INLINE void oz_picked_drop_word(scalar *word, int due)
{
    OZ_LANES_STORE(OZ_LANES_LOAD(word + due), word);
}

#endif
