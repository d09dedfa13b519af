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
