/* Writes frames.bin: each block is packed into one buffer and written in one go. Knows nothing of
 * pictures. */
#include "base/file.h"
#include "base/memory.h"
#include "observe/frames_private.h"

#include <errno.h>
#include <stdlib.h>

enum {
    GRAIN_BYTES = 3 * 8 + 4, /* diameter, length, mass, population     */
    FRAME_HEAD_BYTES = 32,
    FRAME_GRAIN_BYTES = 4 * (3 + 4 + 3), /* position, quaternion, velocity         */
    FRAME_SPIN_BYTES = 4 * 3,            /* angular velocity                       */
    FRAME_WALL_BYTES = 4 * 2             /* offset, velocity                       */
};

size_t oz_frames_head_bytes(const OzFrames *frames)
{
    return OZ_FRAMES_HEAD + (frames->is_flat ? OZ_FRAME_ELEMENTS_HEAD : 0);
}

size_t oz_frames_static_bytes(const OzFrames *frames)
{
    size_t elements = frames->is_flat ? oz_frame_elements_static_bytes(&frames->elements) : 0;
    return oz_frames_head_bytes(frames) + (size_t)frames->count * GRAIN_BYTES + elements +
           OZ_BYTES_CHECKSUM;
}

size_t oz_frames_frame_bytes(const OzFrames *frames)
{
    size_t grain = FRAME_GRAIN_BYTES + (frames->is_old ? 0 : FRAME_SPIN_BYTES);
    size_t state = frames->is_flat ? oz_frame_elements_bytes(&frames->elements, !frames->is_old)
                                   : (size_t)frames->count * grain;
    size_t contacts = frames->is_old ? 0 : sizeof(int64_t);
    state += frames->breaks ? (size_t)frames->elements.beams : 0;
    return FRAME_HEAD_BYTES + state + (size_t)frames->wall_count * FRAME_WALL_BYTES + contacts +
           OZ_BYTES_CHECKSUM;
}

static OzStatus write_block(OzFrames *frames, unsigned char *block, size_t bytes)
{
    oz_bytes_seal(block, bytes);
    fwrite(block, 1, bytes, frames->file);
    return oz_file_commit(frames->file, &frames->whole, frames->path);
}

static OzStatus write_static(OzFrames *frames, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    unsigned char *block = NULL;
    uint32_t flat = frames->breaks ? OZ_FRAMES_BREAKABLE : OZ_FRAMES_FLAT;
    uint32_t marks[2] = {OZ_FRAMES_ORDER_MARK, frames->is_flat ? flat : OZ_FRAMES_RODS};
    uint32_t walls[2] = {(uint32_t)frames->wall_count, 0};
    size_t bytes = oz_frames_static_bytes(frames), column = (size_t)frames->count * sizeof(double);
    OZ_TRY(OZ_NEW(&block, bytes));
    OzBytes at = block;
    oz_bytes_pack(&at, OZ_FRAMES_MAGIC, sizeof OZ_FRAMES_MAGIC);
    oz_bytes_pack(&at, marks, sizeof marks);
    oz_bytes_pack(&at, &frames->count, sizeof frames->count);
    oz_bytes_pack(&at, walls, sizeof walls);
    if (frames->is_flat) {
        oz_frame_elements_pack_head(&at, &frames->elements);
    }
    oz_bytes_pack(&at, grains->diameter, column);
    oz_bytes_pack(&at, grains->length, column);
    oz_bytes_pack(&at, grains->mass, column);
    for (int64_t i = 0; i < frames->count; i++) {
        int32_t population = (int32_t)grains->population[i];
        oz_bytes_pack(&at, &population, sizeof population);
    }
    if (frames->is_flat) {
        oz_frame_elements_pack_static(&at, grains->elements);
    }
    OZ_TRY(write_block(frames, block, bytes));
done:
    free(block);
    return status;
}

OzStatus oz_frames_open_file(OzFrames **frames, const char *path, const char *mode)
{
    OZ_PASS(OZ_NEW(frames, 1));
    OZ_PASS(oz_memory_text(&(*frames)->path, path));
    (*frames)->file = fopen(path, mode);
    if (!(*frames)->file) {
        return oz_status_fail(OZ_ERR_FILE, "cannot %s %s: %s", mode[0] == 'w' ? "write" : "read",
                              path, strerror(errno));
    }
    return OZ_OK;
}

OzStatus oz_frames_make_room(OzFrames *frames, size_t bytes)
{
    if (bytes > frames->capacity) {
        OZ_PASS(oz_memory_grow((void **)&frames->frame, frames->capacity, bytes, 1, "a frame"));
        frames->capacity = bytes;
    }
    return OZ_OK;
}

