/* Hertzian contacts (`law: hertz`, `hertz-mindlin`) at the speed and with the grain that ask most
 * of the step: what predict.c needs, since their stiffness and duration depend on both. */
#pragma once

#include "model/contact.h"
#include "model/grains.h"
#include "scene/mixing.h"

typedef struct OzHertzHit {
    double speed;     /* m/s, approach: the fastest grain at the start, the walls, or a fall of two
                         diameters, whichever is most                                        */
    double stiffness; /* (m/s^2) / m^(3/2), force over overlap^(3/2) and effective mass      */
    double damping;   /* hertz: 1/s; hertz-mindlin: alpha                                    */
    OzContactConstants
        linear; /* tangent at the deepest point, per kg; duration of the elastic hit   */
} OzHertzHit;

/* A hit of the lightest grains of two kinds, or of one with a wall. Without grains: of some of 1 mm
 * and 1 mg. */
OzHertzHit oz_hertz_hit(const OzScene *scene, const OzMixed *mixed, const OzGrains *grains);
