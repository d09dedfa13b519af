/* What `orzo run` would refuse, for studies that run scenes by themselves. */
#pragma once

#include "model/grains.h"

/* Fails with OZ_ERR_INPUT, naming the largest stable step, when a contact that can happen is
 * unstable at the scene's step. */
OzStatus oz_report_refuse_unstable(const OzScene *scene, const OzGrains *grains);
