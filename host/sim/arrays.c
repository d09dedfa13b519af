/* Device arrays. It knows no field by name. */
#include "sim/arrays.h"

#include "base/memory.h"
#include "compute/buffers.h"
#include "compute/cl_try.h"
#include "sim/scalars.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t all_bytes(const OzArrays *arrays, int field, const void *sizes)
{
    const OzSizesHead *head = sizes;
    return oz_model_field_bytes(arrays->model, field, arrays->switches, sizes) *
           (size_t)head->members;
}

const OzSwitchesHead *oz_arrays_switches(const OzArrays *arrays)
{
    return arrays->switches;
}

const OzSizesHead *oz_arrays_sizes(const OzArrays *arrays)
{
    return arrays->sizes;
}

size_t oz_arrays_bytes(const OzArrays *arrays, int field)
{
    return oz_model_field_bytes(arrays->model, field, arrays->switches, arrays->sizes);
}

OzStatus oz_arrays_create(OzArrays *arrays, const OzDevice *device, const OzModel *model,
                          const void *switches, const void *sizes)
{
    OzStatus status = OZ_OK;
    *arrays = (OzArrays){.device = device, .model = model};
    OZ_TRY(oz_memory_new(&arrays->switches, model->switches_bytes, 1, "switches"));
    OZ_TRY(oz_memory_new(&arrays->sizes, model->sizes_bytes, 1, "sizes"));
    OZ_TRY(OZ_NEW(&arrays->buffer, model->field_count));
    memcpy(arrays->switches, switches, model->switches_bytes);
    memcpy(arrays->sizes, sizes, model->sizes_bytes);
    for (int f = 0; f < model->field_count; f++) {
        OZ_TRY(oz_buffers_make(&arrays->buffer[f], device, model->fields[f].name,
                               all_bytes(arrays, f, sizes)));
    }
done:
    if (status != OZ_OK) {
        oz_arrays_free(arrays);
    }
    return status;
}

void oz_arrays_free(OzArrays *arrays)
{
    if (arrays->buffer) {
        oz_buffers_free(arrays->buffer, arrays->model->field_count);
    }
    free(arrays->switches);
    free(arrays->sizes);
    free(arrays->buffer);
    *arrays = (OzArrays){0};
}

/* Copies every region's row from a buffer with shorter or equal rows. */
static OzStatus copy_rows(const OzArrays *arrays, cl_mem from, size_t from_bytes, cl_mem to,
                          size_t to_bytes)
{
    const OzSizesHead *sizes = arrays->sizes;
    size_t rows = (size_t)sizes->regions * (size_t)sizes->members;
    size_t from_row = from_bytes / rows, to_row = to_bytes / rows;
    size_t region[3] = {from_row < to_row ? from_row : to_row, rows, 1}, origin[3] = {0, 0, 0};
    CL_PASS(clEnqueueCopyBufferRect(arrays->device->queue, from, to, origin, origin, region,
                                    from_row, 0, to_row, 0, 0, NULL, NULL));
    return OZ_OK;
}

static OzStatus resize_field(OzArrays *arrays, int field, const void *sizes)
{
    OzStatus status = OZ_OK;
    const OzModel *model = arrays->model;
    OzFieldClass class = model->fields[field].class;
    cl_mem grown = NULL;
    size_t old_bytes = all_bytes(arrays, field, arrays->sizes);
    size_t new_bytes = all_bytes(arrays, field, sizes);
    if (old_bytes == new_bytes) {
        return OZ_OK;
    }
    OZ_TRY(oz_buffers_make(&grown, arrays->device, model->fields[field].name, new_bytes));
    if (class == OZ_FIELD_ROWS || class == OZ_FIELD_SPRING) {
        OZ_TRY(copy_rows(arrays, arrays->buffer[field], old_bytes, grown, new_bytes));
    }
    CL_TRY(clReleaseMemObject(arrays->buffer[field]));
    arrays->buffer[field] = grown;
    grown = NULL;
done:
    CL_RELEASE(MemObject, grown);
    return status;
}

OzStatus oz_arrays_resize(OzArrays *arrays, const void *sizes)
{
    for (int f = 0; f < arrays->model->field_count; f++) {
        OZ_PASS(resize_field(arrays, f, sizes));
    }
    memcpy(arrays->sizes, sizes, arrays->model->sizes_bytes);
    return OZ_OK;
}

