/* frames.bin, written and read. Each block is packed into one buffer and written in one go; reading
 * trusts nothing of a file before its checksum. Knows nothing of pictures. */
#include "observe/frames.h"

#include "base/file.h"
#include "base/memory.h"
#include "observe/frame_elements.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char MAGIC[8] = "ozframes";
enum {
    BYTE_ORDER_MARK = 0x01020304,
    RODS_VERSION = 1,
    FLAT_VERSION = 2,
    HEAD_BYTES = 32,
    GRAIN_BYTES = 3 * 8 + 4, /* diameter, length, mass, population                     */
    FRAME_HEAD_BYTES = 32,
    FRAME_GRAIN_BYTES = 4 * (3 + 4 + 3), /* position, quaternion, velocity                     */
    FRAME_WALL_BYTES = 4 * 2, /* offset, velocity                                       */
    COUNT_MAX = 1 << 30       /* grains, walls: sizes computed from them cannot overflow */
};

struct OzFrames {
    FILE *file;
    char *path;
    int64_t whole; /* writing: bytes of whole frames */
    int64_t count;
    int wall_count;
    bool is_flat;
    OzElementCounts elements; /* zero for rods */
    size_t frame_bytes;
    unsigned char *frame; /* room for one frame                            */
    size_t left;          /* reading: bytes of the file not yet read       */
    int64_t frame_number; /* reading: frames given so far                  */
};

static size_t head_bytes(const OzFrames *frames)
{
    return HEAD_BYTES + (frames->is_flat ? OZ_FRAME_ELEMENTS_HEAD : 0);
}

static size_t static_bytes(const OzFrames *frames)
{
    size_t elements = frames->is_flat ? oz_frame_elements_static_bytes(&frames->elements) : 0;
    return head_bytes(frames) + (size_t)frames->count * GRAIN_BYTES + elements + OZ_BYTES_CHECKSUM;
}

static size_t frame_bytes(const OzFrames *frames)
{
    size_t state = frames->is_flat ? oz_frame_elements_bytes(&frames->elements)
                                   : (size_t)frames->count * FRAME_GRAIN_BYTES;
    return FRAME_HEAD_BYTES + state + (size_t)frames->wall_count * FRAME_WALL_BYTES +
           OZ_BYTES_CHECKSUM;
}

static OzStatus refuse(const OzFrames *frames, const char *why)
{
    return oz_status_fail(OZ_ERR_INPUT, "%s: %s; expected a frames.bin of orzo, version %d or %d",
                          frames->path, why, RODS_VERSION, FLAT_VERSION);
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
    uint32_t marks[2] = {BYTE_ORDER_MARK, frames->is_flat ? FLAT_VERSION : RODS_VERSION};
    uint32_t walls[2] = {(uint32_t)frames->wall_count, 0};
    size_t bytes = static_bytes(frames), column = (size_t)frames->count * sizeof(double);
    OZ_TRY(OZ_NEW(&block, bytes));
    OzBytes at = block;
    oz_bytes_pack(&at, MAGIC, sizeof MAGIC);
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

static OzStatus open_file(OzFrames **frames, const char *path, const char *mode)
{
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(frames, 1));
    OZ_TRY(oz_memory_text(&(*frames)->path, path));
    (*frames)->file = fopen(path, mode);
    if (!(*frames)->file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot %s %s: %s", mode[0] == 'w' ? "write" : "read",
                                path, strerror(errno));
    }
done:
    return status;
}

