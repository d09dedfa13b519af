/* The start of trigrains: grains and walls as elements, from a scene's populations. */
#pragma once

#include "base/stage.h"
#include "model/grains.h"

/* Fills grains and grains->elements (the caller frees with oz_grains_free) with every population in
 * scene order, then the walls; the same scene and seed give the same grains, and grain i of a
 * population draws the same shape and angle whatever else the scene holds.
 *
 * `single` and `lattice` grains lie where they are told, overlapping or not. All `random` grains
 * are then placed among them, the largest first, so that circles around them neither meet nor touch
 * a wall, inside the first hopper or drum of the scene, else the first vessel, else on the first
 * floor or on the segments. They begin in a column of which those circles cover `fill`, which
 * grows, with a line in the log, until all fit; a drum does not grow.
 *
 * A grain's inertia (both of them) is that about z, its quaternion its turn about z. Fails with
 * OZ_ERR_INPUT, naming the population's line, for shapes that cannot be made or that are beyond the
 * limits of `beams`, and when there is no room. Says through the stage how far it is. */
OzStatus oz_insert_flat_grains(OzGrains *grains, const OzScene *scene, OzStage *stage);
