/* Trigrains' fields. */
#include "compute/piece_fields.h"

#include "compute/scalars.h"

/* The list's switches, on the host. */
#undef OZ_LANES
#undef OZ_MOVING
#undef OZ_LEDGER
#define OZ_LANES    (s->lanes)
#define OZ_GROUP    (s->group)
#define OZ_ORDER    (s->order)
#define OZ_MOVING   (s->moving)
#define OZ_DISCS    (s->discs)
#define OZ_SUBSTEPS (s->substeps)
#define OZ_LEDGER   (s->ledger)

#define BYTES_parameters                                                                           \
    (sizeof(OzPieceParameters) / sizeof(double) * oz_scalars_bytes(s->is_double))
#define BYTES_control sizeof(OzPieceControl)
#define BYTES_scalar  oz_scalars_bytes(s->is_double)
#define BYTES_real    (oz_scalars_bytes(s->is_double) * (size_t)s->lanes)
#define BYTES_integer sizeof(int)
#define BYTES_ledger  sizeof(double)

size_t oz_piece_fields_bytes(int field, const void *switches, const void *sizes)
{
    const OzPieceSwitches *s = switches;
    const OzPieceSizes z = *(const OzPieceSizes *)sizes;
    switch (field) {
#define CASE(kind, name, count, class)                                                             \
    case OZ_PIECE_FIELD_##name:                                                                    \
        return (size_t)(count) * (BYTES_##kind);
        OZ_PIECE_FIELDS(CASE)
#undef CASE
    default:
        return 0;
    }
}

const OzField oz_piece_fields_rows[] = {
#define ROW(kind, name, count, class) {#name, OZ_FIELD_##class},
    OZ_PIECE_FIELDS(ROW)
#undef ROW
};

int oz_piece_fields_slot(const OzPieceSizes *sizes, const OzPieces *pieces, int64_t piece)
{
    int64_t free = pieces->free_count;
    return (int)(piece < free ? piece : piece - free + sizes->free_slots);
}
