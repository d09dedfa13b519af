/* What a person is told to change after a contact was too deep: the step where it is to blame, else
 * how soft contacts are. */
#ifndef OZ_COMPUTE_ADVICE_H
#define OZ_COMPUTE_ADVICE_H

#include "observe/snapshot.h"

/* Writes one clause about the deepest contact of a grain as it is now. An unstable step is named
 * with the step that is stable, for two bodies or for the contacts together. With a stable step the
 * contact is too soft for what pushes it: the contact_time that is given (another law: so many
 * times the stiffness) would hold, at an overlap of guards.overlap.warn, the energy that the
 * contact holds and that of its approach, of the effective mass of two grains or, where others
 * touch the grain too, of the heaviest of them; and the weight of the scene's heaviest grain let go
 * on its lightest. Friction and dashpots are left out.
 */
void oz_advice_write(char *text, size_t size, const OzSnapshot *now, int64_t grain);

#endif
