/* The reference's energy ledger: each step's work of contacts. For .c files alone. */
#pragma once

#include "sim/reference_private.h"

/* Adds that of the step that was just made. */
void oz_reference_ledger_note(OzReference *r, double dt);
