/* A scene's phases (scene/phases.h) as changes that are made at the steps at which they begin. */
#pragma once

#include "model/grains.h"
#include "run/replay.h"
#include "scene/scene.h"

/* Those of the phases that change anything, each judged in its turn from the `taken` first ones on,
 * which the scene has taken already; grains: the scene's. Fails with OZ_ERR_INPUT, naming the
 * phase, where the running scene cannot change so, where its step would be too long (which
 * forced allows), and where taps are counted although the period changes. The caller frees, also on
 * failure. */
OzStatus oz_protocol_make(OzReplay *protocol, const OzScene *scene, const OzGrains *grains,
                          bool forced, int64_t taken);
