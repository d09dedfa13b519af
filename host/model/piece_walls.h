/* Walls of trigrains as triangles. */
#ifndef OZ_MODEL_PIECE_WALLS_H
#define OZ_MODEL_PIECE_WALLS_H

#include "model/patch.h"
#include "scene/scene.h"

/* Makes the triangles of one wall at rest, in the world frame. They lie behind the wall's free
 * side, teeth stand on it; where two faces meet in a hollow both go on behind each other, so that
 * no grain finds a gap. A smooth straight face is one edge of one triangle. Walls that say no
 * thickness get that of two grains of size (m), or a twentieth of their own where size is 0. */
OzStatus oz_piece_walls_make(OzPatch *patch, const OzWall *wall, double size);

#endif
