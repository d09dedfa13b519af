/* Device arrays of trigrains. */
#include "compute/piece_arrays.h"

#include "base/memory.h"
#include "compute/buffers.h"
#include "compute/cl_try.h"
#include "compute/pack.h"

#include <stdlib.h>
#include <string.h>

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

static size_t scalar_bytes(const OzPieceSwitches *s)
{
    return s->is_double ? sizeof(double) : sizeof(float);
}

#define BYTES_parameters (sizeof(OzPieceParameters) / sizeof(double) * scalar_bytes(s))
#define BYTES_control    sizeof(OzPieceControl)
#define BYTES_scalar     scalar_bytes(s)
#define BYTES_real       (scalar_bytes(s) * (size_t)s->lanes)
#define BYTES_integer    sizeof(int)
#define BYTES_ledger     sizeof(double)

size_t oz_piece_arrays_bytes(OzPieceFieldId field, const OzPieceSwitches *s,
                             const OzPieceSizes *sizes)
{
    const OzPieceSizes z = *sizes;
    switch (field) {
#define CASE(kind, name, count)                                                                    \
    case OZ_PIECE_FIELD_##name:                                                                    \
        return (size_t)(count) * (BYTES_##kind);
        OZ_PIECE_FIELDS(CASE)
#undef CASE
    default:
        return 0;
    }
}

static const char *field_name(OzPieceFieldId field)
{
    static const char *const names[] = {
#define NAME(kind, name, count) #name,
        OZ_PIECE_FIELDS(NAME)
#undef NAME
    };
    return names[field];
}

static size_t all_bytes(const OzPieceArrays *arrays, OzPieceFieldId field,
                        const OzPieceSizes *sizes)
{
    return oz_piece_arrays_bytes(field, &arrays->switches, sizes) * (size_t)sizes->members;
}

OzStatus oz_piece_arrays_create(OzPieceArrays *arrays, const OzDevice *device,
                                const OzPieceSwitches *switches, const OzPieceSizes *sizes)
{
    OzStatus status = OZ_OK;
    memset(arrays, 0, sizeof *arrays);
    arrays->device = device;
    arrays->switches = *switches;
    arrays->sizes = *sizes;
    for (int f = 0; f < OZ_PIECE_FIELD_COUNT; f++) {
        OzPieceFieldId field = (OzPieceFieldId)f;
        OZ_TRY(oz_buffers_make(&arrays->buffer[f], device, field_name(field),
                               all_bytes(arrays, field, sizes)));
    }
done:
    if (status != OZ_OK) {
        oz_piece_arrays_free(arrays);
    }
    return status;
}

void oz_piece_arrays_free(OzPieceArrays *arrays)
{
    oz_buffers_free(arrays->buffer, OZ_PIECE_FIELD_COUNT);
    memset(arrays, 0, sizeof *arrays);
}

OzStatus oz_piece_arrays_resize(OzPieceArrays *arrays, const OzPieceSizes *sizes)
{
    OzStatus status = OZ_OK;
    for (int f = 0; f < OZ_PIECE_FIELD_COUNT; f++) {
        OzPieceFieldId field = (OzPieceFieldId)f;
        size_t bytes = all_bytes(arrays, field, sizes);
        if (bytes != all_bytes(arrays, field, &arrays->sizes)) {
            CL_TRY(clReleaseMemObject(arrays->buffer[f]));
            arrays->buffer[f] = NULL;
            OZ_TRY(oz_buffers_make(&arrays->buffer[f], arrays->device, field_name(field), bytes));
        }
    }
    arrays->sizes = *sizes;
done:
    return status;
}

OzStatus oz_piece_arrays_write(OzPieceArrays *arrays, OzPieceFieldId field, int member,
                               const void *data, size_t bytes)
{
    size_t stride = oz_piece_arrays_bytes(field, &arrays->switches, &arrays->sizes);
    return oz_buffers_write(arrays->device, arrays->buffer[field], stride * (size_t)member, data,
                            bytes);
}

OzStatus oz_piece_arrays_read(const OzPieceArrays *arrays, OzPieceFieldId field, int member,
                              void *data, size_t bytes)
{
    size_t stride = oz_piece_arrays_bytes(field, &arrays->switches, &arrays->sizes);
    return oz_buffers_read(arrays->device, arrays->buffer[field], stride * (size_t)member, data,
                           bytes);
}

OzStatus oz_piece_arrays_write_scalars(OzPieceArrays *arrays, OzPieceFieldId field, int member,
                                       const double *data, size_t count)
{
    OzStatus status = OZ_OK;
    void *words = NULL;
    OZ_TRY(oz_memory_new(&words, count, sizeof(double), "upload"));
    oz_pack_scalars(words, data, count, arrays->switches.is_double);
    OZ_TRY(oz_piece_arrays_write(arrays, field, member, words,
                                 count * scalar_bytes(&arrays->switches)));
done:
    free(words);
    return status;
}

OzStatus oz_piece_arrays_read_scalars(const OzPieceArrays *arrays, OzPieceFieldId field, int member,
                                      double **data)
{
    OzStatus status = OZ_OK;
    const OzPieceSwitches *s = &arrays->switches;
    size_t bytes = oz_piece_arrays_bytes(field, s, &arrays->sizes);
    size_t count = bytes / scalar_bytes(s);
    void *words = NULL;
    *data = NULL;
    OZ_TRY(oz_memory_new(&words, bytes, 1, "download"));
    OZ_TRY(OZ_NEW(data, count));
    OZ_TRY(oz_piece_arrays_read(arrays, field, member, words, bytes));
    for (size_t k = 0; k < count; k++) {
        (*data)[k] = oz_pack_scalar(words, k, s->is_double);
    }
done:
    free(words);
    return status;
}

OzStatus oz_piece_arrays_bind(const OzPieceArrays *arrays, cl_kernel kernel, cl_uint *next)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_buffers_bind(arrays->buffer, OZ_PIECE_FIELD_COUNT, kernel));
    CL_TRY(clSetKernelArg(kernel, OZ_PIECE_FIELD_COUNT, sizeof(OzPieceSizes), &arrays->sizes));
    *next = OZ_PIECE_FIELD_COUNT + 1;
done:
    return status;
}

int oz_piece_arrays_slot(const OzPieceSizes *sizes, const OzPieces *pieces, int64_t piece)
{
    int64_t free = pieces->free_count;
    return (int)(piece < free ? piece : piece - free + sizes->free_slots);
}

void oz_piece_arrays_print(const OzPieceSwitches *switches, const OzPieceSizes *sizes,
                           int64_t pieces, FILE *file)
{
    size_t sum = 0;
    for (int f = 0; f < OZ_PIECE_FIELD_COUNT; f++) {
        size_t bytes = oz_piece_arrays_bytes((OzPieceFieldId)f, switches, sizes);
        sum += bytes;
        fprintf(file, bytes ? "  %-18s %12zu bytes\n" : "  %-18s            - not needed\n",
                field_name((OzPieceFieldId)f), bytes);
    }
    fprintf(file, "  %-18s %12zu bytes at start, %.0f a piece\n", "all", sum,
            pieces ? (double)sum / (double)pieces : 0.0);
}
