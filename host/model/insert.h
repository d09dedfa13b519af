/* The start: grains from a scene's populations. */
#pragma once

#include "model/grains.h"

/* Fills grains (the caller frees with oz_grains_free) with every population in scene order; the
 * same scene and seed give the same grains, and grain i of a population draws the same diameter,
 * aspect and first direction whatever else the scene holds.
 *
 * `single`, `lattice` and `file` grains lie where they are told, overlapping or not. All `random`
 * grains are then placed among them, the longest first, without overlap and inside all walls, with
 * directions uniform on the sphere among those that fit into the container. They share one column
 * above the floor of the container, of the volume that holds each population at its `fill`; without
 * a cylinder the box of the planes around it, or a cube about the origin, serves. Where no wall
 * bounds it the column grows, with a line in the log, until the grains fit.
 *
 * For trigrains see oz_insert_flat_grains.
 *
 * Fails with OZ_ERR_INPUT, naming the population's line, when the walls leave no room (in bounded
 * time: after some hundred tries for each grain), when the scene has more than 2^31 - 1 grains, and
 * when a file population cannot be read. */
OzStatus oz_insert_grains(OzGrains *grains, const OzScene *scene);
