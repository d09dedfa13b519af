/* frames.bin: the movie's and the snapshots' frames, float32 by id, so that pictures can be drawn again
 * without simulating. */
#ifndef OZ_OBSERVE_FRAMES_H
#define OZ_OBSERVE_FRAMES_H

#include "observe/snapshot.h"

typedef struct OzFrames OzFrames;

enum { OZ_FRAME_MOVIE = 1, OZ_FRAME_SNAPSHOT = 2 }; /* what a frame is for: bits */

OzStatus oz_frames_create(OzFrames **frames, const char *path, const OzScene *scene,
                          const OzGrains *grains);
OzStatus oz_frames_add(OzFrames *frames, const OzSnapshot *snapshot, int purpose);
OzStatus oz_frames_finish(OzFrames *frames); /* closes and frees; NULL is fine */

/* Opens for reading: *grains receives geometry, mass and population (the caller frees). A damaged or
 * foreign file is refused by name; a file cut short by a crash gives its whole frames. */
OzStatus oz_frames_open(OzFrames **frames, const char *path, OzGrains *grains);

/* The next frame into snapshot (made for these grains); *more is false at the end. */
OzStatus oz_frames_next(OzFrames *frames, OzSnapshot *snapshot, int *purpose, bool *more);

#endif
