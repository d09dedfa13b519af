/* One of several parts of an ensemble's seeds, which run apart (`orzo run --part K/M`). */
#pragma once

#include "cli.h"

/* Options of a part become those of a run of its seeds alone; others stay as they are. Refuses a
 * part without seeds. */
OzStatus oz_seed_part_take(OzOptions *options);
