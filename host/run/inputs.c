/* Inputs compared with a folder's outputs by their real paths, so that no link hides one. */
#include "run/inputs.h"

#include "base/file.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_inputs_add(OzInputs *inputs, const char *path)
{
    OzStatus status = OZ_OK;
    char *real = realpath(path, NULL);
    bool known = !real;
    for (int i = 0; i < inputs->count && !known; i++) {
        known = strcmp(inputs->paths[i], real) == 0;
    }
    if (!known) {
        size_t count = (size_t)inputs->count;
        OZ_TRY(oz_memory_grow((void **)&inputs->paths, count, count + 1, sizeof *inputs->paths,
                              "input files"));
        inputs->paths[inputs->count++] = real;
        real = NULL;
    }
done:
    free(real);
    return status;
}

OzStatus oz_inputs_add_scene(OzInputs *inputs, const OzScene *scene)
{
    OZ_PASS(oz_inputs_add(inputs, scene->path));
    if (scene->base) {
        OZ_PASS(oz_inputs_add(inputs, scene->base));
    }
    for (int i = 0; i < scene->population_count; i++) {
        if (scene->populations[i].path) {
            OZ_PASS(oz_inputs_add(inputs, scene->populations[i].path));
        }
    }
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].motion.file) {
            OZ_PASS(oz_inputs_add(inputs, scene->walls[w].motion.file));
        }
    }
    return OZ_OK;
}

/* Whether a run in the folder has to do with this name in it. */
static bool is_touched(const char *folder, const char *name, const OzFolderUse *use)
{
    return oz_folder_writes(use, name) || oz_folder_names(folder, name);
}

/* The same for name = "member/file": a folder below, whose own marker counts too. */
static bool is_touched_below(const char *folder, const char *name, const OzFolderUse *use)
{
    char *member = NULL;
    const char *slash = strchr(name, '/');
    bool touched = is_touched(folder, name, use);
    if (!touched && slash && oz_file_join(&member, folder, name) == OZ_OK) {
        member[strlen(folder) + 1 + (size_t)(slash - name)] = '\0';
        touched = is_touched(member, slash + 1, use);
    }
    free(member);
    return touched;
}

OzStatus oz_inputs_check(const OzInputs *inputs, const char *folder, const OzFolderUse *use)
{
    OzStatus status = OZ_OK;
    char *real = realpath(folder, NULL);
    size_t length = real ? strlen(real) : 0;
    for (int i = 0; real && i < inputs->count && status == OZ_OK; i++) {
        const char *path = inputs->paths[i];
        bool inside = strncmp(path, real, length) == 0 && path[length] == '/';
        if (inside && is_touched_below(real, path + length + 1, use)) {
            status = oz_status_fail(OZ_ERR_INPUT,
                                    "%s is read here, and the run would write or remove it; "
                                    "expected another folder (-o) than %s",
                                    path, folder);
        }
    }
    free(real);
    return status;
}

void oz_inputs_free(OzInputs *inputs)
{
    for (int i = 0; i < inputs->count; i++) {
        free(inputs->paths[i]);
    }
    free(inputs->paths);
    *inputs = (OzInputs){0};
}
