/* frames.bin, written and read. Each block is packed into one buffer and written in one go; reading
 * trusts nothing of a file before its checksum. Knows nothing of pictures. */
#include "observe/frames.h"

#include "base/memory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char MAGIC[8] = "ozframes";
enum {
    BYTE_ORDER_MARK = 0x01020304,
    FORMAT_VERSION = 1,
    HEAD_BYTES = 32,
    GRAIN_BYTES = 3 * 8 + 4, /* diameter, length, mass, population                     */
    FRAME_HEAD_BYTES = 32,
    FRAME_GRAIN_BYTES = 4 * (3 + 4 + 3), /* position, quaternion, velocity                     */
    FRAME_WALL_BYTES = 4 * 2, /* offset, velocity                                       */
    CHECKSUM_BYTES = 8,
    COUNT_MAX = 1 << 30 /* grains, walls: sizes computed from them cannot overflow */
};

struct OzFrames {
    FILE *file;
    char *path;
    int64_t count;
    int wall_count;
    size_t frame_bytes;
    unsigned char *frame; /* room for one frame                            */
    size_t left;          /* reading: bytes of the file not yet read       */
    int64_t frame_number; /* reading: frames given so far                  */
};

/* A place in a block of bytes that moves on as values are packed or unpacked. */
typedef unsigned char *Cursor;

static void pack(Cursor *at, const void *value, size_t bytes)
{
    memcpy(*at, value, bytes);
    *at += bytes;
}

static void unpack(Cursor *at, void *value, size_t bytes)
{
    memcpy(value, *at, bytes);
    *at += bytes;
}

static void pack_floats(Cursor *at, const double *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        float value = (float)values[i];
        pack(at, &value, sizeof value);
    }
}

static void unpack_floats(Cursor *at, double *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        float value;
        unpack(at, &value, sizeof value);
        values[i] = (double)value;
    }
}

/* FNV-1a (Fowler, Noll, Vo): any single changed byte changes it. */
static uint64_t checksum(const unsigned char *bytes, size_t length)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < length; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    }
    return hash;
}

static void seal(unsigned char *block, size_t bytes)
{
    uint64_t sum = checksum(block, bytes - CHECKSUM_BYTES);
    memcpy(block + bytes - CHECKSUM_BYTES, &sum, sizeof sum);
}

static bool is_sealed(const unsigned char *block, size_t bytes)
{
    uint64_t sum = checksum(block, bytes - CHECKSUM_BYTES);
    return memcmp(block + bytes - CHECKSUM_BYTES, &sum, sizeof sum) == 0;
}

static size_t static_bytes(int64_t count)
{
    return HEAD_BYTES + (size_t)count * GRAIN_BYTES + CHECKSUM_BYTES;
}

static size_t frame_bytes(int64_t count, int wall_count)
{
    return FRAME_HEAD_BYTES + (size_t)count * FRAME_GRAIN_BYTES +
           (size_t)wall_count * FRAME_WALL_BYTES + CHECKSUM_BYTES;
}

static OzStatus refuse(const OzFrames *frames, const char *why)
{
    return oz_status_fail(OZ_ERR_INPUT, "%s: %s; expected a frames.bin of orzo, version %d",
                          frames->path, why, FORMAT_VERSION);
}

static OzStatus write_block(OzFrames *frames, unsigned char *block, size_t bytes)
{
    seal(block, bytes);
    if (fwrite(block, 1, bytes, frames->file) != bytes || fflush(frames->file) != 0) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", frames->path, strerror(errno));
    }
    return OZ_OK;
}

