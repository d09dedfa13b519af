/* Touches of meshes on the host, by the same physics as on a device (kernels/mesh.h). Callers have
 * set the host's switches. */
#pragma once

#include "sim/host_touch.h"
#include "sim/physics.h"

/* What kernel wall w, a mesh, does to a grain whose centre is at `from`, seen from the wall's point
 * where that is now. memory: OZ_MESH_MEMORY words a slot, of the last time and then of this one.
 * False where there are more touches than slots; those that found none are left out. */
bool oz_host_mesh_find(OzHostMesh *found, const OzPhysics *physics, int w, OzVec3 from,
                       OzVec3 half_shaft, double radius, double *memory);

/* What a mesh's slots remember, where it goes on. */
void oz_host_mesh_hand_over(const OzHostMesh *found, OzMemory memories[OZ_MESH_SLOTS]);

/* Where the memory of a grain's slots at a mesh begins, in an array of all grains. */
double *oz_host_mesh_memory(const OzPhysics *physics, double *memory, int64_t grain, int mesh);
