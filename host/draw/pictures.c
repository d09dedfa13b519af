/* Movie and snapshots of a run. */
#include "draw/pictures.h"

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

struct OzPictures {
    const OzPicturesSettings *settings;
    OzScene scene;
    OzRenderer *renderer; /* owned unless shared */
    OzLook look, still;   /* of the movie, of single pictures */
    OzImage image, still_image;
    bool settles; /* the last picture that a file depends on was of settling */
    bool is_framed;
    bool has_frame; /* perhaps before the looks are there: loaded */
    OzLook frame;   /* looks frame what it frames                 */
    int decimals;   /* of single pictures' names */
    OzMovie *movie;
    OzSnapshot *states; /* for the strobe */
    int state_count;
    double drawing, encoding;
    char caption[200]; /* of the movie, for so many more frames */
    int64_t caption_frames;
};

/* What is drawn on trial. */
typedef struct Trial {
    OzPictures *pictures;
    const OzSnapshot *snapshot;
} Trial;

OzStatus oz_pictures_create(OzPictures **pictures, const OzPicturesSettings *settings,
                            const OzScene *scene)
{
    OZ_PASS(OZ_NEW(pictures, 1));
    (*pictures)->settings = settings;
    (*pictures)->decimals = oz_picture_name_decimals(scene);
    OzStatus status = oz_scene_copy(&(*pictures)->scene, scene);
    if (status != OZ_OK) {
        oz_scene_free(&(*pictures)->scene);
        free(*pictures);
        *pictures = NULL;
    }
    return status;
}

/* A renderer of its own, or the shared one, made if this is the first to need it. */
static OzStatus open_renderer(OzPictures *pictures)
{
    OzRenderer **shared = pictures->settings->renderer;
    pictures->renderer = shared ? *shared : NULL;
    if (!pictures->renderer) {
        OZ_PASS(oz_renderer_create(&pictures->renderer, pictures->settings->backend,
                                   pictures->settings->source_dir));
        oz_log_line("drawing with %s", oz_renderer_name(pictures->renderer));
    }
    if (shared) {
        *shared = pictures->renderer;
    }
    return OZ_OK;
}

/* Time 0 comes, and pictures are framed anew, or the first ones are of settling. */
static void turn(OzPictures *pictures, bool settles)
{
    if (settles != pictures->settles) {
        pictures->is_framed = pictures->has_frame = false;
        pictures->settles = settles;
    }
}

void oz_pictures_frame(OzPictures *pictures, const OzSnapshot *snapshot, bool settles)
{
    turn(pictures, settles);
    pictures->look = oz_renderer_look(&pictures->scene, snapshot);
    if (pictures->has_frame) {
        oz_framing_keep(&pictures->look, &pictures->frame);
    }
    pictures->look.settles = settles;
    pictures->frame = pictures->look;
    pictures->has_frame = true;
    pictures->still = oz_framing_still(&pictures->scene, &pictures->look);
    pictures->is_framed = true;
}

/* Whether a single picture is the movie's frame of the same moment. */
static bool looks_are_one(const OzPictures *pictures)
{
    const OzLook *a = &pictures->look, *b = &pictures->still;
    return a->width == b->width && a->height == b->height && a->colour == b->colour &&
           a->view_count == b->view_count && a->views[0] == b->views[0] &&
           (a->view_count < 2 || a->views[1] == b->views[1]);
}

/* The path of the movie, whose names are noted before there is one. */
static OzStatus claim_movie(char **path, const OzPictures *pictures)
{
    static const char *const names[] = {"movie.mp4", "movie.mp4.part", "movie.mp4.new"};
    for (int i = 0; i < 3; i++) {
        OZ_PASS(oz_folder_note(pictures->settings->folder, names[i]));
    }
    return oz_file_join(path, pictures->settings->folder, "movie.mp4");
}

