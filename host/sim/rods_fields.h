/* Rods' fields on the device, from the one list in kernels/fields.h. */
#pragma once

#include "kernels/fields.h"
#include "sim/arrays.h"
#include "sim/constants.h"

typedef enum OzFieldId {
#define OZ_RODS_FIELDS_ID(kind, name, count, class) OZ_FIELD_##name,
    OZ_FIELDS(OZ_RODS_FIELDS_ID)
#undef OZ_RODS_FIELDS_ID
        OZ_FIELD_COUNT
} OzFieldId;

/* For the model's row (sim/model.h): rows, elements of a member's stretch. */
extern const OzField oz_rods_fields_rows[];
size_t oz_rods_fields_items(int field, const void *switches, const void *sizes);

/* The arrays' switches and sizes as what they are. */
static inline const OzSwitches *oz_rods_fields_switches(const OzArrays *arrays)
{
    return arrays->switches;
}

static inline const OzSizes *oz_rods_fields_sizes(const OzArrays *arrays)
{
    return arrays->sizes;
}

/* The region whose list has a pair whatever the regions are: that of its first grain's slot. A pair
 * across a border is in the other tile's list too (kernels/member.h). */
static inline bool oz_rods_fields_counts(const OzArrays *arrays, int region, int slot_a)
{
    return slot_a / oz_rods_fields_sizes(arrays)->region_slots == region;
}
