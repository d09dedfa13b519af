/* The contacts of rods and spheres at one moment, found by the same physics that moves the grains.
 * The caller knows which pairs and ends at walls may touch and what tangential springs they carry;
 * those that turn out not to touch add nothing. Serves the device simulation and the host reference
 * alike. */
#pragma once

#include "model/snapshot.h"
#include "sim/host_mesh.h"
#include "sim/physics.h"

#include "kernels/wall_drive.h"

typedef struct OzContacts {
    OzPhysics physics; /* its walls are in the order in which `wall` counts below, its
                          share is that of forces at this moment                         */
    OzWallDrive drives[OZ_WALLS_MAX]; /* how each of them moves now                           */
    double tilt, rate;          /* of a sheared cell now                                          */
    double share;               /* of a step by which the integrator advances springs             */
    const OzSnapshot *snapshot; /* borrowed: position, axis, velocity, spin, walls                */
    OzContactList *list;        /* borrowed: receives what touches                                */
    const double *memory; /* borrowed: what the slots of the grain's meshes remember, mesh by mesh;
                             NULL: nothing                                                       */
    OzHostMesh found;     /* what kernel wall found_wall, a mesh, does to grain found_grain      */
    int64_t found_grain;
    int found_wall;
} OzContacts;

/* For a snapshot whose state, axes and walls are filled in; the list goes on as it is. Nothing to
 * free. Fails with OZ_ERR_INPUT as oz_constants_fill does. */
OzStatus oz_contacts_begin(OzContacts *contacts, const OzSnapshot *snapshot, OzContactList *list);

/* Grains a and b (ids; a is the one whose reach is larger, or the lower id). memory is what the
 * pair keeps between steps. NULL: none. Fails when memory does. */
OzStatus oz_contacts_pair(OzContacts *contacts, int64_t a, int64_t b, const OzMemory *memory);

/* An end of a grain at a wall, a point of its shaft or a slot of a mesh, one of physics.touches. */
OzStatus oz_contacts_wall(OzContacts *contacts, int64_t grain, int index, const OzMemory *memory);
