/* The walls as glass, floor and lines, so that one sees the grains inside. Part of it lies behind
 * the grains and is drawn before them, part in front and is drawn after. Knows no GL. */
#pragma once

#include "draw/camera.h"
#include "draw/mesh.h"

/* In the order in which they are drawn. */
typedef enum OzContainerMesh {
    OZ_CONTAINER_FLOORS,       /* opaque, behind the grains, with depth              */
    OZ_CONTAINER_BEHIND,       /* panes and lines behind the grains                  */
    OZ_CONTAINER_GLASS_BEHIND, /* of the upright cylinder, which stands still        */
    OZ_CONTAINER_END_BEHIND,   /* its upper end, as high as grains fly               */
    OZ_CONTAINER_OBSTACLES,    /* opaque, among the grains, with depth               */
    OZ_CONTAINER_OUTLINES,     /* of these                                           */
    OZ_CONTAINER_BEFORE,       /* after the grains: bodies of floors, panes, lines   */
    OZ_CONTAINER_GLASS_BEFORE,
    OZ_CONTAINER_END_BEFORE,
    OZ_CONTAINER_COUNT
} OzContainerMesh;

typedef struct OzContainer {
    OzMesh meshes[OZ_CONTAINER_COUNT];
    double high; /* view coordinate y up to which they are seen */
} OzContainer;

/* Makes the meshes of the snapshot's walls where they are now, for this view; they end above the
 * highest grain, or where the picture does. Fails with OZ_ERR_MEMORY. */
OzStatus oz_container_build(OzContainer *container, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera, OzView view);

void oz_container_free(OzContainer *container); /* zeroed is fine */
