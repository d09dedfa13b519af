/* Whether a scene can begin with a member of another run. */
#pragma once

#include "run/from_types.h"

/* Refuses by name a scene and its grains that cannot begin there: other grains, another step, a
 * wall that would jump, or one of trigrains that is another. */
OzStatus oz_from_check_scene(const OzFromMember *from, const OzScene *scene,
                             const OzGrains *grains);
