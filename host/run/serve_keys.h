/* The table of keys that may change while a scene runs, from the list of keys. */
#pragma once

#include "run/page.h"
#include "scene/scene.h"

/* Every such key that applies to the scene, with its value or the one that it inherits; empty: it
 * has none yet. */
OzStatus oz_serve_keys_show(OzPage *page, const OzScene *scene);
