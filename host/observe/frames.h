/* frames.bin: the movie's and the snapshots' frames, float32 by id, so that pictures can be drawn
 * again without simulating.
 *
 * Layout, in the byte order of the machine that wrote it, without padding:
 *   head    char[8] "ozframes"; u32 0x01020304; u32 version 3; i64 count; u32 wall_count; u32 0
 *   grains  f64 diameter[count]; f64 length[count]; f64 mass[count]; i32 population[count]
 *           u64 checksum of head and grains
 *   frame   u64 bytes of this frame, itself included; u32 purpose; u32 check: the lower half of
 *           the checksum of u64 bytes, u64 purpose; i64 step; f64 time
 *           f32 wall_offset[wall_count]; f32 wall_velocity[wall_count]
 *           f32 position[3 count]; f32 quaternion[4 count]; f32 velocity[3 count]
 *           f32 angular_velocity[3 count]
 *           i64 contact_count, -1 where contacts were not looked at; then of each contact
 *               i32 a, b, part_a, part_b, kind, slips; f32 point[3], normal[3], push,
 *               tangential[3], overlap (model/contact_list.h)
 *           u64 checksum of this frame
 *   ...     further frames to the end of the file
 * Version 4, of trigrains, differs thus:
 *   head    followed by i64 elements of grains; i64 of walls; i64 beam_count; i64 outline_count
 *   grains  followed by i32 first[count + wall_count + 1]; for all elements f64 radius, corner x 6,
 *           area, mass, inertia, angle (array after array); i32 beam_a, beam_b, outline_element,
 *           outline_edge (array after array)
 *   frame   f32 element_position[2 elements]; f32 element_angle[elements]; f32 element_velocity[2
 *           elements] in the place of position to angular_velocity
 * Version 5 is 4 of a scene with beams.strength; a frame's elements are followed by u8
 * whole[beam_count], 0 of a beam that has broken; the contacts' bodies are pieces (model/pieces.h)
 * as it has them. Versions 1 and 2 are 3 and 4 without angular_velocity and without contacts; they
 * are read still. purpose is a sum of OZ_FRAME_ bits. Frames with OZ_FRAME_SETTLING come before all
 * others: of them step and time count from where settling began, for when it will end is not known
 * before. SI units; quaternions w x y z; a checksum is FNV-1a, 64 bits, of all bytes before it. */
#pragma once

#include "base/state.h"
#include "model/snapshot.h"

typedef struct OzFrames OzFrames;

/* What a frame is for: bits. */
enum {
    OZ_FRAME_MOVIE = 1,
    OZ_FRAME_SNAPSHOT = 2,
    OZ_FRAME_STROBE = 4,
    OZ_FRAME_EXPORT = 8,
    OZ_FRAME_SETTLING = 16 /* besides OZ_FRAME_MOVIE: before time 0 */
};

/* Opens path for writing; scene and grains are read here only. Fails with OZ_ERR_FILE. */
OzStatus oz_frames_create(OzFrames **frames, const char *path, const OzScene *scene,
                          const OzGrains *grains);

/* The same for frames that are there already: they are left alone until oz_frames_state loads how
 * many of their bytes count, cuts off the others and lets frames follow. */
OzStatus oz_frames_go_on(OzFrames **frames, const char *path, const OzScene *scene,
                         const OzGrains *grains);

/* Saves or loads (base/state.h) how much of the file is whole. */
OzStatus oz_frames_state(OzFrames *frames, OzStateVisit *visit);

/* Appends one frame and flushes, so that a crash later leaves it whole. Contacts are kept of frames
 * for OZ_FRAME_EXPORT, and where the snapshot's scene shows them in pictures. */
OzStatus oz_frames_add(OzFrames *frames, const OzSnapshot *snapshot, int purpose);

OzStatus
oz_frames_finish(OzFrames *frames); /* closes and frees, also after reading; NULL is fine */
