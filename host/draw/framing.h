/* What a scene's pictures show: chosen once from its walls and its bed. */
#pragma once

#include "base/state.h"
#include "draw/camera.h"

/* oz_renderer_look's work. */
OzLook oz_framing_look(const OzScene *scene, const OzSnapshot *snapshot);

/* The look of the scene's single pictures, which frame the same: `snapshots` over the movie's. */
OzLook oz_framing_still(const OzScene *scene, const OzLook *movie);

/* m, of the narrowest upright cylinder; INFINITY without one. */
double oz_framing_radius(const OzScene *scene);

/* m: where walls that are open above end in this picture: at the top of what is framed, above the
 * highest grain where one is higher, and no further than the picture shows. */
double oz_framing_top(const OzLook *look, const OzCamera *camera, const OzSnapshot *snapshot);

/* Makes a look frame what another one frames, by the same scale of speed. */
void oz_framing_keep(OzLook *look, const OzLook *framed);

/* Saves or loads (base/state.h) what oz_framing_keep copies. */
OzStatus oz_framing_state(OzLook *look, OzStateVisit *visit);