OzStatus oz_arrays_write(OzArrays *arrays, int field, int member, const void *data, size_t bytes)
{
    size_t stride = oz_arrays_bytes(arrays, field);
    return oz_buffers_write(arrays->device, arrays->buffer[field], stride * (size_t)member, data,
                            bytes);
}

OzStatus oz_arrays_read(const OzArrays *arrays, int field, int member, void *data, size_t bytes)
{
    size_t stride = oz_arrays_bytes(arrays, field);
    return oz_buffers_read(arrays->device, arrays->buffer[field], stride * (size_t)member, data,
                           bytes);
}

OzStatus oz_arrays_download(const OzArrays *arrays, int field, int member, void *data)
{
    size_t bytes = oz_arrays_bytes(arrays, field);
    OzStatus status = oz_memory_new(data, bytes, 1, arrays->model->fields[field].name);
    return status == OZ_OK ? oz_arrays_read(arrays, field, member, *(void **)data, bytes) : status;
}

OzStatus oz_arrays_write_scalars(OzArrays *arrays, int field, int member, const double *data,
                                 size_t count)
{
    OzStatus status = OZ_OK;
    bool is_double = oz_arrays_switches(arrays)->is_double;
    void *words = NULL;
    OZ_TRY(oz_memory_new(&words, count, sizeof(double), "upload"));
    oz_scalars_put(words, data, count, is_double);
    OZ_TRY(oz_arrays_write(arrays, field, member, words, count * oz_scalars_bytes(is_double)));
done:
    free(words);
    return status;
}

OzStatus oz_arrays_read_scalars(const OzArrays *arrays, int field, int member, double **data)
{
    OzStatus status = OZ_OK;
    bool is_double = oz_arrays_switches(arrays)->is_double;
    size_t count = oz_arrays_bytes(arrays, field) / oz_scalars_bytes(is_double);
    void *words = NULL;
    *data = NULL;
    OZ_TRY(oz_arrays_download(arrays, field, member, &words));
    OZ_TRY(OZ_NEW(data, count));
    for (size_t k = 0; k < count; k++) {
        (*data)[k] = oz_scalars_get(words, k, is_double);
    }
done:
    free(words);
    return status;
}

OzStatus oz_arrays_bind(const OzArrays *arrays, cl_kernel kernel, cl_uint *next)
{
    cl_uint count = (cl_uint)arrays->model->field_count;
    OZ_PASS(oz_buffers_bind(arrays->buffer, (int)count, kernel));
    CL_PASS(clSetKernelArg(kernel, count, arrays->model->sizes_bytes, arrays->sizes));
    *next = count + 1;
    return OZ_OK;
}

void oz_arrays_print(const OzModel *model, const void *switches, const void *sizes,
                     const OzGrains *grains, FILE *file)
{
    size_t sum = 0;
    int64_t bodies = model->body_count(grains);
    for (int f = 0; f < model->field_count; f++) {
        size_t bytes = oz_model_field_bytes(model, f, switches, sizes);
        sum += bytes;
        fprintf(file, bytes ? "  %-18s %12zu bytes\n" : "  %-18s            - not needed\n",
                model->fields[f].name, bytes);
    }
    fprintf(file, "  %-18s %12zu bytes at start, %.0f a %s\n", "all", sum,
            bodies ? (double)sum / (double)bodies : 0.0, model->body);
}

static int larger_capacity(int now, int needed, int lanes)
{
    return needed > now ? (int)(ceil((1.25 * needed + lanes) / lanes) * lanes) : now;
}

void oz_arrays_grow(OzSizesHead *sizes, const OzControlHead *control, int lanes)
{
    sizes->outer_capacity = larger_capacity(sizes->outer_capacity, control->outer_needed, lanes);
    sizes->inner_capacity = larger_capacity(sizes->inner_capacity, control->inner_needed, lanes);
    sizes->back_capacity = larger_capacity(sizes->back_capacity, control->back_needed, 1);
    sizes->face_capacity = larger_capacity(sizes->face_capacity, control->faces_needed, 1);
}
