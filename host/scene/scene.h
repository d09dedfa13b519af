/* Loading, changing and writing scenes. Loading reports every error of the file at once as
 * `file:line: what is wrong; what was expected` (one per line, in file order) and fails with
 * OZ_ERR_INPUT. It never asserts on what a file says. */
#pragma once

#include "scene/scene_types.h"

#include <stdio.h>

/* What a scene of this file is called: "runs/an6.yaml" is named an6. The caller frees. */
OzStatus oz_scene_name(char **name, const char *path);

/* Loads path, then applies the settings ("key.path=value", in order), then checks everything.
 * On success the caller frees with oz_scene_free; on failure *scene is zeroed. */
OzStatus oz_scene_load(OzScene *scene, const char *path, char *const *settings, int setting_count);

/* The same from a text in memory; path serves for messages and for finding other files. */
OzStatus oz_scene_parse(OzScene *scene, const char *path, const char *text, char *const *settings,
                        int setting_count);

/* As oz_scene_load, of a scene that shall take over from the running one: what cannot change is
 * refused too (scene/changes.h), at file and line. */
OzStatus oz_scene_reload(OzScene *scene, const OzScene *running, const char *path,
                         char *const *settings, int setting_count);

/* The running scene with these settings on it, likewise; "-key.path" takes a key out. Phases of
 * walls are left to model/motion.h. */
OzStatus oz_scene_change(OzScene *scene, const OzScene *running, char *const *settings,
                         int setting_count);

/* Writes the scene with every default filled in, as a file that loads to the same scene. */
OzStatus oz_scene_write(const OzScene *scene, FILE *file);

/* The same as a text, which the caller frees. */
OzStatus oz_scene_text(const OzScene *scene, char **text, size_t *length);

/* A copy that shares no memory with the scene. The caller frees it, after a
 * failure too. */
OzStatus oz_scene_copy(OzScene *copy, const OzScene *scene);

/* Frees what scene owns and zeroes it; a zeroed scene is fine. */
void oz_scene_free(OzScene *scene);

/* Whether pictures show something of contacts. */
bool oz_scene_shows_contacts(const OzScene *scene);