/* mode: of fopen; the static part is written into an empty file. */
static OzStatus open_to_write(OzFrames **frames, const char *path, const OzScene *scene,
                              const OzGrains *grains, const char *mode)
{
    OzStatus status = OZ_OK;
    OZ_TRY(open_file(frames, path, mode));
    (*frames)->count = grains->count;
    (*frames)->wall_count = scene->wall_count;
    (*frames)->is_flat = grains->elements != NULL;
    if (grains->elements) {
        (*frames)->elements = oz_frame_elements_count(grains->elements);
    }
    (*frames)->frame_bytes = frame_bytes(*frames);
    OZ_TRY(OZ_NEW(&(*frames)->frame, (*frames)->frame_bytes));
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
    OzStatus status = OZ_OK;
    OZ_TRY(oz_state_enter(visit, "frames", 1));
    OZ_TRY(oz_state_index(visit, "file_bytes", &frames->whole, 0, INT64_MAX));
    oz_state_leave(visit);
    if (visit->is_loading) {
        status = oz_file_go_on(frames->file, frames->whole, frames->path);
    }
done:
    return status;
}

OzStatus oz_frames_add(OzFrames *frames, const OzSnapshot *snapshot, int purpose)
{
    uint64_t bytes = frames->frame_bytes;
    uint32_t purposes[2] = {(uint32_t)purpose, 0};
    OzBytes at = frames->frame;
    oz_bytes_pack(&at, &bytes, sizeof bytes);
    oz_bytes_pack(&at, purposes, sizeof purposes);
    oz_bytes_pack(&at, &snapshot->step, sizeof snapshot->step);
    oz_bytes_pack(&at, &snapshot->time, sizeof snapshot->time);
    oz_bytes_pack_floats(&at, snapshot->wall_offset, frames->wall_count);
    oz_bytes_pack_floats(&at, snapshot->wall_velocity, frames->wall_count);
    if (frames->is_flat) {
        oz_frame_elements_pack(&at, snapshot);
    } else {
        oz_bytes_pack_floats(&at, snapshot->position, 3 * frames->count);
        oz_bytes_pack_floats(&at, snapshot->quaternion, 4 * frames->count);
        oz_bytes_pack_floats(&at, snapshot->velocity, 3 * frames->count);
    }
    return write_block(frames, frames->frame, frames->frame_bytes);
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

static OzStatus read_block(OzFrames *frames, unsigned char *block, size_t bytes)
{
    if (fread(block, 1, bytes, frames->file) != bytes) {
        return oz_status_fail(OZ_ERR_FILE, "cannot read %s: %s", frames->path,
                              ferror(frames->file) ? strerror(errno) : "it became shorter");
    }
    frames->left -= bytes;
    return OZ_OK;
}

static OzStatus measure_file(OzFrames *frames)
{
    struct stat info;
    if (fstat(fileno(frames->file), &info) != 0) {
        return oz_status_fail(OZ_ERR_FILE, "cannot read %s: %s", frames->path, strerror(errno));
    }
    if (!S_ISREG(info.st_mode) || info.st_size < HEAD_BYTES + OZ_BYTES_CHECKSUM) {
        return refuse(frames, S_ISREG(info.st_mode) ? "too short" : "not a file");
    }
    frames->left = (size_t)info.st_size;
    return OZ_OK;
}

static bool counts_are_possible(const OzFrames *frames)
{
    const OzElementCounts *p = &frames->elements;
    const int64_t counts[] = {frames->count, p->walls,         p->beams,
                              p->outlines,   p->free_elements, p->wall_elements};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        if (counts[i] < 0 || counts[i] > COUNT_MAX) {
            return false;
        }
    }
    return true;
}

/* Reads the part of the head that all files have into block. */
static OzStatus read_common_head(OzFrames *frames, unsigned char *block)
{
    OzStatus status = OZ_OK;
    char magic[sizeof MAGIC];
    uint32_t marks[2], walls[2];
    OZ_TRY(read_block(frames, block, HEAD_BYTES));
    OzBytes at = block;
    oz_bytes_unpack(&at, magic, sizeof magic);
    oz_bytes_unpack(&at, marks, sizeof marks);
    oz_bytes_unpack(&at, &frames->count, sizeof frames->count);
    oz_bytes_unpack(&at, walls, sizeof walls);
    if (memcmp(magic, MAGIC, sizeof MAGIC) != 0) {
        status = refuse(frames, "not a file of frames");
    } else if (marks[0] != BYTE_ORDER_MARK) {
        status = refuse(frames, "written on a machine with another byte order");
    } else if (marks[1] != RODS_VERSION && marks[1] != FLAT_VERSION) {
        status = refuse(frames, "another version of the format");
    }
    frames->is_flat = marks[1] == FLAT_VERSION;
    frames->elements.grains = frames->count;
    frames->elements.walls = walls[0];
    frames->wall_count = walls[0] > COUNT_MAX ? COUNT_MAX : (int)walls[0];
done:
    return status;
}

