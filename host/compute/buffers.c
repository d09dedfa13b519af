/* Making, filling and reading a device's buffers. */
#include "compute/buffers.h"

#include "base/memory.h"
#include "compute/cl_try.h"

OzStatus oz_buffers_make(cl_mem *buffer, const OzDevice *device, const char *name, size_t bytes)
{
    cl_int code = CL_SUCCESS;
    cl_uint zero = 0;
    size_t rounded = (bytes + 63) / 64 * 64;
    *buffer = NULL;
    if (bytes == 0) {
        return OZ_OK;
    }
    if (rounded > device->largest_buffer) {
        return oz_status_fail(OZ_ERR_DEVICE, "%s needs %zu bytes, %s gives at most %llu at once",
                              name, bytes, device->name,
                              (unsigned long long)device->largest_buffer);
    }
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE, rounded, NULL, &code);
    CL_PASS(code);
    CL_PASS(
        clEnqueueFillBuffer(device->queue, *buffer, &zero, sizeof zero, 0, rounded, 0, NULL, NULL));
    return OZ_OK;
}

void oz_buffers_free(const cl_mem *buffers, int count)
{
    for (int i = 0; i < count; i++) {
        CL_RELEASE(MemObject, buffers[i]);
    }
}

OzStatus oz_buffers_write(const OzDevice *device, cl_mem buffer, size_t offset, const void *data,
                          size_t bytes)
{
    if (buffer && bytes > 0) {
        CL_PASS(clEnqueueWriteBuffer(device->queue, buffer, CL_TRUE, offset, bytes, data, 0, NULL,
                                     NULL));
    }
    return OZ_OK;
}

OzStatus oz_buffers_read(const OzDevice *device, cl_mem buffer, size_t offset, void *data,
                         size_t bytes)
{
    if (buffer && bytes > 0) {
        CL_PASS(clEnqueueReadBuffer(device->queue, buffer, CL_TRUE, offset, bytes, data, 0, NULL,
                                    NULL));
    }
    return OZ_OK;
}

static OzStatus size_of(cl_mem buffer, size_t *bytes)
{
    CL_PASS(clGetMemObjectInfo(buffer, CL_MEM_SIZE, sizeof *bytes, bytes, NULL));
    return OZ_OK;
}

OzStatus oz_buffers_save(const OzDevice *device, const cl_mem *buffers, int count, void **copies)
{
    for (int i = 0; i < count; i++) {
        size_t bytes = 0;
        if (!buffers[i]) {
            continue;
        }
        OZ_PASS(size_of(buffers[i], &bytes));
        OZ_PASS(oz_memory_new(&copies[i], bytes, 1, "copy of a buffer"));
        OZ_PASS(oz_buffers_read(device, buffers[i], 0, copies[i], bytes));
    }
    return OZ_OK;
}

OzStatus oz_buffers_restore(const OzDevice *device, const cl_mem *buffers, int count,
                            void *const *copies)
{
    for (int i = 0; i < count; i++) {
        size_t bytes = 0;
        if (!copies[i]) {
            continue;
        }
        OZ_PASS(size_of(buffers[i], &bytes));
        OZ_PASS(oz_buffers_write(device, buffers[i], 0, copies[i], bytes));
    }
    return OZ_OK;
}

OzStatus oz_buffers_bind(const cl_mem *buffers, int count, cl_kernel kernel)
{
    for (int i = 0; i < count; i++) {
        CL_PASS(
            clSetKernelArg(kernel, (cl_uint)i, sizeof(cl_mem), buffers[i] ? &buffers[i] : NULL));
    }
    return OZ_OK;
}
