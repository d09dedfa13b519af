/* Kernel programs: one flat text (includes expanded, with #line for true file names in build logs), built
 * with a scene's switches. */
#ifndef OZ_COMPUTE_PROGRAM_H
#define OZ_COMPUTE_PROGRAM_H

#include "compute/device.h"

/* *text receives the file with every `#include "kernels/..."` replaced by that file's text the first time
 * it is met; the caller frees it. */
OzStatus oz_program_flatten(char **text, const char *source_dir, const char *name);

/* Builds `name` (kernels/rods.cl) with options. A failed build gives the driver's log in the failure text.
 * The caller releases the program. */
OzStatus oz_program_build(cl_program *program, const OzDevice *device, const char *source_dir,
                          const char *name, const char *options);

#endif
