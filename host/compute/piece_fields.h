/* Trigrains' fields on the device, from the one list in kernels/piece_fields.h. */
#ifndef OZ_COMPUTE_PIECE_FIELDS_H
#define OZ_COMPUTE_PIECE_FIELDS_H

#include "compute/arrays.h"
#include "compute/piece_switches.h"
#include "kernels/piece_fields.h"
#include "kernels/piece_layout.h"

typedef enum OzPieceFieldId {
#define OZ_PIECE_FIELDS_ID(kind, name, count, class) OZ_PIECE_FIELD_##name,
    OZ_PIECE_FIELDS(OZ_PIECE_FIELDS_ID)
#undef OZ_PIECE_FIELDS_ID
        OZ_PIECE_FIELD_COUNT
} OzPieceFieldId;

/* For the model's row (compute/model.h): rows, bytes of a member's stretch. */
extern const OzField oz_piece_fields_rows[];
size_t oz_piece_fields_bytes(int field, const void *switches, const void *sizes);

/* The slot of a piece. */
int oz_piece_fields_slot(const OzPieceSizes *sizes, const OzPieces *pieces, int64_t piece);

/* The arrays' switches and sizes as what they are. */
static inline const OzPieceSwitches *oz_piece_fields_switches(const OzArrays *arrays)
{
    return arrays->switches;
}

static inline const OzPieceSizes *oz_piece_fields_sizes(const OzArrays *arrays)
{
    return arrays->sizes;
}

#endif
