/* The elements of flat grains in frames.bin: what never changes, and their part of a frame. The
 * layout is in observe/frames.h. */
#pragma once

#include "model/snapshot.h"
#include "observe/bytes.h"

#include <stdbool.h>

enum {
    OZ_FRAME_ELEMENTS_HEAD = 4 * 8
}; /* bytes: i64 elements of grains, of walls, beams, outlines */

OzElementCounts oz_frame_elements_count(const OzElements *elements);
void oz_frame_elements_pack_head(OzBytes *at, const OzElementCounts *counts);
void oz_frame_elements_unpack_head(OzBytes *at, OzElementCounts *counts);

/* Bytes of what never changes, and of a frame's part, which old files have without angular
 * velocities. */
size_t oz_frame_elements_static_bytes(const OzElementCounts *counts);
size_t oz_frame_elements_bytes(const OzElementCounts *counts, bool has_spin);

void oz_frame_elements_pack_static(OzBytes *at, const OzElements *elements);

/* Into elements made for these counts (grains and walls too), their position, velocity and spin at
 * zero. False for values that no scene can have; nothing out of range is kept in use then. */
bool oz_frame_elements_unpack_static(OzBytes *at, OzElements *elements);

/* Which beams are whole, where any can break. Reading makes the snapshot's grains what is left of
 * them.
 */
void oz_frame_elements_pack_wear(OzBytes *at, const OzWear *wear, bool breaks);
OzStatus oz_frame_elements_unpack_wear(OzBytes *at, OzSnapshot *snapshot, bool breaks);

/* A frame's part: position, angle, velocity and angular velocity, zero where it was not kept.
 * Grains are joined afterwards, which have no spin then. */
void oz_frame_elements_pack(OzBytes *at, const OzSnapshot *snapshot);
void oz_frame_elements_unpack(OzBytes *at, OzSnapshot *snapshot, bool has_spin);
void oz_frame_elements_join(OzSnapshot *snapshot, bool has_spin);
