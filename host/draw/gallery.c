/* Movie and snapshots of a run. */
#include "draw/gallery.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "draw/framing.h"
#include "draw/movie.h"
#include "draw/picture_name.h"
#include "draw/tryout.h"
#include "observe/frames.h"

#include <stdio.h>
#include <stdlib.h>

struct OzGallery {
    const OzGallerySettings *settings;
    const OzScene *scene;
    OzRenderer *renderer; /* owned unless shared */
    OzLook look, still;   /* of the movie, of single pictures */
    OzImage image, still_image;
    bool is_framed;
    int decimals; /* of single pictures' names */
    OzMovie *movie;
    OzSnapshot *states; /* for the strobe */
    int state_count;
    double drawing, encoding;
};

/* What is drawn on trial. */
typedef struct Trial {
    OzGallery *gallery;
    const OzSnapshot *snapshot;
} Trial;

OzStatus oz_gallery_create(OzGallery **gallery, const OzGallerySettings *settings,
                           const OzScene *scene)
{
    OzStatus status = OZ_NEW(gallery, 1);
    if (status == OZ_OK) {
        (*gallery)->settings = settings;
        (*gallery)->scene = scene;
        (*gallery)->decimals = oz_picture_name_decimals(scene);
    }
    return status;
}

/* A renderer of its own, or the shared one, made if this is the first to need it. */
static OzStatus open_renderer(OzGallery *gallery)
{
    OzRenderer **shared = gallery->settings->renderer;
    gallery->renderer = shared ? *shared : NULL;
    if (!gallery->renderer) {
        OZ_PASS(oz_renderer_create(&gallery->renderer, gallery->settings->backend,
                                   gallery->settings->source_dir));
        oz_log_line("drawing with %s", oz_renderer_name(gallery->renderer));
    }
    if (shared) {
        *shared = gallery->renderer;
    }
    return OZ_OK;
}

void oz_gallery_frame(OzGallery *gallery, const OzSnapshot *snapshot)
{
    gallery->look = oz_renderer_look(gallery->scene, snapshot);
    gallery->still = oz_framing_still(gallery->scene, &gallery->look);
    gallery->is_framed = true;
}

/* Whether a single picture is the movie's frame of the same moment. */
static bool looks_are_one(const OzGallery *gallery)
{
    const OzLook *a = &gallery->look, *b = &gallery->still;
    return a->width == b->width && a->height == b->height && a->colour == b->colour &&
           a->view_count == b->view_count && a->views[0] == b->views[0] &&
           (a->view_count < 2 || a->views[1] == b->views[1]);
}

static OzStatus open_movie(OzGallery *gallery)
{
    OzStatus status = OZ_OK;
    char *path = NULL, seed[32];
    const char *title = gallery->scene->title ? gallery->scene->title : gallery->scene->name;
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)gallery->scene->seed);
    const char *metadata[] = {"title",
                              title,
                              "comment",
                              "made by orzo " ORZO_VERSION,
                              "orzo_version",
                              ORZO_VERSION,
                              "device",
                              gallery->settings->device,
                              "renderer",
                              oz_renderer_name(gallery->renderer),
                              "seed",
                              seed,
                              NULL};
    OZ_TRY(oz_folder_note(gallery->settings->folder, "movie.mp4"));
    OZ_TRY(oz_folder_note(gallery->settings->folder, "movie.mp4.part"));
    OZ_TRY(oz_file_join(&path, gallery->settings->folder, "movie.mp4"));
    OZ_TRY(oz_movie_create(&gallery->movie, path, gallery->look.width, gallery->look.height,
                           gallery->scene->movie.fps, metadata));
done:
    free(path);
    return status;
}

static OzStatus add_to_movie(OzGallery *gallery)
{
    OzStatus status = OZ_OK;
    double start = oz_clock_now();
    if (!gallery->movie) {
        OZ_TRY(open_movie(gallery));
    }
    OZ_TRY(oz_movie_add(gallery->movie, &gallery->image));
done:
    gallery->encoding += oz_clock_now() - start;
    return status;
}

/* Notes snapshots/<name>, and the name under which it is written first. */
static OzStatus note_image(const OzGallery *gallery, const char *name)
{
    char noted[128];
    for (int part = 0; part < 2; part++) {
        snprintf(noted, sizeof noted, "snapshots/%s%s", name, part ? ".part" : "");
        OZ_PASS(oz_folder_note(gallery->settings->folder, noted));
    }
    return OZ_OK;
}

/* As snapshots/<name>. */
static OzStatus write_image(OzGallery *gallery, const OzImage *image, const char *name)
{
    OzStatus status = OZ_OK;
    char *folder = NULL, *path = NULL;
    OZ_TRY(note_image(gallery, name));
    OZ_TRY(oz_file_join(&folder, gallery->settings->folder, "snapshots"));
    OZ_TRY(oz_file_make_folder(folder));
    OZ_TRY(oz_file_join(&path, folder, name));
    OZ_TRY(oz_image_write_png(image, path));
done:
    free(folder);
    free(path);
    return status;
}

static OzStatus keep_state(OzGallery *gallery, const OzSnapshot *snapshot)
{
    if (gallery->state_count == OZ_GALLERY_STATES) {
        return OZ_OK;
    }
    if (!gallery->states) {
        OZ_PASS(OZ_NEW(&gallery->states, OZ_GALLERY_STATES));
    }
    OZ_PASS(oz_snapshot_copy(&gallery->states[gallery->state_count], snapshot));
    if (++gallery->state_count == OZ_GALLERY_STATES) {
        oz_log_line("strobe.png shows the first %d states, to %.6g s", OZ_GALLERY_STATES,
                    snapshot->time);
    }
    return OZ_OK;
}

