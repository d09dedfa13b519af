/* The files that a command reads: its scene, what that extends, beds from files. A run must neither
 * remove nor overwrite them. */
#pragma once

#include "base/folder.h"
#include "scene/scene.h"

/* Real paths, each once. Zeroed is valid: none. */
typedef struct OzInputs {
    char **paths; /* owned */
    int count;
} OzInputs;

/* Adds what this scene was read from and reads. Files that are not there are left out. */
OzStatus oz_inputs_add_scene(OzInputs *inputs, const OzScene *scene);

/* Adds one file. */
OzStatus oz_inputs_add(OzInputs *inputs, const char *path);

/* Refuses, with OZ_ERR_INPUT and by name, an input that a command in this folder would write or
 * remove. Such an input lies in the folder, or in a folder right below it, and is one of the files
 * that `use` writes or that a marker names. A folder that is not there is fine. Changes nothing. */
OzStatus oz_inputs_check(const OzInputs *inputs, const char *folder, const OzFolderUse *use);

void oz_inputs_free(OzInputs *inputs);