static OzStatus open_movie(OzPictures *pictures)
{
    OzStatus status = OZ_OK;
    char *path = NULL, seed[32];
    const char *title = pictures->scene.title ? pictures->scene.title : pictures->scene.name;
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)pictures->scene.seed);
    const char *metadata[] = {"title",
                              title,
                              "comment",
                              "made by orzo " ORZO_VERSION,
                              "orzo_version",
                              ORZO_VERSION,
                              "device",
                              pictures->settings->device,
                              "renderer",
                              oz_renderer_name(pictures->renderer),
                              "seed",
                              seed,
                              NULL};
    OZ_TRY(claim_movie(&path, pictures));
    OZ_TRY(oz_movie_create(&pictures->movie, path, pictures->look.width, pictures->look.height,
                           pictures->scene.movie.fps, metadata));
done:
    free(path);
    return status;
}

static OzStatus add_to_movie(OzPictures *pictures)
{
    OzStatus status = OZ_OK;
    double start = oz_clock_now();
    if (!pictures->movie) {
        OZ_TRY(open_movie(pictures));
    }
    OZ_TRY(oz_movie_add(pictures->movie, &pictures->image));
done:
    pictures->encoding += oz_clock_now() - start;
    return status;
}

/* Notes snapshots/<name>, and the name under which it is written first. */
static OzStatus note_image(const OzPictures *pictures, const char *name)
{
    char noted[128];
    for (int part = 0; part < 2; part++) {
        snprintf(noted, sizeof noted, "snapshots/%s%s", name, part ? ".part" : "");
        OZ_PASS(oz_folder_note(pictures->settings->folder, noted));
    }
    return OZ_OK;
}

/* As snapshots/<name>. */
static OzStatus write_image(OzPictures *pictures, const OzImage *image, const char *name)
{
    OzStatus status = OZ_OK;
    char *folder = NULL, *path = NULL;
    OZ_TRY(note_image(pictures, name));
    OZ_TRY(oz_file_join(&folder, pictures->settings->folder, "snapshots"));
    OZ_TRY(oz_file_make_folder(folder));
    OZ_TRY(oz_file_join(&path, folder, name));
    OZ_TRY(oz_image_write_png(image, path));
done:
    free(folder);
    free(path);
    return status;
}

static OzStatus keep_state(OzPictures *pictures, const OzSnapshot *snapshot)
{
    if (pictures->state_count == OZ_PICTURES_STATES) {
        return OZ_OK;
    }
    if (!pictures->states) {
        OZ_PASS(OZ_NEW(&pictures->states, OZ_PICTURES_STATES));
    }
    OZ_PASS(oz_snapshot_copy(&pictures->states[pictures->state_count], snapshot));
    if (++pictures->state_count == OZ_PICTURES_STATES) {
        oz_log_line("strobe.png shows the first %d states, to %.6g s", OZ_PICTURES_STATES,
                    snapshot->time);
    }
    return OZ_OK;
}

/* States over each other (one is a plain picture) into an image, made at its first use. */
static OzStatus draw(OzPictures *pictures, const OzSnapshot *states, int count, const OzLook *look,
                     OzImage *image)
{
    OzStatus status = OZ_OK;
    double start = oz_clock_now();
    if (!image->pixels) {
        OZ_TRY(oz_image_create(image, look->width, look->height));
    }
    OZ_TRY(oz_renderer_draw_states(pictures->renderer, states, count, look, image));
done:
    pictures->drawing += oz_clock_now() - start;
    return status;
}

static OzStatus draw_strobe(OzPictures *pictures)
{
    OzLook look = pictures->still;
    look.strobe = pictures->scene.snapshots.strobe;
    if (pictures->state_count > 0) {
        OZ_PASS(
            draw(pictures, pictures->states, pictures->state_count, &look, &pictures->still_image));
        OZ_PASS(write_image(pictures, &pictures->still_image, "strobe.png"));
    }
    return OZ_OK;
}

static OzStatus add_picture(OzPictures *pictures, const OzSnapshot *snapshot, bool in_movie)
{
    OzImage *image = &pictures->still_image;
    char name[512];
    if (in_movie && looks_are_one(pictures)) {
        image = &pictures->image; /* it is drawn already */
    } else {
        OZ_PASS(draw(pictures, snapshot, 1, &pictures->still, image));
    }
    oz_picture_name_make(&pictures->scene, snapshot->time, pictures->decimals, name, sizeof name);
    return write_image(pictures, image, name);
}

/* The first picture, and as much of a movie as an encoder takes to have all its memory, or all
 * there is time for. */