/* Reads the head into block and checks that the grains it promises are there. */
static OzStatus read_head(OzFrames *frames, unsigned char *block)
{
    OzStatus status = OZ_OK;
    size_t size = frames->left;
    OZ_TRY(read_common_head(frames, block));
    if (frames->is_flat && frames->left < OZ_FRAME_ELEMENTS_HEAD) {
        status = refuse(frames, "too short");
        goto done;
    }
    if (frames->is_flat) {
        OzBytes at = block + HEAD_BYTES;
        OZ_TRY(read_block(frames, at, OZ_FRAME_ELEMENTS_HEAD));
        oz_frame_elements_unpack_head(&at, &frames->elements);
    }
    if (!counts_are_possible(frames)) {
        status = refuse(frames, "damaged: impossible number of grains or walls");
    } else if (static_bytes(frames) > size) {
        status = refuse(frames, "cut short or damaged before its first frame");
    }
done:
    return status;
}

static bool grain_is_sound(const OzGrains *grains, int64_t i)
{
    double diameter = grains->diameter[i], length = grains->length[i], mass = grains->mass[i];
    return diameter > 0 && diameter < 1e30 && length >= 0 && length < 1e30 && mass > 0 &&
           mass < 1e30 && grains->population[i] >= 0;
}

static OzStatus unpack_grains(const OzFrames *frames, OzGrains *grains, OzBytes *from)
{
    OzStatus status = OZ_OK;
    size_t column = (size_t)frames->count * sizeof(double);
    OZ_TRY(oz_grains_create(grains, frames->count));
    oz_bytes_unpack(from, grains->diameter, column);
    oz_bytes_unpack(from, grains->length, column);
    oz_bytes_unpack(from, grains->mass, column);
    for (int64_t i = 0; i < frames->count; i++) {
        int32_t population;
        oz_bytes_unpack(from, &population, sizeof population);
        grains->population[i] = population;
        if (!grain_is_sound(grains, i)) {
            status = refuse(frames, "damaged: impossible size or mass of a grain");
            goto done;
        }
        double mass = grains->mass[i];
        oz_grains_set_mass(grains, i,
                           mass / oz_grains_volume(grains->diameter[i], grains->length[i]));
        grains->mass[i] = mass; /* the value itself, not its rounded product */
        grains->quaternion[4 * i] = 1;
    }
done:
    return status;
}

static OzStatus unpack_elements(const OzFrames *frames, OzGrains *grains, OzBytes *from)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_elements_create(&grains->elements, &frames->elements));
    if (!oz_frame_elements_unpack_static(from, grains->elements)) {
        status = refuse(frames, "damaged: impossible elements of grains or walls");
    }
done:
    return status;
}

static OzStatus read_static(OzFrames *frames, OzGrains *grains)
{
    OzStatus status = OZ_OK;
    unsigned char head[HEAD_BYTES + OZ_FRAME_ELEMENTS_HEAD], *block = NULL;
    OZ_TRY(read_head(frames, head));
    size_t bytes = static_bytes(frames), known = head_bytes(frames);
    OZ_TRY(OZ_NEW(&block, bytes));
    memcpy(block, head, known);
    OZ_TRY(read_block(frames, block + known, bytes - known));
    if (!oz_bytes_is_sealed(block, bytes)) {
        status = refuse(frames, "damaged: the checksum of its grains is wrong");
        goto done;
    }
    OzBytes at = block + known;
    OZ_TRY(unpack_grains(frames, grains, &at));
    if (frames->is_flat) {
        OZ_TRY(unpack_elements(frames, grains, &at));
    }
done:
    free(block);
    return status;
}

