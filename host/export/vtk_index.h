/* A .pvd file, which names VTK files with their times. It is whole at any moment. */
#pragma once

#include "base/status.h"

#include <stdint.h>
#include <stdio.h>

/* Makes the index in a folder (base/folder.h), without entries; the caller closes it with
 * oz_folder_finish_file. Fails with OZ_ERR_FILE. */
OzStatus oz_vtk_index_create(FILE **index, const char *folder, const char *name);

/* Goes on with one that was left, after its first `whole` bytes, as oz_vtk_index_whole told. */
OzStatus oz_vtk_index_go_on(FILE **index, const char *path, int64_t whole);

/* Bytes of the head and of all entries. */
int64_t oz_vtk_index_whole(FILE *index);

/* A further entry: a file beside the index, and its time in s. */
OzStatus oz_vtk_index_add(FILE *index, double time, const char *name);
