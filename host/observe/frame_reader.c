/* Reads frames.bin. Trusts nothing of a file before its checksum. */
#include "observe/frame_reader.h"

#include "base/memory.h"
#include "observe/frames_private.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    OLD_RODS = 1, /* versions without angular velocities and contacts */
    OLD_FLAT = 2,
    COUNT_MAX = 1 << 30 /* grains, walls: sizes computed from them cannot overflow */
};

static OzStatus refuse(const OzFrames *frames, const char *why)
{
    return oz_status_fail(OZ_ERR_INPUT, "%s: %s; expected a frames.bin of orzo, version 1 to %d",
                          frames->path, why, OZ_FRAMES_FLAT);
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
    if (!S_ISREG(info.st_mode) || info.st_size < OZ_FRAMES_HEAD + OZ_BYTES_CHECKSUM) {
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
    char magic[sizeof OZ_FRAMES_MAGIC];
    uint32_t marks[2], walls[2];
    OZ_TRY(read_block(frames, block, OZ_FRAMES_HEAD));
    OzBytes at = block;
    oz_bytes_unpack(&at, magic, sizeof magic);
    oz_bytes_unpack(&at, marks, sizeof marks);
    oz_bytes_unpack(&at, &frames->count, sizeof frames->count);
    oz_bytes_unpack(&at, walls, sizeof walls);
    if (memcmp(magic, OZ_FRAMES_MAGIC, sizeof OZ_FRAMES_MAGIC) != 0) {
        status = refuse(frames, "not a file of frames");
    } else if (marks[0] != OZ_FRAMES_ORDER_MARK) {
        status = refuse(frames, "written on a machine with another byte order");
    } else if (marks[1] < OLD_RODS || marks[1] > OZ_FRAMES_BREAKABLE) {
        status = refuse(frames, "another version of the format");
    }
    frames->breaks = marks[1] == OZ_FRAMES_BREAKABLE;
    frames->is_flat = marks[1] == OLD_FLAT || marks[1] == OZ_FRAMES_FLAT || frames->breaks;
    frames->is_old = marks[1] <= OLD_FLAT;
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
        OzBytes at = block + OZ_FRAMES_HEAD;
        OZ_TRY(read_block(frames, at, OZ_FRAME_ELEMENTS_HEAD));
        oz_frame_elements_unpack_head(&at, &frames->elements);
    }
    if (!counts_are_possible(frames)) {
        status = refuse(frames, "damaged: impossible number of grains or walls");
    } else if (oz_frames_static_bytes(frames) > size) {
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
    size_t column = (size_t)frames->count * sizeof(double);
    OZ_PASS(oz_grains_create(grains, frames->count));
    oz_bytes_unpack(from, grains->diameter, column);
    oz_bytes_unpack(from, grains->length, column);
    oz_bytes_unpack(from, grains->mass, column);
    for (int64_t i = 0; i < frames->count; i++) {
        int32_t population;
        oz_bytes_unpack(from, &population, sizeof population);
        grains->population[i] = population;
        if (!grain_is_sound(grains, i)) {
            return refuse(frames, "damaged: impossible size or mass of a grain");
        }
        double mass = grains->mass[i];
        oz_grains_set_mass(grains, i,
                           mass / oz_grains_volume(grains->diameter[i], grains->length[i]));
        grains->mass[i] = mass; /* the value itself, not its rounded product */
        grains->quaternion[4 * i] = 1;
    }
    return OZ_OK;
}

static OzStatus unpack_elements(const OzFrames *frames, OzGrains *grains, OzBytes *from)
{
    OZ_PASS(oz_elements_create(&grains->elements, &frames->elements));
    if (!oz_frame_elements_unpack_static(from, grains->elements)) {
        return refuse(frames, "damaged: impossible elements of grains or walls");
    }
    return OZ_OK;
}

static OzStatus read_static(OzFrames *frames, OzGrains *grains)
{
    OzStatus status = OZ_OK;
    unsigned char head[OZ_FRAMES_HEAD + OZ_FRAME_ELEMENTS_HEAD], *block = NULL;
    OZ_TRY(read_head(frames, head));
    size_t bytes = oz_frames_static_bytes(frames), known = oz_frames_head_bytes(frames);
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

OzStatus oz_frame_reader_open(OzFrames **frames, const char *path, OzGrains *grains)
{
    OzStatus status = OZ_OK;
    memset(grains, 0, sizeof *grains);
    OZ_TRY(oz_frames_open_file(frames, path, "rb"));
    OZ_TRY(measure_file(*frames));
    OZ_TRY(read_static(*frames, grains));
    (*frames)->frame_bytes = oz_frames_frame_bytes(*frames);
done:
    if (status != OZ_OK) {
        oz_grains_free(grains);
        oz_frames_finish(*frames);
        *frames = NULL;
    }
    return status;
}

static void unpack_standing(const OzFrames *frames, OzBytes *at, OzSnapshot *snapshot)
{
    oz_bytes_unpack_floats(at, snapshot->position, 3 * snapshot->count);
    oz_bytes_unpack_floats(at, snapshot->quaternion, 4 * snapshot->count);
    oz_bytes_unpack_floats(at, snapshot->velocity, 3 * snapshot->count);
    memset(snapshot->angular_velocity, 0,
           (size_t)(3 * snapshot->count) * sizeof *snapshot->angular_velocity);
    if (!frames->is_old) {
        oz_bytes_unpack_floats(at, snapshot->angular_velocity, 3 * snapshot->count);
    }
    oz_snapshot_turn_axes(snapshot);
}

/* False for a contact of a grain or wall that there is not. */
static bool unpack_contact(const OzSnapshot *snapshot, OzBytes *at, OzContactEntry *e)
{
    int32_t whole[6];
    oz_bytes_unpack(at, whole, sizeof whole);
    *e = (OzContactEntry){
        .a = whole[0], .b = whole[1], .part_a = whole[2], .part_b = whole[3], .slips = whole[5]};
    oz_bytes_unpack_floats(at, e->point, 3);
    oz_bytes_unpack_floats(at, e->normal, 3);
    oz_bytes_unpack_floats(at, &e->push, 1);
    oz_bytes_unpack_floats(at, e->tangential, 3);
    oz_bytes_unpack_floats(at, &e->overlap, 1);
    if (whole[4] < 0 || whole[4] >= OZ_CONTACT_KINDS) {
        return false;
    }
    e->kind = (OzContactKind)whole[4];
    return e->a >= 0 && e->a < snapshot->count && e->b < snapshot->count &&
           e->b >= -snapshot->scene->wall_count;
}

/* bytes: of the frame. */
static OzStatus unpack_contacts(const OzFrames *frames, OzBytes *at, size_t bytes,
                                OzSnapshot *snapshot)
{
    int64_t count = 0, kept = (int64_t)((bytes - frames->frame_bytes) / OZ_FRAMES_CONTACT);
    oz_bytes_unpack(at, &count, sizeof count);
    bool sound = count == kept || (count == -1 && kept == 0);
    snapshot->contacts.count = 0;
    for (int64_t i = 0; i < kept && sound; i++) {
        OzContactEntry entry;
        sound = unpack_contact(snapshot, at, &entry);
        OZ_PASS(oz_contact_list_add(&snapshot->contacts, &entry));
    }
    snapshot->has_contacts = count >= 0;
    return sound ? OZ_OK : refuse(frames, "damaged: impossible contacts in a frame");
}

static OzStatus unpack_frame(const OzFrames *frames, size_t bytes, OzSnapshot *snapshot,
                             int *purpose)
{
    uint32_t purposes[2];
    OzBytes at = frames->frame + sizeof(uint64_t);
    oz_bytes_unpack(&at, purposes, sizeof purposes);
    oz_bytes_unpack(&at, &snapshot->step, sizeof snapshot->step);
    oz_bytes_unpack(&at, &snapshot->time, sizeof snapshot->time);
    oz_bytes_unpack_floats(&at, snapshot->wall_offset, frames->wall_count);
    oz_bytes_unpack_floats(&at, snapshot->wall_velocity, frames->wall_count);
    if (frames->is_flat) {
        oz_frame_elements_unpack(&at, snapshot, !frames->is_old);
        OZ_PASS(oz_frame_elements_unpack_wear(&at, snapshot, frames->breaks));
        oz_frame_elements_join(snapshot, !frames->is_old);
    } else {
        unpack_standing(frames, &at, snapshot);
    }
    snapshot->has_contacts = snapshot->has_ledger = false;
    *purpose = (int)purposes[0];
    snapshot->settling = *purpose & OZ_FRAME_SETTLING;
    return frames->is_old ? OZ_OK : unpack_contacts(frames, &at, bytes, snapshot);
}

/* Whether the scene's grains and walls are those of the file. */
static OzStatus check_counts(const OzFrames *frames, const OzSnapshot *snapshot)
{
    int64_t elements = frames->elements.free_elements + frames->elements.wall_elements;
    int64_t grains = oz_snapshot_whole(snapshot)->count;
    if (grains == frames->count && snapshot->scene->wall_count == frames->wall_count &&
        snapshot->element_count == elements && (snapshot->wear.whole || !frames->breaks)) {
        return OZ_OK;
    }
    if (!snapshot->wear.whole && frames->breaks) {
        return oz_status_fail(OZ_ERR_INPUT, "%s holds grains that break; expected beams.strength",
                              frames->path);
    }
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s holds %lld grains, %d walls and %lld elements, the scene %lld, %d "
                          "and %lld",
                          frames->path, (long long)frames->count, frames->wall_count,
                          (long long)elements, (long long)grains, snapshot->scene->wall_count,
                          (long long)snapshot->element_count);
}

static OzStatus refuse_frame(const OzFrames *frames)
{
    return oz_status_fail(OZ_ERR_INPUT, "%s: frame %lld is damaged", frames->path,
                          (long long)frames->frame_number);
}

/* The first bytes of a frame. */
typedef struct Start {
    uint64_t bytes;
    uint32_t purpose, check;
} Start;

static bool is_start_sound(const OzFrames *frames, const Start *start)
{
    uint64_t least = frames->frame_bytes;
    if (frames->is_old) {
        return start->bytes == least;
    }
    bool whole = start->bytes >= least && (start->bytes - least) % OZ_FRAMES_CONTACT == 0;
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION /* or a fuzzer would never get past this */
    return whole;
#endif
    return whole && start->check == oz_frames_check(start->bytes, start->purpose);
}

/* Reads the next frame whole into frames->frame; 0 bytes: there is none. */
static OzStatus read_frame(OzFrames *frames, size_t *bytes)
{
    Start start;
    *bytes = 0;
    if (frames->frame_bytes > frames->left) {
        return OZ_OK;
    }
    OZ_PASS(read_block(frames, (unsigned char *)&start, sizeof start));
    if (!is_start_sound(frames, &start)) {
        return refuse_frame(frames);
    }
    if (start.bytes - sizeof start > frames->left) {
        frames->left = 0; /* cut short by a crash */
        return OZ_OK;
    }
    OZ_PASS(oz_frames_make_room(frames, start.bytes));
    memcpy(frames->frame, &start, sizeof start);
    OZ_PASS(read_block(frames, frames->frame + sizeof start, start.bytes - sizeof start));
    *bytes = start.bytes;
    return oz_bytes_is_sealed(frames->frame, start.bytes) ? OZ_OK : refuse_frame(frames);
}

OzStatus oz_frame_reader_renew(OzFrames *frames)
{
    OZ_PASS(measure_file(frames));
    clearerr(frames->file);
    size_t read = (size_t)ftello(frames->file);
    frames->left -= read < frames->left ? read : frames->left;
    return OZ_OK;
}

OzStatus oz_frame_reader_next(OzFrames *frames, OzSnapshot *snapshot, int *purpose, bool *more)
{
    size_t bytes = 0;
    *more = false;
    OZ_PASS(check_counts(frames, snapshot));
    OZ_PASS(read_frame(frames, &bytes));
    if (bytes > 0) {
        OZ_PASS(unpack_frame(frames, bytes, snapshot, purpose));
        frames->frame_number++;
        *more = true;
    }
    return OZ_OK;
}
