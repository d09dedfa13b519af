/* Uploading the start of trigrains. */
#ifndef OZ_COMPUTE_PIECE_UPLOAD_H
#define OZ_COMPUTE_PIECE_UPLOAD_H

#include "compute/model.h"

/* A member's pieces, with the derivatives that its integrator begins with, and its control words.
 */
OzStatus oz_piece_upload_member(OzSim *sim, int member);

#endif
