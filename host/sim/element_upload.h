/* Uploading the start of trigrains. */
#pragma once

#include "sim/model.h"

/* A member's elements, with the derivatives that its integrator begins with, and its control words.
 */
OzStatus oz_element_upload_member(OzSim *sim, int member);
