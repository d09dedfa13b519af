/* What writing and reading frames.bin share. */
#pragma once

#include "observe/frame_elements.h"
#include "observe/frames.h"

#include <stdio.h>

static const char OZ_FRAMES_MAGIC[8] = "ozframes";
enum {
    OZ_FRAMES_ORDER_MARK = 0x01020304,
    OZ_FRAMES_RODS =
        3, /* versions: of rods, of trigrains; both less two before contacts were kept */
    OZ_FRAMES_FLAT = 4,
    OZ_FRAMES_BREAKABLE = 5, /* of trigrains whose beams break */
    OZ_FRAMES_HEAD = 32,
    OZ_FRAMES_CONTACT = 6 * 4 + 11 * 4 /* bytes of one contact */
};

struct OzFrames {
    FILE *file;
    char *path;
    int64_t whole; /* writing: bytes of whole frames */
    int64_t count;
    int wall_count;
    bool is_flat;
    bool is_old;              /* without angular velocities and contacts       */
    bool breaks;              /* with what beams are whole                     */
    OzElementCounts elements; /* zero for rods                                 */
    size_t frame_bytes;       /* of a frame without contacts                   */
    unsigned char *frame;     /* room for one frame                            */
    size_t capacity;          /* bytes of it                                   */
    size_t left;              /* reading: bytes of the file not yet read       */
    int64_t frame_number;     /* reading: frames given so far                  */
};

/* Bytes of the head, of all before the first frame, and of a frame without contacts. */
size_t oz_frames_head_bytes(const OzFrames *frames);
size_t oz_frames_static_bytes(const OzFrames *frames);
size_t oz_frames_frame_bytes(const OzFrames *frames);

/* mode: of fopen. After a failure oz_frames_finish frees what there is. */
OzStatus oz_frames_open_file(OzFrames **frames, const char *path, const char *mode);

/* What vouches for a frame's size and purpose, so that a damaged size is not taken for a file that
 * was cut short. */
uint32_t oz_frames_check(uint64_t bytes, uint32_t purpose);

/* Room for a frame of so many bytes. */
OzStatus oz_frames_make_room(OzFrames *frames, size_t bytes);
