/* The rows of the list of scene keys (keys.h), as they stand: what to edit for a new key. */
#pragma once

#include "scene/key.h"

/* Ends with a row whose path is NULL. Rows of one group are neighbours, and so are the rows of one
 * path, each for models of its own. */
const OzKey *oz_rows_all(void);
