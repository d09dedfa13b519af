/* Uploading the start of trigrains. */
#pragma once

#include "compute/model.h"

/* A member's pieces, with the derivatives that its integrator begins with, and its control words.
 */
OzStatus oz_piece_upload_member(OzSim *sim, int member);
