/* Rods' fields. */
#include "sim/rods_fields.h"

/* The list's switches, on the host. */
#define OZ_LANES          (s->lanes)
#define OZ_ROUND          (s->round)
#define OZ_EQUAL          (s->equal)
#define OZ_HISTORY        (s->history)
#define OZ_ROLLING        (s->rolling)
#define OZ_ROLLING_SPRING (s->rolling_spring)
#define OZ_WALL_COUNT     (s->walls)
#define OZ_WALL_EDGED     (s->edged)
#define OZ_MESHES         (s->meshes)
#define OZ_MATERIALS      (s->materials)
#define OZ_MOVING         (s->moving)
#define OZ_SWUNG          (s->swung)
#define OZ_LEDGER         (s->ledger)
#define OZ_IMPULSES       (s->impulses)
#define OZ_SERVOS         (s->servos)
#define OZ_PUSHED         (s->pushed)
#define OZ_LINE           (s->line)
#define OZ_RESORT         (s->resort)
#define OZ_FINE           (s->fine)
#define OZ_TILES          (s->resort)
#define OZ_PERIODIC       (s->periodic)
#define OZ_SHEAR          (s->shear)
#define OZ_GROUP          (s->group)

size_t oz_rods_fields_items(int field, const void *switches, const void *sizes)
{
    const OzSwitches *s = switches;
    const OzSizes z = *(const OzSizes *)sizes;
    switch (field) {
#define CASE(kind, name, count, class)                                                             \
    case OZ_FIELD_##name:                                                                          \
        return (size_t)(count);
        OZ_FIELDS(CASE)
#undef CASE
    default:
        return 0;
    }
}

const OzField oz_rods_fields_rows[] = {
#define ROW(kind, name, count, class) {#name, OZ_FIELD_##class, OZ_FIELD_KIND_##kind},
    OZ_FIELDS(ROW)
#undef ROW
};
