/* Files of triangles: STL, binary or text, and OBJ. Knows nothing of walls. */
#pragma once

#include "base/status.h"

#include <stddef.h>

/* Zeroed is empty. The caller frees corners. */
typedef struct OzMeshFile {
    double *corners; /* nine numbers a triangle, in the file's unit; its front is where they go
                        counter-clockwise                                                        */
    int count, capacity;
} OzMeshFile;

/* A triangle's number and what of a grain touches it are one float. */
enum { OZ_MESH_FACES_MAX = 4000000 };

/* Reads a file of that name (`.obj`: OBJ, else STL), which is in bytes already. Normals that an STL
 * tells are not looked at: the order of corners says them. Triangles without area are left out.
 * Fails with OZ_ERR_INPUT, `path:line: what is wrong; what was expected`. */
OzStatus oz_mesh_file_read(OzMeshFile *mesh, const char *path, const char *bytes, size_t length);
