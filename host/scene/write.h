/* A scene back into a file. */
#pragma once

#include "scene/keys.h"
#include "scene/scene_types.h"

/* Writes every key with its value, in the order of the list of keys. */
void oz_write_scene(const OzScene *scene, FILE *file);

/* Whether a row means something to the scene, or to an item of its lists that base is: by model,
 * kind, shape and law. */
bool oz_write_applies(const OzScene *scene, const OzKey *key, const void *base);

/* Whether a row's value in base (the scene, or an item of its lists) is written; and the value. */
bool oz_write_has(const OzScene *scene, const OzKey *key, const void *base);
void oz_write_value(const OzKey *key, const void *base, FILE *file);
