/* What a run began from stays in its folder: a copy of the states below from/, and from.txt, whose
 * first line is what was asked for and whose second says where the copy is, as --from takes it,
 * seen from the folder. A member's folder in an ensemble's has a from.txt of its own. */
#pragma once

#include "run/from_types.h"

/* Puts the copy and from.txt into a run's folder; without a state it does nothing. */
OzStatus oz_from_keep_copy(const OzFrom *from, const char *folder);

/* Says in the folder of an ensemble's member what it begins with. */
OzStatus oz_from_keep_note(const OzFrom *from, const OzFromMember *begun, const char *folder);

/* *asked receives what oz_from_open takes to begin as the run in the folder did, or NULL where its
 * grains were placed. Refuses a from.txt that names no copy. The caller frees. */
OzStatus oz_from_keep_find(char **asked, const char *folder);
