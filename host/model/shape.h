/* Grains' shapes as triangles joined by beams, or as discs. */
#pragma once

#include "base/random.h"
#include "model/triangle_set.h"
#include "scene/scene.h"

#include <stdbool.h>

/* Makes one grain of a population, about its centre of mass; the triangle set's joints are its
 * beams. A square is four triangles about its middle (Poeschel & Buchholtz 1995, Fig. 1). A polygon
 * or a star has a triangle on each edge, all with a corner at its middle. Given vertices are cut
 * into as few triangles as can be. Where these would be less symmetric than the outline, and the
 * middle sees all edges, there is a triangle on each edge instead. A polygon's irregularity q turns
 * each corner by up to 0.4 q of half the angle between corners, and draws it in by up to half q of
 * the radius. What a population leaves open is drawn from random; it is drawn again while a beam is
 * shorter than beams.length_min or a triangle smaller than beams.area_min. Fails with OZ_ERR_INPUT,
 * naming the population's line and the reason, when nothing is left to draw, when no draw of many
 * is within the limits, and for vertices that make no simple polygon. */
OzStatus oz_shape_make(OzTriangleSet *triangle_set, const OzScene *scene,
                       const OzPopulation *population, OzRandom *random);

/* False for given vertices whose outline has a symmetry that its triangles have not. */
bool oz_shape_keeps_symmetry(const OzScene *scene, const OzPopulation *population);
