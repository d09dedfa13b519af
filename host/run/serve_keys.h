/* The table of keys that may change while a scene runs, from the list of keys. */
#pragma once

#include "run/page.h"
#include "scene/scene.h"

/* Every such key that the scene has a value for, with that value. */
OzStatus oz_serve_keys_show(OzPage *page, const OzScene *scene);
