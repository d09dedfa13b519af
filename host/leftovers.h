/* What an earlier run has left in a folder that is used again. */
#ifndef OZ_LEFTOVERS_H
#define OZ_LEFTOVERS_H

#include "base/status.h"

/* Removes every file that a run writes, final.csv first, so that nothing there belongs to another
 * run. What else lies in the folder stays; a folder that is not there is fine. */
OzStatus oz_leftovers_remove(const char *folder);

#endif