/* mode: of fopen; the static part is written into an empty file. */
static OzStatus open_to_write(OzFrames **frames, const char *path, const OzScene *scene,
                              const OzGrains *grains, const char *mode)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_frames_open_file(frames, path, mode));
    (*frames)->count = grains->count;
    (*frames)->wall_count = scene->wall_count;
    (*frames)->is_flat = grains->elements != NULL;
    if (grains->elements) {
        (*frames)->elements = oz_frame_elements_count(grains->elements);
        (*frames)->breaks = scene->beams.strength.present;
    }
    (*frames)->frame_bytes = oz_frames_frame_bytes(*frames);
    OZ_TRY(oz_frames_make_room(*frames, (*frames)->frame_bytes));
    if (mode[0] == 'w') {
        OZ_TRY(write_static(*frames, grains));
    }
done:
    if (status != OZ_OK) {
        oz_frames_finish(*frames);
        *frames = NULL;
    }
    return status;
}

OzStatus oz_frames_create(OzFrames **frames, const char *path, const OzScene *scene,
                          const OzGrains *grains)
{
    return open_to_write(frames, path, scene, grains, "wb");
}

OzStatus oz_frames_go_on(OzFrames **frames, const char *path, const OzScene *scene,
                         const OzGrains *grains)
{
    return open_to_write(frames, path, scene, grains, "r+b");
}

OzStatus oz_frames_state(OzFrames *frames, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "frames", 1));
    OZ_PASS(oz_state_index(visit, "file_bytes", &frames->whole, 0, INT64_MAX));
    oz_state_leave(visit);
    if (visit->is_loading) {
        return oz_file_go_on(frames->file, frames->whole, frames->path);
    }
    return OZ_OK;
}

uint32_t oz_frames_check(uint64_t bytes, uint32_t purpose)
{
    const uint64_t words[2] = {bytes, purpose};
    return (uint32_t)oz_bytes_sum((const unsigned char *)words, sizeof words);
}

static void pack_contact(OzBytes *at, const OzContactEntry *e)
{
    int32_t whole[6] = {e->a, e->b, e->part_a, e->part_b, (int32_t)e->kind, e->slips};
    oz_bytes_pack(at, whole, sizeof whole);
    oz_bytes_pack_floats(at, e->point, 3);
    oz_bytes_pack_floats(at, e->normal, 3);
    oz_bytes_pack_floats(at, &e->push, 1);
    oz_bytes_pack_floats(at, e->tangential, 3);
    oz_bytes_pack_floats(at, &e->overlap, 1);
}

OzStatus oz_frames_add(OzFrames *frames, const OzSnapshot *snapshot, int purpose)
{
    bool is_wanted = (purpose & OZ_FRAME_EXPORT) || oz_scene_shows_contacts(snapshot->scene);
    bool has_contacts = is_wanted && snapshot->has_contacts;
    int64_t contacts = has_contacts ? snapshot->contacts.count : -1;
    uint64_t bytes =
        frames->frame_bytes + (has_contacts ? (size_t)contacts * OZ_FRAMES_CONTACT : 0);
    uint32_t purposes[2] = {(uint32_t)purpose, oz_frames_check(bytes, (uint32_t)purpose)};
    OZ_PASS(oz_frames_make_room(frames, bytes));
    OzBytes at = frames->frame;
    oz_bytes_pack(&at, &bytes, sizeof bytes);
    oz_bytes_pack(&at, purposes, sizeof purposes);
    oz_bytes_pack(&at, &snapshot->step, sizeof snapshot->step);
    oz_bytes_pack(&at, &snapshot->time, sizeof snapshot->time);
    oz_bytes_pack_floats(&at, snapshot->wall_offset, frames->wall_count);
    oz_bytes_pack_floats(&at, snapshot->wall_velocity, frames->wall_count);
    if (frames->is_flat) {
        oz_frame_elements_pack(&at, snapshot);
        oz_frame_elements_pack_wear(&at, &snapshot->wear, frames->breaks);
    } else {
        oz_bytes_pack_floats(&at, snapshot->position, 3 * frames->count);
        oz_bytes_pack_floats(&at, snapshot->quaternion, 4 * frames->count);
        oz_bytes_pack_floats(&at, snapshot->velocity, 3 * frames->count);
        oz_bytes_pack_floats(&at, snapshot->angular_velocity, 3 * frames->count);
    }
    oz_bytes_pack(&at, &contacts, sizeof contacts);
    for (int64_t i = 0; i < contacts; i++) {
        pack_contact(&at, &snapshot->contacts.entry[i]);
    }
    return write_block(frames, frames->frame, bytes);
}

OzStatus oz_frames_finish(OzFrames *frames)
{
    OzStatus status = OZ_OK;
    if (!frames) {
        return OZ_OK;
    }
    if (frames->file && fclose(frames->file) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot close %s: %s", frames->path, strerror(errno));
    }
    free(frames->path);
    free(frames->frame);
    free(frames);
    return status;
}
