/* What the physics headers need to know of a scene before the host can use them: switches,
 * constants in double, walls in kernel order. Shared by the reference simulation and
 * sim/contacts.h.
 */
#pragma once

#include "scene/wall_mesh.h"
#include "sim/constants.h"
#include "sim/law_table.h"

#include "kernels/wall_swing.h"

typedef struct OzPhysics {
    OzSwitches switches;
    const OzScene *scene;         /* borrowed                                                 */
    const OzGrains *grains;       /* borrowed                                                 */
    OzParameters parameters;      /* in double whatever the scene says: length_unit is 1      */
    int wall_order[OZ_WALLS_MAX]; /* scene index of kernel wall k, in the order of kinds      */
    const OzWallMesh
        *mesh[OZ_WALLS_MAX]; /* of kernel wall k, borrowed from the scene; NULL: none */
    OzWallSwing
        swing[OZ_WALLS_MAX]; /* how kernel wall k stands (sim/swings.h); as built at first */
    int wall_count;
    int meshes;  /* how many of them are meshes                                              */
    int edged;   /* how many of them, the last ones, have edges                               */
    int ends;    /* of a grain that a wall can touch: 1 when all grains are spheres, else 2 */
    int touches; /* of a grain that walls can touch, in the order of kernels/wall_shaft.h: ends at
                    all walls, then points of its shaft at those with edges, then slots of
                    each mesh                                                             */
    OzLawConstants law_table[OZ_LAW_TABLE_MOST]; /* where grains are of several materials      */
    double share; /* of a step by which tangential springs are advanced before the force     */
} OzPhysics;

/* Fails with OZ_ERR_INPUT as oz_constants_fill does. */
OzStatus oz_physics_derive(OzPhysics *physics, const OzScene *scene, const OzGrains *grains);
