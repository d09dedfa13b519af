/* The guards of the reference, with the bounds of the kernels'. */
#pragma once

#include "sim/reference_private.h"

/* Whether contacts and bodies are sound after a step of dt (s), deep contacts being counted; else
 * OZ_ERR_BLOWUP, with grain, step and time. */
OzStatus oz_reference_guard_check(OzReference *reference, double dt);
