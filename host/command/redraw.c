/* Drawing again from frames.bin, with the run's scene.yaml and other settings over it. The file is
 * read twice: for its times, which decide what is drawn, and for the states. */
#include "command/redraw.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "command/redraw_plan.h"
#include "draw/pictures.h"
#include "observe/frame_reader.h"
#include "run/inputs.h"

#include <stdlib.h>
#include <string.h>

typedef struct Redraw {
    OzScene run, scene; /* as it was run, and with the settings */
    OzGrains grains;
    OzSnapshot snapshot;
    OzFrames *frames;
    OzRedrawPlan plan;
    OzPictures *pictures;
    OzPicturesSettings settings;
    OzInputs inputs;
    OzFolder read;  /* the run's, which nobody may change meanwhile */
    OzFolder owned; /* out, in use                                  */
    char *scene_path, *frames_path, *out;
    double started; /* wall clock */
} Redraw;

/* Takes the folder that pictures go to, which must not be the run's own. Earlier pictures there go.
 */
static OzStatus own_folder(Redraw *r)
{
    static const char *const writes[] = {"movie.mp4", "movie.mp4.part", "movie.mp4.new",
                                         "snapshots/*.png*", NULL};
    OzFolderUse use = {.writes = writes};
    OZ_PASS(oz_inputs_add(&r->inputs, r->frames_path));
    OZ_PASS(oz_inputs_add_scene(&r->inputs, &r->scene));
    OZ_PASS(oz_inputs_check(&r->inputs, r->out, &use));
    return oz_folder_open(&r->owned, r->out, &use);
}

/* The keys that pictures depend on and the simulation does not, with all below them. */
static bool is_of_pictures(const char *setting)
{
    static const char *const names[] = {"title", "movie", "snapshots"};
    size_t length = strcspn(setting, ".=");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strlen(names[i]) == length && strncmp(names[i], setting, length) == 0) {
            return true;
        }
    }
    return false;
}

static OzStatus refuse_physics(const OzOptions *options)
{
    char names[1024] = "";
    size_t used = 0;
    for (int i = 0; i < options->setting_count; i++) {
        const char *setting = options->settings[i];
        if (!is_of_pictures(setting) && used < sizeof names) {
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%.*s", used ? ", " : "",
                                     (int)strcspn(setting, "="), setting);
        }
    }
    return used == 0
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INPUT,
                                "--set %s: frames that are stored cannot be changed; expected "
                                "title, or a key of movie or snapshots (or another `orzo run`)",
                                names);
}

/* A scene without a title is called after the run's folder: every run's own file is scene.yaml. */
static OzStatus take_name(OzScene *scene, const char *folder)
{
    char *real = realpath(folder, NULL);
    const char *slash = real ? strrchr(real, '/') : NULL;
    OzStatus status = OZ_OK;
    if (slash && slash[1]) {
        free(scene->name);
        status = oz_memory_text(&scene->name, slash + 1);
    }
    free(real);
    return status;
}

/* The scene as it was run, and with the settings. `movie=false` leaves the movie out but not how it
 * looks, which is how single pictures look too. */
static OzStatus load_scenes(Redraw *r, const OzOptions *options)
{
    char *settings[OZ_CLI_SETTINGS_MAX];
    int count = 0;
    for (int i = 0; i < options->setting_count; i++) {
        if (strcmp(options->settings[i], "movie=false") != 0) {
            settings[count++] = options->settings[i];
        }
    }
    OZ_PASS(oz_scene_load(&r->run, r->scene_path, NULL, 0));
    OZ_PASS(oz_scene_load(&r->scene, r->scene_path, settings, count));
    OZ_PASS(refuse_physics(options));
    r->scene.movie.present &= count == options->setting_count;
    return take_name(&r->scene, options->paths[0]);
}

/* From the first frame on. */
static OzStatus open_frames(Redraw *r)
{
    oz_frames_finish(r->frames);
    r->frames = NULL;
    oz_snapshot_free(&r->snapshot);
    oz_grains_free(&r->grains);
    OzStatus status = oz_frame_reader_open(&r->frames, r->frames_path, &r->grains);
    return status == OZ_OK ? oz_snapshot_create(&r->snapshot, &r->scene, &r->grains) : status;
}

