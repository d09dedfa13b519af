/* What is found of the touches of one grain with one mesh (sim/host_mesh.h). */
#pragma once

#include "sim/physics.h"

/* What a slot of a mesh holds of one grain; places in half shafts, lengths in m. */
typedef struct OzHostTouch {
    bool present; /* else it is empty                       */
    double place, normal[3], distance;
    double push; /* the part of the response that is its own */
} OzHostTouch;

typedef struct OzHostMesh {
    OzHostTouch at[OZ_MESH_SLOTS];
    int spring_to[OZ_MESH_SLOTS]; /* where what a slot's spring held goes on; -1: nowhere */
} OzHostMesh;