static OzStatus draw_on_trial(void *argument)
{
    enum { FRAMES = 30 };
    const double longest = 5; /* s */
    const Trial *trial = argument;
    OzPictures *pictures = trial->pictures;
    OZ_PASS(open_renderer(pictures));
    oz_pictures_frame(pictures, trial->snapshot, pictures->settles);
    if (pictures->scene.snapshots.count > 0 && !looks_are_one(pictures)) {
        OZ_PASS(draw(pictures, trial->snapshot, 1, &pictures->still, &pictures->still_image));
    }
    OZ_PASS(draw(pictures, trial->snapshot, 1, &pictures->look, &pictures->image));
    double start = oz_clock_now();
    bool tries_movie = pictures->scene.movie.present && !pictures->movie; /* none that goes on */
    for (int i = 0; tries_movie && i < FRAMES; i++) {
        OZ_PASS(oz_clock_now() - start < longest ? add_to_movie(pictures) : OZ_OK);
    }
    return OZ_OK;
}

/* Before GL and the encoder are in this process, whether they would do. */
static OzStatus try_drawing(OzPictures *pictures, const OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    OzRenderer **shared = pictures->settings->renderer;
    char *part = NULL;
    Trial trial = {pictures, snapshot};
    if (shared && *shared) {
        return OZ_OK;
    }
    status = oz_tryout_run(draw_on_trial, &trial);
    if (pictures->scene.movie.present && !pictures->movie &&
        oz_file_join(&part, pictures->settings->folder, "movie.mp4.part") == OZ_OK) {
        remove(part); /* the trial's */
    }
    free(part);
    return status;
}

static void show(const OzPictures *pictures)
{
    const OzPicturesSettings *settings = pictures->settings;
    if (settings->live) {
        oz_live_show(settings->live, &pictures->image, pictures->scene.movie.fps, settings->folder);
    }
}

void oz_pictures_take(OzPictures *pictures, OzScene *next, const char *caption)
{
    const double seconds = 2;
    oz_scene_free(&pictures->scene);
    pictures->scene = *next;
    *next = (OzScene){0};
    pictures->is_framed = false;
    pictures->decimals = oz_picture_name_decimals(&pictures->scene);
    oz_image_free(&pictures->still_image); /* of another size, perhaps */
    if (caption[0]) {
        snprintf(pictures->caption, sizeof pictures->caption, "%s", caption);
        pictures->caption_frames = (int64_t)(seconds * pictures->scene.movie.fps);
    }
}

/* A frame of the movie (or, with 0, one beside it), with its caption while there is one. */
static OzStatus draw_frame(OzPictures *pictures, const OzSnapshot *snapshot, int frames)
{
    OzLook look = pictures->look;
    if (pictures->caption_frames > 0) {
        pictures->caption_frames -= frames;
        look.caption = pictures->caption;
    } else if (look.settles && pictures->scene.movie.captions) {
        look.caption = "settling";
    }
    return draw(pictures, snapshot, 1, &look, &pictures->image);
}

OzStatus oz_pictures_add(OzPictures *pictures, const OzSnapshot *added, int purpose)
{
    double start = oz_clock_now();
    OzSnapshot shown = *added; /* the same arrays */
    const OzSnapshot *snapshot = &shown;
    shown.scene = &pictures->scene;
    if (purpose & ~OZ_PICTURES_LIVE) {
        turn(pictures, purpose & OZ_FRAME_SETTLING);
    }
    if (!pictures->renderer) {
        OZ_PASS(try_drawing(pictures, snapshot));
        OZ_PASS(open_renderer(pictures));
        pictures->drawing += oz_clock_now() - start;
    }
    if (!pictures->is_framed) {
        oz_pictures_frame(pictures, snapshot, pictures->settles);
    }
    bool plain = pictures->caption_frames == 0;
    if (purpose & OZ_FRAME_MOVIE) {
        OZ_PASS(draw_frame(pictures, snapshot, 1));
        show(pictures);
        OZ_PASS(add_to_movie(pictures));
    }
    if (purpose & OZ_PICTURES_LIVE) {
        OZ_PASS(draw_frame(pictures, snapshot, 0));
        show(pictures);
    }
    if (purpose & OZ_FRAME_SNAPSHOT) {
        OZ_PASS(add_picture(pictures, snapshot, plain && purpose & OZ_FRAME_MOVIE));
    }
    if (purpose & OZ_FRAME_STROBE) {
        OZ_PASS(keep_state(pictures, snapshot));
    }
    return OZ_OK;
}