static OzStatus write_static(OzFrames *frames, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    unsigned char *block = NULL;
    uint32_t marks[2] = {BYTE_ORDER_MARK, FORMAT_VERSION};
    uint32_t walls[2] = {(uint32_t)frames->wall_count, 0};
    size_t bytes = static_bytes(frames->count), column = (size_t)frames->count * sizeof(double);
    OZ_TRY(OZ_NEW(&block, bytes));
    Cursor at = block;
    pack(&at, MAGIC, sizeof MAGIC);
    pack(&at, marks, sizeof marks);
    pack(&at, &frames->count, sizeof frames->count);
    pack(&at, walls, sizeof walls);
    pack(&at, grains->diameter, column);
    pack(&at, grains->length, column);
    pack(&at, grains->mass, column);
    for (int64_t i = 0; i < frames->count; i++) {
        int32_t population = (int32_t)grains->population[i];
        pack(&at, &population, sizeof population);
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

OzStatus oz_frames_create(OzFrames **frames, const char *path, const OzScene *scene,
                          const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    OZ_TRY(open_file(frames, path, "wb"));
    (*frames)->count = grains->count;
    (*frames)->wall_count = scene->wall_count;
    (*frames)->frame_bytes = frame_bytes(grains->count, scene->wall_count);
    OZ_TRY(OZ_NEW(&(*frames)->frame, (*frames)->frame_bytes));
    OZ_TRY(write_static(*frames, grains));
done:
    if (status != OZ_OK) {
        oz_frames_finish(*frames);
        *frames = NULL;
    }
    return status;
}

OzStatus oz_frames_add(OzFrames *frames, const OzSnapshot *snapshot, int purpose)
{
    uint64_t bytes = frames->frame_bytes;
    uint32_t purposes[2] = {(uint32_t)purpose, 0};
    Cursor at = frames->frame;
    pack(&at, &bytes, sizeof bytes);
    pack(&at, purposes, sizeof purposes);
    pack(&at, &snapshot->step, sizeof snapshot->step);
    pack(&at, &snapshot->time, sizeof snapshot->time);
    pack_floats(&at, snapshot->wall_offset, frames->wall_count);
    pack_floats(&at, snapshot->wall_velocity, frames->wall_count);
    pack_floats(&at, snapshot->position, 3 * frames->count);
    pack_floats(&at, snapshot->quaternion, 4 * frames->count);
    pack_floats(&at, snapshot->velocity, 3 * frames->count);
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
    if (!S_ISREG(info.st_mode) || info.st_size < HEAD_BYTES + CHECKSUM_BYTES) {
        return refuse(frames, S_ISREG(info.st_mode) ? "too short" : "not a file");
    }
    frames->left = (size_t)info.st_size;
    return OZ_OK;
}

/* Reads the head into block and checks that the grains it promises are there. */
static OzStatus read_head(OzFrames *frames, unsigned char block[HEAD_BYTES])
{
    OzStatus status = OZ_OK;
    char magic[sizeof MAGIC];
    uint32_t marks[2], walls[2];
    size_t size = frames->left;
    OZ_TRY(read_block(frames, block, HEAD_BYTES));
    Cursor at = block;
    unpack(&at, magic, sizeof magic);
    unpack(&at, marks, sizeof marks);
    unpack(&at, &frames->count, sizeof frames->count);
    unpack(&at, walls, sizeof walls);
    if (memcmp(magic, MAGIC, sizeof MAGIC) != 0) {
        status = refuse(frames, "not a file of frames");
    } else if (marks[0] != BYTE_ORDER_MARK) {
        status = refuse(frames, "written on a machine with another byte order");
    } else if (marks[1] != FORMAT_VERSION) {
        status = refuse(frames, "another version of the format");
    } else if (frames->count < 0 || frames->count > COUNT_MAX || walls[0] > COUNT_MAX) {
        status = refuse(frames, "damaged: impossible number of grains or walls");
    } else if (static_bytes(frames->count) > size) {
        status = refuse(frames, "cut short or damaged before its first frame");
    }
    frames->wall_count = (int)walls[0];
done:
    return status;
}

static bool grain_is_sound(const OzGrains *grains, int64_t i)
{
    double diameter = grains->diameter[i], length = grains->length[i], mass = grains->mass[i];
    return diameter > 0 && diameter < 1e30 && length >= 0 && length < 1e30 && mass > 0 &&
           mass < 1e30 && grains->population[i] >= 0;
}

static OzStatus unpack_grains(const OzFrames *frames, OzGrains *grains, Cursor at)
{
    OzStatus status = OZ_OK;
    size_t column = (size_t)frames->count * sizeof(double);
    OZ_TRY(oz_grains_create(grains, frames->count));
    unpack(&at, grains->diameter, column);
    unpack(&at, grains->length, column);
    unpack(&at, grains->mass, column);
    for (int64_t i = 0; i < frames->count; i++) {
        int32_t population;
        unpack(&at, &population, sizeof population);
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

static OzStatus read_static(OzFrames *frames, OzGrains *grains)
{
    OzStatus status = OZ_OK;
    unsigned char head[HEAD_BYTES], *block = NULL;
    OZ_TRY(read_head(frames, head));
    size_t bytes = static_bytes(frames->count);
    OZ_TRY(OZ_NEW(&block, bytes));
    memcpy(block, head, HEAD_BYTES);
    OZ_TRY(read_block(frames, block + HEAD_BYTES, bytes - HEAD_BYTES));
    if (!is_sealed(block, bytes)) {
        status = refuse(frames, "damaged: the checksum of its grains is wrong");
        goto done;
    }
    OZ_TRY(unpack_grains(frames, grains, block + HEAD_BYTES));
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
    (*frames)->frame_bytes = frame_bytes((*frames)->count, (*frames)->wall_count);
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

static void unpack_frame(const OzFrames *frames, OzSnapshot *snapshot, int *purpose)
{
    uint32_t purposes[2];
    Cursor at = frames->frame + sizeof(uint64_t);
    unpack(&at, purposes, sizeof purposes);
    unpack(&at, &snapshot->step, sizeof snapshot->step);
    unpack(&at, &snapshot->time, sizeof snapshot->time);
    unpack_floats(&at, snapshot->wall_offset, frames->wall_count);
    unpack_floats(&at, snapshot->wall_velocity, frames->wall_count);
    unpack_floats(&at, snapshot->position, 3 * frames->count);
    unpack_floats(&at, snapshot->quaternion, 4 * frames->count);
    unpack_floats(&at, snapshot->velocity, 3 * frames->count);
    memset(snapshot->spin, 0, (size_t)(3 * frames->count) * sizeof *snapshot->spin);
    snapshot->has_contacts = snapshot->has_ledger = false;
    oz_snapshot_turn_axes(snapshot);
    *purpose = (int)purposes[0];
}

OzStatus oz_frames_next(OzFrames *frames, OzSnapshot *snapshot, int *purpose, bool *more)
{
    OzStatus status = OZ_OK;
    uint64_t bytes = 0;
    *more = false;
    if (snapshot->count != frames->count || snapshot->scene->wall_count != frames->wall_count) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s holds %lld grains and %d walls, the scene %lld and %d",
                              frames->path, (long long)frames->count, frames->wall_count,
                              (long long)snapshot->count, snapshot->scene->wall_count);
    }
    if (frames->frame_bytes > frames->left) {
        return OZ_OK;
    }
    OZ_TRY(read_block(frames, frames->frame, frames->frame_bytes));
    memcpy(&bytes, frames->frame, sizeof bytes);
    if (bytes != frames->frame_bytes || !is_sealed(frames->frame, frames->frame_bytes)) {
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
