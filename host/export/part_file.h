/* Files that appear in an export's folder whole or not at all: they are written beside, under a
 * name that is used again and again, and take their place at once. */
#pragma once

#include "base/status.h"

#include <stdio.h>

/* Opens `part` in the folder, empty. Fails with OZ_ERR_FILE. */
OzStatus oz_part_file_create(FILE **file, const char *folder, const char *part);

/* Closes it, and it is `name` from then on; NULL is fine. Fails with OZ_ERR_FILE, naming it. */
OzStatus oz_part_file_place(FILE *file, const char *folder, const char *part, const char *name);
