/* What pictures of flat grains show: chosen once from walls and grains, as for standing ones. */
#pragma once

#include "draw/renderer.h"

/* Makes the look flat and frames the walls wherever they move (a drum: the drum), the grains now,
 * what lies below an outlet, and where grains fly to when nothing pulls them; fills the scale of
 * speed. The snapshot has elements. */
void oz_plane_frame(OzLook *look, const OzScene *scene, const OzSnapshot *snapshot);
