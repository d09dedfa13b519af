/* What a person is told to change after a guard stopped trigrains: the step where it is to blame,
 * else beams or contacts that are too soft, and by how much. */
#pragma once

#include "model/snapshot.h"

typedef enum OzElementSoft {
    OZ_ELEMENT_SOFT_BENDING,
    OZ_ELEMENT_SOFT_STRETCH,
    OZ_ELEMENT_SOFT_CONTACT
} OzElementSoft;

/* Writes one clause about an element that was too soft. A step that is unstable for the scene is
 * named with the one that is stable. Otherwise hits at the fastest grain's speed, or at that of the
 * fall to be expected, are taken: beams by a trial (sim/trial.h); a triangle that lands flat, with
 * the mass of its grain, shall go no deeper than a tenth of its height, a disc than half its
 * radius.
 */
void oz_element_advice_write(char *text, size_t size, const OzSnapshot *now, int64_t element,
                             OzElementSoft soft);
