/* Libraries that crash where memory runs out, tried first in a process of their own. */
#pragma once

#include "base/status.h"

/* Where this process has a limit of address space (ulimit -v), calls work in a copy of the process
 * that says nothing and ends with it; elsewhere does nothing, which costs nothing. Fails with
 * OZ_ERR_GRAPHICS if the copy died or had too little left over, and as work does if that failed,
 * with its text. A copy that hangs tells nothing and is no failure. Files that work writes are the
 * caller's to remove. */
OzStatus oz_tryout_run(OzStatus (*work)(void *argument), void *argument);