/* Loading makes the states, for these grains. */
static OzStatus strobe_state(OzPictures *pictures, const OzGrains *grains, OzStateVisit *visit)
{
    int64_t count = pictures->state_count;
    OZ_PASS(oz_state_index(visit, "strobe_count", &count, 0, OZ_PICTURES_STATES));
    if (!pictures->states && count > 0) {
        OZ_PASS(OZ_NEW(&pictures->states, OZ_PICTURES_STATES));
    }
    for (int64_t i = 0; i < count; i++) {
        if (i == pictures->state_count) {
            OZ_PASS(oz_snapshot_create(&pictures->states[i], &pictures->scene, grains));
            pictures->state_count++;
        }
        oz_state_enter_one(visit, "strobe", i);
        OZ_PASS(oz_snapshot_state(&pictures->states[i], visit));
        oz_state_leave(visit);
    }
    return OZ_OK;
}

/* Loading takes up the movie that is there. */
static OzStatus movie_state(OzPictures *pictures, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, pictures->settings->folder, "movie.mp4"));
    OZ_TRY(oz_movie_state(&pictures->movie, path, visit));
done:
    free(path);
    return status;
}

static OzStatus caption_state(OzPictures *pictures, OzStateVisit *visit)
{
    OZ_PASS(oz_state_index(visit, "caption_frames", &pictures->caption_frames, 0, INT64_MAX));
    OZ_PASS(oz_state_items(visit, "caption", "text", OZ_STATE_BYTES, pictures->caption,
                           sizeof pictures->caption));
    pictures->caption[sizeof pictures->caption - 1] = '\0';
    return OZ_OK;
}

/* Loading takes the scene as it is now. */
static OzStatus scene_state(OzPictures *pictures, const OzScene *scene, const OzStateVisit *visit)
{
    if (!visit->is_loading) {
        return OZ_OK;
    }
    oz_scene_free(&pictures->scene);
    return oz_scene_copy(&pictures->scene, scene);
}

OzStatus oz_pictures_state(OzPictures *pictures, const OzSnapshot *now, OzStateVisit *visit)
{
    OZ_PASS(scene_state(pictures, now->scene, visit));
    OZ_PASS(oz_state_enter(visit, "pictures", 5));
    OZ_PASS(oz_state_bool(visit, "settles", &pictures->settles));
    OZ_PASS(oz_state_bool(visit, "has_frame", &pictures->has_frame));
    OZ_PASS(oz_framing_state(&pictures->frame, visit));
    OZ_PASS(caption_state(pictures, visit));
    OZ_PASS(strobe_state(pictures, oz_snapshot_whole(now), visit));
    OZ_PASS(movie_state(pictures, visit));
    oz_state_leave(visit);
    return OZ_OK;
}

OzStatus oz_pictures_repeat(OzPictures *pictures)
{
    return add_to_movie(pictures);
}

void oz_pictures_times(const OzPictures *pictures, double *drawing, double *encoding)
{
    *drawing = pictures->drawing;
    *encoding = pictures->encoding;
}

OzStatus oz_pictures_finish(OzPictures *pictures)
{
    if (!pictures) {
        return OZ_OK;
    }
    OzStatus status = draw_strobe(pictures);
    OZ_AFTER(status, oz_movie_finish(pictures->movie));
    if (pictures->settings->live && pictures->image.pixels) {
        oz_live_end(pictures->settings->live, &pictures->image, pictures->settings->folder);
    }
    for (int i = 0; i < pictures->state_count; i++) {
        oz_snapshot_free(&pictures->states[i]);
    }
    free(pictures->states);
    if (!pictures->settings->renderer) {
        oz_renderer_free(pictures->renderer);
    }
    oz_image_free(&pictures->image);
    oz_image_free(&pictures->still_image);
    oz_scene_free(&pictures->scene);
    free(pictures);
    return status;
}
