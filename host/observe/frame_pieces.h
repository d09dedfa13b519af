/* The pieces of flat grains in frames.bin: what never changes, and their part of a frame. The
 * layout is in observe/frames.h. */
#pragma once

#include "observe/bytes.h"
#include "observe/snapshot.h"

#include <stdbool.h>

enum { OZ_FRAME_PIECES_HEAD = 4 * 8 }; /* bytes: i64 pieces of grains, of walls, beams, outlines */

OzPieceCounts oz_frame_pieces_count(const OzPieces *pieces);
void oz_frame_pieces_pack_head(OzBytes *at, const OzPieceCounts *counts);
void oz_frame_pieces_unpack_head(OzBytes *at, OzPieceCounts *counts);

/* Bytes of what never changes, and of a frame's part. */
size_t oz_frame_pieces_static_bytes(const OzPieceCounts *counts);
size_t oz_frame_pieces_bytes(const OzPieceCounts *counts);

void oz_frame_pieces_pack_static(OzBytes *at, const OzPieces *pieces);

/* Into pieces made for these counts (grains and walls too), their position, velocity and spin at
 * zero. False for values that no scene can have; nothing out of range is kept in use then. */
bool oz_frame_pieces_unpack_static(OzBytes *at, OzPieces *pieces);

/* A frame's part: position, angle and velocity. Reading joins the grains, whose spin stays unknown:
 * zero. */
void oz_frame_pieces_pack(OzBytes *at, const OzSnapshot *snapshot);
void oz_frame_pieces_unpack(OzBytes *at, OzSnapshot *snapshot);
