/* What a person is told to change after a contact was too deep: the step where it is to blame, else
 * how soft contacts are. */
#pragma once

#include "model/snapshot.h"

/* Writes one clause about the deepest contact of a grain as it is now.
 * Where the step is unstable, for two bodies or for all contacts together, it names the step that
 * would be stable. Where the step is stable the contact is too soft for what pushes it, and the
 * clause names the contact_time (of another law: how many times the stiffness) that would do.
 * "Would do" means that an overlap of guards.overlap.warn then holds two things. The first is the
 * energy that the contact stores now plus that of its approach; the mass of the approach is the
 * effective mass of the two grains, or, where others touch the grain too, the heaviest grain's. The
 * second is the weight of the scene's heaviest grain let go on its lightest. Friction and dashpots
 * are left out. */
void oz_advice_write(char *text, size_t size, const OzSnapshot *now, int64_t grain);
