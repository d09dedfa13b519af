/* Trigrains' fields on the device, from the one list in kernels/element_fields.h. */
#pragma once

#define OZ_HOST
#include "kernels/element_fields.h"
#include "kernels/element_layout.h"
#include "sim/arrays.h"
#include "sim/element_switches.h"

typedef enum OzElementFieldId {
#define OZ_ELEMENT_FIELDS_ID(kind, name, count, class) OZ_ELEMENT_FIELD_##name,
    OZ_ELEMENT_FIELDS(OZ_ELEMENT_FIELDS_ID)
#undef OZ_ELEMENT_FIELDS_ID
        OZ_ELEMENT_FIELD_COUNT
} OzElementFieldId;

/* For the model's row (sim/model.h): rows, elements of a member's stretch. */
extern const OzField oz_element_fields_rows[];
size_t oz_element_fields_items(int field, const void *switches, const void *sizes);

/* The slot of an element. */
int oz_element_fields_slot(const OzElementSizes *sizes, const OzElements *elements,
                           int64_t element);

/* The arrays' switches and sizes as what they are. */
static inline const OzElementSwitches *oz_element_fields_switches(const OzArrays *arrays)
{
    return arrays->switches;
}

static inline const OzElementSizes *oz_element_fields_sizes(const OzArrays *arrays)
{
    return arrays->sizes;
}
