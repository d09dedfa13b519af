/* A movie in a folder of its own in a test, with states in files beside it, as one process leaves
 * them to another. */
#ifndef OZ_TESTS_MOVIE_PARTS_H
#define OZ_TESTS_MOVIE_PARTS_H

#include "movie_rig.h"

#include "run/state_file.h"

#include <signal.h>
#include <sys/wait.h>

static const char *const ENCODERS[] = {"libx264", "mpeg4"};

static inline void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

/* Paths that do not share memory. */
static inline const char *movie_path(void)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/movie.mp4", folder);
    return path;
}

static inline const char *part_path(void)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/movie.mp4.part", folder);
    return path;
}

static inline bool is_left(const char *name)
{
    return oz_file_exists(in_folder(name));
}

static inline OzMovie *open_movie(const char *encoder)
{
    static const char *const metadata[] = {"title", "parts", "device", "none", NULL};
    OzMovie *movie = NULL;
    must(oz_movie_create_with(&movie, movie_path(), WIDTH, HEIGHT, FPS, metadata, encoder));
    return movie;
}

/* Frames first to last - 1, as far as they go. */
static inline OzStatus add_frames(OzMovie *movie, int first, int last)
{
    OzStatus status = OZ_OK;
    OzImage image = {WIDTH, HEIGHT, calloc(WIDTH * HEIGHT, 4)};
    for (int frame = first; frame < last && status == OZ_OK; frame++) {
        paint(&image, frame);
        status = oz_movie_add(movie, &image);
    }
    free(image.pixels);
    return status;
}

/* Saves or loads through a file, as another process would. */
static inline OzStatus visit_state(OzMovie **movie, const char *name, bool is_loading)
{
    OzStatus status = OZ_OK;
    OzState state = {0};
    OzStateVisit visit = is_loading ? oz_state_load(&state) : oz_state_save(&state);
    if (is_loading) {
        must(oz_state_file_read(&state, in_folder(name)));
    }
    status = oz_movie_state(movie, movie_path(), &visit);
    if (is_loading && status == OZ_OK) {
        must(oz_state_finish(&visit));
    } else if (!is_loading) {
        must(status);
        must(oz_state_file_write(&state, in_folder(name)));
    }
    oz_state_free(&state);
    return status;
}

static inline void save_state(OzMovie *movie, const char *name)
{
    must(visit_state(&movie, name, false));
}

static inline OzMovie *load_state(const char *name)
{
    OzMovie *movie = NULL;
    must(visit_state(&movie, name, true));
    return movie;
}

/* All but the last `torn` frames are one after another, each of its colour as far as the encoder
 * keeps it (test_movie.c). */
static inline int count_torn(const char *path, int torn)
{
    static Decoded decoded;
    decode(path, &decoded);
    av_dict_free(&decoded.metadata);
    assert_true(decoded.broken <= (torn > 0));
    for (int frame = 0; frame < decoded.frames - torn; frame++) {
        assert_int_equal(decoded.number[frame], frame);
        for (int k = 0; k < 3; k++) {
            int error = decoded.colour[frame][k] - PALETTE[frame / 10 % 5][k];
            if (abs(error) > 8) {
                fail_msg("frame %d channel %d is off by %d", frame, k, error);
            }
        }
    }
    assert_true(torn > 0 || decoded.uneven == 0);
    return decoded.frames;
}

static inline int count_frames(const char *path)
{
    return count_torn(path, 0);
}

static inline void remove_all(void)
{
    static const char *const names[] = {"movie.mp4", "movie.mp4.part", "movie.mp4.new", "early",
                                        "late",      "early.previous", "late.previous"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        remove(in_folder(names[i]));
    }
}

/* Where the file ends in the middle of frames that refer to each other, so many of the last ones
 * have gaps between them or are half a picture. */
enum { TORN = 4 };

/* The ends of the boxes of a file, in order; returns how many. */
static inline int find_ends(const char *path, int64_t *ends, int most)
{
    char *bytes = NULL;
    size_t length = 0, at = 0;
    int count = 0;
    must(oz_file_read(&bytes, &length, path));
    while (at + 8 <= length && count < most) {
        const unsigned char *size = (unsigned char *)bytes + at;
        at += (size_t)size[0] << 24 | (size_t)size[1] << 16 | (size_t)size[2] << 8 | size[3];
        ends[count++] = (int64_t)at;
    }
    assert_int_equal(at, length);
    free(bytes);
    return count;
}

static inline int remove_folder(void **state)
{
    (void)state;
    remove_all();
    return rmdir(folder);
}

#endif
