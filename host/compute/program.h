/* Kernel programs: one flat text (includes expanded, with #line for true file names in build logs),
 * built with a scene's switches. */
#pragma once

#include "compute/device.h"

/* Builds `name` (kernels/rods.cl) with options. A failed build gives the driver's log in the
 * failure text. The caller releases the program. */
OzStatus oz_program_build(cl_program *program, const OzDevice *device, const char *source_dir,
                          const char *name, const char *options);

/* The structs that host and kernels share, as the host has them. */
typedef struct OzLayout {
    size_t parameters;     /* numbers                  */
    size_t control, sizes; /* bytes                    */
    int lanes;             /* of a vector              */
    bool is_double;        /* the device's numbers are */
} OzLayout;

/* Fails with OZ_ERR_DEVICE if the program's kernel oz_layout knows them otherwise. */
OzStatus oz_program_check(cl_program program, const OzDevice *device, const OzLayout *layout);
