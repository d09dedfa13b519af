/* What beams that can break or yield do, and contacts between triangles that one held together. For
 * .c files that have entered the scene's switches (sim/host_switches.h). */
#pragma once

#include "model/elements.h"
#include "sim/element_bear_types.h"
#include "sim/element_dialect.h"

/* Weakens the contact of triangles that overlapped when a grain broke between them; whether they
 * still do. */
bool oz_element_bear_contact(OzElementBear *bear, int a, int b, OzOverlap *overlap);

/* The force of beam k between these ends. Where evaluations change beams, one beyond what it yields
 * at takes another shape at rest, and one that bears no more breaks. */
OzBeamForce oz_element_bear_beam(OzElementBear *bear, const OzElements *elements, int64_t k,
                                 OzBeamEnd a, OzBeamEnd b);
