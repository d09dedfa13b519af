/* What a servo wall is made of, where the scene leaves it to orzo. */
#pragma once

#include "model/grains.h"
#include "scene/scene.h"
#include "scene/servo_area.h"

typedef struct OzServoNature {
    bool has_area;
    OzServoArea area; /* as built                                          */
    double mass;      /* kg: written, or of all grains                     */
    double damping;   /* kg/s: written, or critical, 2 sqrt(mass stiffness) */
    double
        stiffness; /* N/m, of a bed as a cube of the grains, each a spring as stiff as a contact  */
    double touching;     /* N/m, of the grains of that cube that touch it     */
    double load;         /* N, as built, its weight included                  */
    double largest_step; /* s, at which it is stable on those              */
} OzServoNature;

/* The bed's stiffness is a guess. A cube of N grains between plates is N^(1/3) contacts' stiffness,
 * for it is N^(2/3) rows side by side of N^(1/3) in each. A bed n times as tall is softer by n^2. A
 * Hertzian contact is taken where it bears its share of the load, of at least the bed's weight. */
OzServoNature oz_servo_nature_of(const OzScene *scene, const OzGrains *grains, int wall);
