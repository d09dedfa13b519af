/* Walls of trigrains as triangles. */
#pragma once

#include "model/triangle_set.h"
#include "scene/scene.h"

/* Makes the triangles of one wall at rest, in the world frame. They lie behind the
 * wall's free side; teeth stand on that side. Where two faces meet in a hollow, the triangles of
 * each go on behind the other, so that no grain finds a gap. A smooth straight face is one edge of
 * one triangle. A wall whose scene gives no thickness is as thick as two grains of the given size
 * (m), or, where size is 0, a twentieth of the wall's own size. */
OzStatus oz_element_walls_make(OzTriangleSet *triangle_set, const OzWall *wall, double size);
