/* The kernels and shaders that travel inside the program, or their sources on disk while editing
 * (--source-dir). */
#pragma once

#include "base/status.h"

#include <stddef.h>

typedef struct OzEmbeddedFile {
    const char *name;           /* "kernels/rods.cl", relative to the source folder */
    const unsigned char *bytes; /* followed by a zero byte                          */
    size_t length;
} OzEmbeddedFile;

/* Ends with a row whose name is NULL. Made by the build. */
extern const OzEmbeddedFile oz_embed_files[];

/* *text receives the file, zero-terminated; the caller frees it. source_dir NULL takes the embedded
 * copy, otherwise source_dir/name is read. Fails with OZ_ERR_FILE. */
OzStatus oz_embed_read(char **text, const char *source_dir, const char *name);
