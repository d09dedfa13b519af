/* Constants of beams and discs from a scene. */
#include "sim/element_laws.h"

#include "model/contact.h"

OzBeamConstants oz_element_laws_beam(const OzScene *scene)
{
    const OzBeamValues *beams = &scene->beams;
    return (OzBeamConstants){.stiffness = beams->stiffness,
                             .bending = beams->stiffness * beams->second_moment,
                             .damping = beams->damping,
                             .damping_bending = beams->damping * beams->second_moment};
}

OzBeamStrength oz_element_laws_strength(const OzScene *scene)
{
    const OzBeamStrengthValues *s = &scene->beams.strength;
    return s->present ? (OzBeamStrength){.pulled = 1 / s->tension,
                                         .pressed = 1 / s->compression,
                                         .bent = 1 / s->moment,
                                         .together = s->criterion != OZ_STRENGTH_SEPARATE,
                                         .quadratic = s->criterion == OZ_STRENGTH_QUADRATIC}
                      : (OzBeamStrength){0};
}

OzBeamStrength oz_element_laws_yield(const OzScene *scene)
{
    const OzBeamYieldValues *y = &scene->beams.yield;
    return y->present ? (OzBeamStrength){.pulled = 1 / y->tension,
                                         .pressed = 1 / y->compression,
                                         .bent = 1 / y->moment}
                      : (OzBeamStrength){0};
}

OzDiscLaw oz_element_laws_disc(const OzScene *scene, int wall)
{
    OzContactValues values = wall < 0 ? scene->contact : scene->walls[wall].contact;
    values.damping = OZ_DAMPING_CONSTANT;
    OzContactConstants constants = oz_contact_constants_of(&values, &scene->contact);
    return (OzDiscLaw){.hertz = values.law == OZ_LAW_HERTZ,
                       .clamp = values.attraction == OZ_ATTRACTION_CLAMP,
                       .stiffness = constants.stiffness,
                       .damping = constants.damping,
                       .tangential_damping = constants.tangential_damping,
                       .friction = values.friction};
}
