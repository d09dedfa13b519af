/* The meshes of a scene's walls: read, held and let go with the scene. */
#pragma once

#include "scene/faults.h"
#include "scene/scene_types.h"
#include "scene/tree.h"

/* Reads the file of every mesh, with a fault where one cannot be read. A scene that shall take over
 * from a running one (else NULL) is refused where a file has changed since. */
OzStatus oz_wall_meshes_load(OzScene *scene, const OzScene *running, OzNode *root,
                             OzFaults *faults);

/* The scene is a copy, and holds its meshes too. */
void oz_wall_meshes_share(OzScene *scene);
void oz_wall_meshes_drop(OzScene *scene);
