/* Trigrains' fields. */
#include "sim/element_fields.h"

/* The list's switches, on the host. */
#undef OZ_LANES
#undef OZ_MOVING
#undef OZ_LEDGER
#undef OZ_IMPULSES
#define OZ_LANES          (s->lanes)
#define OZ_GROUP          (s->group)
#define OZ_RESORT         (s->resort)
#define OZ_TILES          0
#define OZ_ORDER          (s->order)
#define OZ_MOVING         (s->moving)
#define OZ_DISCS          (s->discs)
#define OZ_TRIANGLE_FIELD (s->triangle_field)
#define OZ_STRENGTH       (s->strength)
#define OZ_SUBSTEPS       (s->substeps)
#define OZ_LEDGER         (s->ledger)
#define OZ_IMPULSES       (s->impulses)

size_t oz_element_fields_items(int field, const void *switches, const void *sizes)
{
    const OzElementSwitches *s = switches;
    const OzElementSizes z = *(const OzElementSizes *)sizes;
    switch (field) {
#define CASE(kind, name, count, class)                                                             \
    case OZ_ELEMENT_FIELD_##name:                                                                  \
        return (size_t)(count);
        OZ_ELEMENT_FIELDS(CASE)
#undef CASE
    default:
        return 0;
    }
}

const OzField oz_element_fields_rows[] = {
#define ROW(kind, name, count, class) {#name, OZ_FIELD_##class, OZ_FIELD_KIND_##kind},
    OZ_ELEMENT_FIELDS(ROW)
#undef ROW
};

int oz_element_fields_slot(const OzElementSizes *sizes, const OzElements *elements, int64_t element)
{
    int64_t free = elements->free_count;
    return (int)(element < free ? element : element - free + sizes->free_slots);
}
