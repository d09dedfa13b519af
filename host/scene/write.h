/* A scene back into a file. */
#pragma once

#include "scene/scene.h"

/* Writes every key with its value, in the order of the list of keys. */
void oz_write_scene(const OzScene *scene, FILE *file);
