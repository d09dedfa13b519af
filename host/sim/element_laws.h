/* A scene of elements as the constants that kernels and the host reference share. Says OZ_HOST for
 * whoever includes it. */
#pragma once

#define OZ_HOST
#include "kernels/element_law.h"
#include "scene/scene.h"

OzBeamConstants oz_element_laws_beam(const OzScene *scene);

/* One over what a scene's beams bear; all zero where they bear anything. */
OzBeamStrength oz_element_laws_strength(const OzScene *scene);

/* The same of what they bear before they yield. */
OzBeamStrength oz_element_laws_yield(const OzScene *scene);

/* Between two grains (wall -1) or a grain and a wall of the scene, laws hooke and hertz. Of hooke's
 * ways to damp only the constant dashpot is known here, and no tangential spring: its dashpot
 * alone. */
OzDiscLaw oz_element_laws_disc(const OzScene *scene, int wall);
