/* The device's arrays, from the one list in kernels/fields.h: allocation, growth, copies. Arrays hold one
 * stretch for each member of a launch. */
#ifndef OZ_COMPUTE_ARRAYS_H
#define OZ_COMPUTE_ARRAYS_H

#include "compute/constants.h"
#include "compute/device.h"
#include "kernels/fields.h"

typedef enum OzFieldId {
#define OZ_ARRAYS_ID(kind, name, count) OZ_FIELD_##name,
    OZ_FIELDS(OZ_ARRAYS_ID)
#undef OZ_ARRAYS_ID
        OZ_FIELD_COUNT
} OzFieldId;

typedef struct OzArrays {
    const OzDevice *device; /* borrowed */
    OzSwitches switches;
    OzSizes sizes;
    cl_mem buffer[OZ_FIELD_COUNT]; /* NULL: the scene does not need it */
} OzArrays;

/* Bytes of one member's stretch of a field; 0 when it is not needed. */
size_t oz_arrays_bytes(OzFieldId field, const OzSwitches *switches, const OzSizes *sizes);

/* Allocates what the switches need. The caller frees with oz_arrays_free (zeroed is fine). */
OzStatus oz_arrays_create(OzArrays *arrays, const OzDevice *device, const OzSwitches *switches,
                          const OzSizes *sizes);
void oz_arrays_free(OzArrays *arrays);

/* Takes new list capacities: arrays that change size are made anew; the outer and the saved lists keep their
 * contents, row by row. */
OzStatus oz_arrays_resize(OzArrays *arrays, const OzSizes *sizes);

/* Copies a member's stretch from or to the host, waiting for it. A field that is not there is skipped. */
OzStatus oz_arrays_write(OzArrays *arrays, OzFieldId field, int member, const void *data,
                         size_t bytes);
OzStatus oz_arrays_read(const OzArrays *arrays, OzFieldId field, int member, void *data,
                        size_t bytes);

/* Sets the arguments that every kernel begins with; *next receives the index of the first one after. */
OzStatus oz_arrays_bind(const OzArrays *arrays, cl_kernel kernel, cl_uint *next);

/* Prints name and size of each array, and the sum (`orzo check`). */
void oz_arrays_print(const OzSwitches *switches, const OzSizes *sizes, FILE *file);

#endif
