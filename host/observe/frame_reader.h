/* Reading frames.bin (observe/frames.h). */
#pragma once

#include "observe/frames.h"

/* Opens for reading: *grains receives geometry, mass, inertia and population, at the origin and
 * upright, and trigrains' elements (the caller frees). A damaged or foreign file is refused by name
 * with OZ_ERR_INPUT; a file cut short by a crash gives its whole frames. Nothing larger than the
 * file is ever allocated.
 */
OzStatus oz_frame_reader_open(OzFrames **frames, const char *path, OzGrains *grains);

/* To be called where the file may have grown since the end was met. */
OzStatus oz_frame_reader_renew(OzFrames *frames);

/* The next frame into snapshot (made for these grains and a scene with as many walls, else
 * OZ_ERR_INPUT); *more is false at the end and the snapshot then untouched. Axes are turned. There
 * is no ledger and nothing of beams; contacts where they were kept, their springs and energies
 * zero. Of old files angular velocities are zero. */
OzStatus oz_frame_reader_next(OzFrames *frames, OzSnapshot *snapshot, int *purpose, bool *more);