OzStatus oz_frames_open(OzFrames **frames, const char *path, OzGrains *grains)
{
    OzStatus status = OZ_OK;
    memset(grains, 0, sizeof *grains);
    OZ_TRY(open_file(frames, path, "rb"));
    OZ_TRY(measure_file(*frames));
    OZ_TRY(read_static(*frames, grains));
    (*frames)->frame_bytes = frame_bytes(*frames);
    /* Without one whole frame none is ever read, and no room is needed for it. */
    if ((*frames)->frame_bytes <= (*frames)->left) {
        OZ_TRY(OZ_NEW(&(*frames)->frame, (*frames)->frame_bytes));
    }
done:
    if (status != OZ_OK) {
        oz_grains_free(grains);
        oz_frames_finish(*frames);
        *frames = NULL;
    }
    return status;
}

static void unpack_standing(OzBytes *at, OzSnapshot *snapshot)
{
    oz_bytes_unpack_floats(at, snapshot->position, 3 * snapshot->count);
    oz_bytes_unpack_floats(at, snapshot->quaternion, 4 * snapshot->count);
    oz_bytes_unpack_floats(at, snapshot->velocity, 3 * snapshot->count);
    memset(snapshot->angular_velocity, 0,
           (size_t)(3 * snapshot->count) * sizeof *snapshot->angular_velocity);
    oz_snapshot_turn_axes(snapshot);
}

static void unpack_frame(const OzFrames *frames, OzSnapshot *snapshot, int *purpose)
{
    uint32_t purposes[2];
    OzBytes at = frames->frame + sizeof(uint64_t);
    oz_bytes_unpack(&at, purposes, sizeof purposes);
    oz_bytes_unpack(&at, &snapshot->step, sizeof snapshot->step);
    oz_bytes_unpack(&at, &snapshot->time, sizeof snapshot->time);
    oz_bytes_unpack_floats(&at, snapshot->wall_offset, frames->wall_count);
    oz_bytes_unpack_floats(&at, snapshot->wall_velocity, frames->wall_count);
    if (frames->is_flat) {
        oz_frame_elements_unpack(&at, snapshot);
    } else {
        unpack_standing(&at, snapshot);
    }
    snapshot->has_contacts = snapshot->has_ledger = false;
    *purpose = (int)purposes[0];
}

OzStatus oz_frames_next(OzFrames *frames, OzSnapshot *snapshot, int *purpose, bool *more)
{
    OzStatus status = OZ_OK;
    uint64_t bytes = 0;
    *more = false;
    int64_t elements = frames->elements.free_elements + frames->elements.wall_elements;
    if (snapshot->count != frames->count || snapshot->scene->wall_count != frames->wall_count ||
        snapshot->element_count != elements) {
        return oz_status_fail(
            OZ_ERR_INPUT,
            "%s holds %lld grains, %d walls and %lld elements, the scene %lld, %d "
            "and %lld",
            frames->path, (long long)frames->count, frames->wall_count, (long long)elements,
            (long long)snapshot->count, snapshot->scene->wall_count,
            (long long)snapshot->element_count);
    }
    if (frames->frame_bytes > frames->left) {
        return OZ_OK;
    }
    OZ_TRY(read_block(frames, frames->frame, frames->frame_bytes));
    memcpy(&bytes, frames->frame, sizeof bytes);
    if (bytes != frames->frame_bytes || !oz_bytes_is_sealed(frames->frame, frames->frame_bytes)) {
        status = oz_status_fail(OZ_ERR_INPUT, "%s: frame %lld is damaged", frames->path,
                                (long long)frames->frame_number);
        goto done;
    }
    frames->frame_number++;
    unpack_frame(frames, snapshot, purpose);
    *more = true;
done:
    return status;
}
