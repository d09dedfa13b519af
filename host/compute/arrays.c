/* Device arrays. */
#include "compute/arrays.h"

#include "base/memory.h"
#include "compute/buffers.h"
#include "compute/cl_try.h"

#include <stdlib.h>
#include <string.h>

/* The list's switches, on the host. */
#define OZ_LANES      (s->lanes)
#define OZ_ROUND      (s->round)
#define OZ_EQUAL      (s->equal)
#define OZ_HISTORY    (s->history)
#define OZ_WALL_COUNT (s->walls)
#define OZ_MOVING     (s->moving)
#define OZ_LEDGER     (s->ledger)
#define OZ_LINE       (s->line)
#define OZ_RESORT     (s->resort)
#define OZ_GROUP      (s->group)

static size_t scalar_bytes(const OzSwitches *s)
{
    return s->is_double ? sizeof(double) : sizeof(float);
}

#define BYTES_parameters (sizeof(OzParameters) / sizeof(double) * scalar_bytes(s))
#define BYTES_control    sizeof(OzControl)
#define BYTES_scalar     scalar_bytes(s)
#define BYTES_real       (scalar_bytes(s) * (size_t)s->lanes)
#define BYTES_spot       scalar_bytes(s)
#define BYTES_integer    sizeof(int)
#define BYTES_ledger     sizeof(double)

size_t oz_arrays_bytes(OzFieldId field, const OzSwitches *s, const OzSizes *sizes)
{
    const OzSizes z = *sizes;
    switch (field) {
#define CASE(kind, name, count)                                                                    \
    case OZ_FIELD_##name:                                                                          \
        return (size_t)(count) * (BYTES_##kind);
        OZ_FIELDS(CASE)
#undef CASE
    default:
        return 0;
    }
}

static const char *field_name(OzFieldId field)
{
    static const char *const names[] = {
#define NAME(kind, name, count) #name,
        OZ_FIELDS(NAME)
#undef NAME
    };
    return names[field];
}

static size_t all_bytes(const OzArrays *arrays, OzFieldId field, const OzSizes *sizes)
{
    return oz_arrays_bytes(field, &arrays->switches, sizes) * (size_t)sizes->members;
}

OzStatus oz_arrays_create(OzArrays *arrays, const OzDevice *device, const OzSwitches *switches,
                          const OzSizes *sizes)
{
    OzStatus status = OZ_OK;
    memset(arrays, 0, sizeof *arrays);
    arrays->device = device;
    arrays->switches = *switches;
    arrays->sizes = *sizes;
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        OzFieldId field = (OzFieldId)f;
        OZ_TRY(oz_buffers_make(&arrays->buffer[f], device, field_name(field),
                               all_bytes(arrays, field, sizes)));
    }
done:
    if (status != OZ_OK) {
        oz_arrays_free(arrays);
    }
    return status;
}

void oz_arrays_free(OzArrays *arrays)
{
    oz_buffers_free(arrays->buffer, OZ_FIELD_COUNT);
    memset(arrays, 0, sizeof *arrays);
}

/* Lists whose contents outlive a growth: where tangential springs are kept during a rebuild. */
static bool keeps_contents(OzFieldId field)
{
    switch (field) {
    case OZ_FIELD_outer_a:
    case OZ_FIELD_outer_b:
    case OZ_FIELD_outer_history:
    case OZ_FIELD_saved_a:
    case OZ_FIELD_saved_b:
    case OZ_FIELD_saved_history:
        return true;
    default:
        return false;
    }
}

/* Copies every region's row from a buffer with shorter or equal rows. */
static OzStatus copy_rows(const OzArrays *arrays, cl_mem from, size_t from_bytes, cl_mem to,
                          size_t to_bytes)
{
    OzStatus status = OZ_OK;
    size_t rows = (size_t)arrays->sizes.regions * (size_t)arrays->sizes.members;
    size_t from_row = from_bytes / rows, to_row = to_bytes / rows;
    size_t region[3] = {from_row < to_row ? from_row : to_row, rows, 1}, origin[3] = {0, 0, 0};
    CL_TRY(clEnqueueCopyBufferRect(arrays->device->queue, from, to, origin, origin, region,
                                   from_row, 0, to_row, 0, 0, NULL, NULL));
done:
    return status;
}

static OzStatus resize_field(OzArrays *arrays, OzFieldId field, const OzSizes *sizes)
{
    OzStatus status = OZ_OK;
    cl_mem grown = NULL;
    size_t old_bytes = all_bytes(arrays, field, &arrays->sizes);
    size_t new_bytes = all_bytes(arrays, field, sizes);
    if (old_bytes == new_bytes) {
        return OZ_OK;
    }
    OZ_TRY(oz_buffers_make(&grown, arrays->device, field_name(field), new_bytes));
    if (keeps_contents(field)) {
        OZ_TRY(copy_rows(arrays, arrays->buffer[field], old_bytes, grown, new_bytes));
    }
    CL_TRY(clReleaseMemObject(arrays->buffer[field]));
    arrays->buffer[field] = grown;
    grown = NULL;
done:
    if (grown) {
        clReleaseMemObject(grown);
    }
    return status;
}

OzStatus oz_arrays_resize(OzArrays *arrays, const OzSizes *sizes)
{
    OzStatus status = OZ_OK;
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        OZ_TRY(resize_field(arrays, (OzFieldId)f, sizes));
    }
    arrays->sizes = *sizes;
done:
    return status;
}

OzStatus oz_arrays_write(OzArrays *arrays, OzFieldId field, int member, const void *data,
                         size_t bytes)
{
    size_t stride = oz_arrays_bytes(field, &arrays->switches, &arrays->sizes);
    return oz_buffers_write(arrays->device, arrays->buffer[field], stride * (size_t)member, data,
                            bytes);
}

OzStatus oz_arrays_read(const OzArrays *arrays, OzFieldId field, int member, void *data,
                        size_t bytes)
{
    size_t stride = oz_arrays_bytes(field, &arrays->switches, &arrays->sizes);
    return oz_buffers_read(arrays->device, arrays->buffer[field], stride * (size_t)member, data,
                           bytes);
}

OzStatus oz_arrays_bind(const OzArrays *arrays, cl_kernel kernel, cl_uint *next)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_buffers_bind(arrays->buffer, OZ_FIELD_COUNT, kernel));
    CL_TRY(clSetKernelArg(kernel, OZ_FIELD_COUNT, sizeof(OzSizes), &arrays->sizes));
    *next = OZ_FIELD_COUNT + 1;
done:
    return status;
}

void oz_arrays_print(const OzSwitches *switches, const OzSizes *sizes, FILE *file)
{
    size_t sum = 0;
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        size_t bytes = oz_arrays_bytes((OzFieldId)f, switches, sizes);
        sum += bytes;
        fprintf(file, bytes ? "  %-18s %12zu bytes\n" : "  %-18s            - not needed\n",
                field_name((OzFieldId)f), bytes);
    }
    fprintf(file, "  %-18s %12zu bytes at start, %.0f a grain\n", "all", sum,
            sizes->count ? (double)sum / sizes->count : 0.0);
}
