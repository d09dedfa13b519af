/* The device's arrays, from a model's list of fields: allocation, growth, copies. Arrays hold one
 * stretch for each member of a launch. */
#pragma once

#include "sim/model.h"

struct OzArrays {
    const OzDevice *device; /* borrowed */
    const OzModel *model;
    void *switches, *sizes; /* the model's own structs, kept here */
    cl_mem *buffer;         /* one a field; NULL: the scene does not need it */
};

/* Allocates what the switches need, zeroed; both structs are copied. The caller frees with
 * oz_arrays_free (zeroed is fine). */
OzStatus oz_arrays_create(OzArrays *arrays, const OzDevice *device, const OzModel *model,
                          const void *switches, const void *sizes);
void oz_arrays_free(OzArrays *arrays);

/* What all models' switches and sizes begin with. */
const OzSwitchesHead *oz_arrays_switches(const OzArrays *arrays);
const OzSizesHead *oz_arrays_sizes(const OzArrays *arrays);

/* Bytes of one member's stretch of a field; 0 when it is not needed. */
size_t oz_arrays_bytes(const OzArrays *arrays, int field);

/* Takes new list capacities: arrays that change size are made anew; lists that the model keeps hold
 * their contents, row by row. */
OzStatus oz_arrays_resize(OzArrays *arrays, const void *sizes);

/* Copies a member's stretch from or to the host, waiting for it. A field that is not there is
 * skipped. */
OzStatus oz_arrays_write(OzArrays *arrays, int field, int member, const void *data, size_t bytes);
OzStatus oz_arrays_read(const OzArrays *arrays, int field, int member, void *data, size_t bytes);

/* A member's whole stretch in new host memory, at *data (the address of any pointer); the caller
 * frees it, after a failure too. */
OzStatus oz_arrays_download(const OzArrays *arrays, int field, int member, void *data);

/* Writes doubles as the device's scalars; reads a whole stretch of scalars as doubles, which the
 * caller frees. */
OzStatus oz_arrays_write_scalars(OzArrays *arrays, int field, int member, const double *data,
                                 size_t count);
OzStatus oz_arrays_read_scalars(const OzArrays *arrays, int field, int member, double **data);

/* Sets the arguments that every kernel begins with; *next receives the index of the first one
 * after. */
OzStatus oz_arrays_bind(const OzArrays *arrays, cl_kernel kernel, cl_uint *next);

/* Prints name and size of each array, and the sum, also for each body of these grains (`orzo
 * check`). */
void oz_arrays_print(const OzModel *model, const void *switches, const void *sizes,
                     const OzGrains *grains, FILE *file);

/* Enlarges the capacities that control asks for, with room to spare. */
void oz_arrays_grow(OzSizesHead *sizes, const OzControlHead *control, int lanes);