/* Frames without contacts would be drawn as if nothing touched. */
static OzStatus check_contacts(const Redraw *r)
{
    if (r->snapshot.has_contacts || !oz_scene_shows_contacts(&r->scene)) {
        return OZ_OK;
    }
    return oz_status_fail(
        OZ_ERR_INPUT,
        "%s has no contacts, of which these pictures show something; expected the "
        "frames of a run that was told so (orzo run SCENE --set movie.chains=true)",
        r->frames_path);
}

static OzStatus make_plan(Redraw *r)
{
    int purpose = 0;
    bool more = true;
    OZ_PASS(open_frames(r));
    for (;;) {
        OZ_PASS(oz_frame_reader_next(r->frames, &r->snapshot, &purpose, &more));
        if (!more) {
            break;
        }
        if (r->plan.count == 0) {
            OZ_PASS(check_contacts(r));
        }
        OZ_PASS(oz_redraw_plan_note(&r->plan, r->snapshot.time, purpose));
    }
    OZ_PASS(oz_redraw_plan_choose(&r->plan, &r->run, &r->scene));
    return open_frames(r);
}

static OzStatus open_all(Redraw *r, const OzOptions *options)
{
    const char *folder = options->paths[0];
    OZ_PASS(oz_folder_read(&r->read, folder));
    OZ_PASS(oz_file_join(&r->scene_path, folder, "scene.yaml"));
    OZ_PASS(oz_file_join(&r->frames_path, folder, "frames.bin"));
    OZ_PASS(options->out ? oz_file_join(&r->out, NULL, options->out)
                         : oz_file_join(&r->out, folder, "draw"));
    OZ_PASS(load_scenes(r, options));
    OZ_PASS(make_plan(r));
    OZ_PASS(own_folder(r));
    r->settings = (OzPicturesSettings){.folder = r->out,
                                       .source_dir = options->source_dir,
                                       .backend = options->gl,
                                       .device = "drawn from frames.bin"};
    return oz_pictures_create(&r->pictures, &r->settings, &r->scene);
}

static void show_progress(const Redraw *r, int64_t count, int64_t total)
{
    double left = (oz_clock_now() - r->started) * (double)(total - count) / (double)count;
    oz_log_progress("frame %lld of %lld, %.0f s left", (long long)count, (long long)total, left);
}

static OzStatus draw_frame(Redraw *r, const OzRedrawFrame *frame)
{
    OzStatus status = check_contacts(r);
    status = status == OZ_OK ? oz_pictures_add(r->pictures, &r->snapshot, frame->purpose) : status;
    for (int64_t i = 1; status == OZ_OK && i < frame->repeats; i++) {
        status = oz_pictures_repeat(r->pictures);
    }
    return status;
}

static OzStatus draw_all(Redraw *r)
{
    int64_t total = 0, count = 0;
    bool more = true;
    for (int64_t i = 0; i < r->plan.count; i++) {
        total += r->plan.frames[i].purpose != 0;
    }
    r->started = oz_clock_now();
    for (int64_t i = 0; i < r->plan.count && count < total; i++) {
        int stored = 0;
        OZ_PASS(oz_frame_reader_next(r->frames, &r->snapshot, &stored, &more));
        if (!more) {
            break; /* the file became shorter meanwhile */
        }
        if (i == 0 || i == r->plan.settling) { /* as the run did */
            oz_pictures_frame(r->pictures, &r->snapshot, i < r->plan.settling);
        }
        if (r->plan.frames[i].purpose) {
            OZ_PASS(draw_frame(r, &r->plan.frames[i]));
            show_progress(r, ++count, total);
        }
    }
    oz_log_progress(" ");
    oz_log_line("%lld frames drawn into %s", (long long)count, r->out);
    return OZ_OK;
}

OzStatus oz_redraw_folder(const OzOptions *options)
{
    OzStatus status = OZ_OK;
    Redraw r = {0};
    OZ_TRY(open_all(&r, options));
    OZ_TRY(draw_all(&r));
done:;
    OzStatus closed = oz_pictures_finish(r.pictures);
    status = status == OZ_OK ? closed : status;
    oz_frames_finish(r.frames);
    oz_inputs_free(&r.inputs);
    oz_folder_close(&r.owned);
    oz_folder_close(&r.read);
    oz_redraw_plan_free(&r.plan);
    oz_snapshot_free(&r.snapshot);
    oz_grains_free(&r.grains);
    oz_scene_free(&r.scene);
    oz_scene_free(&r.run);
    free(r.scene_path);
    free(r.frames_path);
    free(r.out);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