/* States over each other (one is a plain picture) into an image, made at its first use. */
static OzStatus draw(OzGallery *gallery, const OzSnapshot *states, int count, const OzLook *look,
                     OzImage *image)
{
    OzStatus status = OZ_OK;
    double start = oz_clock_now();
    if (!image->pixels) {
        OZ_TRY(oz_image_create(image, look->width, look->height));
    }
    OZ_TRY(oz_renderer_draw_states(gallery->renderer, states, count, look, image));
done:
    gallery->drawing += oz_clock_now() - start;
    return status;
}

static OzStatus draw_strobe(OzGallery *gallery)
{
    OzLook look = gallery->still;
    look.strobe = gallery->scene->snapshots.strobe;
    if (gallery->state_count > 0) {
        OZ_PASS(draw(gallery, gallery->states, gallery->state_count, &look, &gallery->still_image));
        OZ_PASS(write_image(gallery, &gallery->still_image, "strobe.png"));
    }
    return OZ_OK;
}

static OzStatus add_picture(OzGallery *gallery, const OzSnapshot *snapshot, bool in_movie)
{
    OzImage *image = &gallery->still_image;
    char name[512];
    if (in_movie && looks_are_one(gallery)) {
        image = &gallery->image; /* it is drawn already */
    } else {
        OZ_PASS(draw(gallery, snapshot, 1, &gallery->still, image));
    }
    oz_picture_name_make(gallery->scene, snapshot->time, gallery->decimals, name, sizeof name);
    return write_image(gallery, image, name);
}

/* The first picture, and as much of a movie as an encoder takes to have all its memory, or all
 * there is time for. */
static OzStatus draw_on_trial(void *argument)
{
    enum { FRAMES = 30 };
    const double longest = 5; /* s */
    const Trial *trial = argument;
    OzGallery *gallery = trial->gallery;
    OZ_PASS(open_renderer(gallery));
    oz_gallery_frame(gallery, trial->snapshot);
    if (gallery->scene->snapshots.count > 0 && !looks_are_one(gallery)) {
        OZ_PASS(draw(gallery, trial->snapshot, 1, &gallery->still, &gallery->still_image));
    }
    OZ_PASS(draw(gallery, trial->snapshot, 1, &gallery->look, &gallery->image));
    double start = oz_clock_now();
    for (int i = 0; gallery->scene->movie.present && i < FRAMES; i++) {
        OZ_PASS(oz_clock_now() - start < longest ? add_to_movie(gallery) : OZ_OK);
    }
    return OZ_OK;
}

/* Before GL and the encoder are in this process, whether they would do. */
static OzStatus try_drawing(OzGallery *gallery, const OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    OzRenderer **shared = gallery->settings->renderer;
    char *part = NULL;
    Trial trial = {gallery, snapshot};
    if (shared && *shared) {
        return OZ_OK;
    }
    status = oz_tryout_run(draw_on_trial, &trial);
    if (gallery->scene->movie.present &&
        oz_file_join(&part, gallery->settings->folder, "movie.mp4.part") == OZ_OK) {
        remove(part); /* the trial's */
    }
    free(part);
    return status;
}

OzStatus oz_gallery_add(OzGallery *gallery, const OzSnapshot *snapshot, int purpose)
{
    double start = oz_clock_now();
    if (!gallery->renderer) {
        OZ_PASS(try_drawing(gallery, snapshot));
        OZ_PASS(open_renderer(gallery));
        gallery->drawing += oz_clock_now() - start;
    }
    if (!gallery->is_framed) {
        oz_gallery_frame(gallery, snapshot);
    }
    if (purpose & OZ_FRAME_MOVIE) {
        OZ_PASS(draw(gallery, snapshot, 1, &gallery->look, &gallery->image));
        OZ_PASS(add_to_movie(gallery));
    }
    if (purpose & OZ_FRAME_SNAPSHOT) {
        OZ_PASS(add_picture(gallery, snapshot, purpose & OZ_FRAME_MOVIE));
    }
    if (purpose & OZ_FRAME_STROBE) {
        OZ_PASS(keep_state(gallery, snapshot));
    }
    return OZ_OK;
}

OzStatus oz_gallery_repeat(OzGallery *gallery)
{
    return add_to_movie(gallery);
}

void oz_gallery_times(const OzGallery *gallery, double *drawing, double *encoding)
{
    *drawing = gallery->drawing;
    *encoding = gallery->encoding;
}

OzStatus oz_gallery_finish(OzGallery *gallery)
{
    if (!gallery) {
        return OZ_OK;
    }
    OzStatus drawn = draw_strobe(gallery);
    OzStatus status = oz_movie_finish(gallery->movie);
    status = status == OZ_OK ? drawn : status;
    for (int i = 0; i < gallery->state_count; i++) {
        oz_snapshot_free(&gallery->states[i]);
    }
    free(gallery->states);
    if (!gallery->settings->renderer) {
        oz_renderer_free(gallery->renderer);
    }
    oz_image_free(&gallery->image);
    oz_image_free(&gallery->still_image);
    free(gallery);
    return status;
}
