/* A table of rows as CSV: a header of names, then rows of as many cells. */
#pragma once

#include "base/status.h"

/* Writes the table again with these columns: those that it has keep their cells, others are empty
 * in every row so far, and what is not named is left out. A table that has just these columns stays
 * as it is, to the byte. The file must be closed; it is replaced at once. Fails with OZ_ERR_FILE or
 * OZ_ERR_MEMORY, and the table is as it was. */
OzStatus oz_rows_file_reshape(const char *path, const char *const *names, int count);
