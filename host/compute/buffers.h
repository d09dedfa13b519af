/* Buffers of a device, each with a stride a member: what the arrays of both models are made of. A
 * buffer of no bytes is NULL; kernels are given none, and nothing is written to it. */
#pragma once

#include "compute/device.h"

/* A zeroed buffer; name is for the message when the device gives none so large. The caller frees it
 * with oz_buffers_free. */
OzStatus oz_buffers_make(cl_mem *buffer, const OzDevice *device, const char *name, size_t bytes);

/* Frees those that are not NULL. */
void oz_buffers_free(const cl_mem *buffers, int count);

/* Copies bytes from or to an offset of a buffer, and waits. */
OzStatus oz_buffers_write(const OzDevice *device, cl_mem buffer, size_t offset, const void *data,
                          size_t bytes);
OzStatus oz_buffers_read(const OzDevice *device, cl_mem buffer, size_t offset, void *data,
                         size_t bytes);

/* Copies every buffer into host memory, copies[i] of buffers[i], NULL of NULL; the caller frees
 * each, after a failure too. copies must be zeroed. */
OzStatus oz_buffers_save(const OzDevice *device, const cl_mem *buffers, int count, void **copies);

/* Puts back what oz_buffers_save has copied; a NULL copy leaves its buffer as it is. */
OzStatus oz_buffers_restore(const OzDevice *device, const cl_mem *buffers, int count,
                            void *const *copies);

/* Makes the buffers a kernel's first arguments. */
OzStatus oz_buffers_bind(const cl_mem *buffers, int count, cl_kernel kernel);
