/* The device's arrays of trigrains, from the one list in kernels/piece_fields.h: allocation,
 * growth, copies. Arrays hold one stretch for each member of a launch. */
#ifndef OZ_COMPUTE_PIECE_ARRAYS_H
#define OZ_COMPUTE_PIECE_ARRAYS_H

#define OZ_HOST
#include "compute/piece_switches.h"
#include "kernels/piece_fields.h"
#include "kernels/piece_layout.h"

typedef enum OzPieceFieldId {
#define OZ_PIECE_ARRAYS_ID(kind, name, count) OZ_PIECE_FIELD_##name,
    OZ_PIECE_FIELDS(OZ_PIECE_ARRAYS_ID)
#undef OZ_PIECE_ARRAYS_ID
        OZ_PIECE_FIELD_COUNT
} OzPieceFieldId;

typedef struct OzPieceArrays {
    const OzDevice *device; /* borrowed */
    OzPieceSwitches switches;
    OzPieceSizes sizes;
    cl_mem buffer[OZ_PIECE_FIELD_COUNT]; /* NULL: the scene does not need it */
} OzPieceArrays;

/* Bytes of one member's stretch of a field; 0 when it is not needed. */
size_t oz_piece_arrays_bytes(OzPieceFieldId field, const OzPieceSwitches *switches,
                             const OzPieceSizes *sizes);

/* Allocates what the switches need, zeroed. The caller frees with oz_piece_arrays_free (zeroed is
 * fine). */
OzStatus oz_piece_arrays_create(OzPieceArrays *arrays, const OzDevice *device,
                                const OzPieceSwitches *switches, const OzPieceSizes *sizes);
void oz_piece_arrays_free(OzPieceArrays *arrays);

/* Takes new list capacities: arrays that change size are made anew, without their contents. */
OzStatus oz_piece_arrays_resize(OzPieceArrays *arrays, const OzPieceSizes *sizes);

/* Copies a member's stretch from or to the host, waiting for it. A field that is not there is
 * skipped. */
OzStatus oz_piece_arrays_write(OzPieceArrays *arrays, OzPieceFieldId field, int member,
                               const void *data, size_t bytes);
OzStatus oz_piece_arrays_read(const OzPieceArrays *arrays, OzPieceFieldId field, int member,
                              void *data, size_t bytes);

/* Writes doubles as the device's scalars. */
OzStatus oz_piece_arrays_write_scalars(OzPieceArrays *arrays, OzPieceFieldId field, int member,
                                       const double *data, size_t count);

/* Reads a whole stretch of scalars as doubles; the caller frees *data. */
OzStatus oz_piece_arrays_read_scalars(const OzPieceArrays *arrays, OzPieceFieldId field, int member,
                                      double **data);

/* Sets the arguments that every kernel begins with; *next receives the index of the first one
 * after. */
OzStatus oz_piece_arrays_bind(const OzPieceArrays *arrays, cl_kernel kernel, cl_uint *next);

/* The slot of a piece. */
int oz_piece_arrays_slot(const OzPieceSizes *sizes, const OzPieces *pieces, int64_t piece);

/* Prints name and size of each array, and the sum (`orzo check`). */
void oz_piece_arrays_print(const OzPieceSwitches *switches, const OzPieceSizes *sizes,
                           int64_t pieces, FILE *file);

#endif
