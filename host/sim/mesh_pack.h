/* The triangles of a scene's meshes for a device: in places of their own, and in lists for the
 * cells of a grid, each of all that a grain whose centre is in the cell may touch. */
#pragma once

#include "sim/rods_fields.h"

/* How many words the arrays have. parameters: in SI. */
OzStatus oz_mesh_pack_sizes(OzSizes *sizes, const OzScene *scene, const OzParameters *parameters);

/* Uploads those of a member. */
OzStatus oz_mesh_pack_write(OzArrays *arrays, int member, const OzScene *scene,
                            const OzParameters *parameters);
