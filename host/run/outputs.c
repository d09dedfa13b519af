/* One member's files. */
#include "run/outputs.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "export/export.h"
#include "observe/final.h"
#include "observe/schedule.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

OzFolderUse oz_outputs_use(bool overwrite)
{
    static const char *const writes[] = {"log.txt",
                                         "scene.yaml",
                                         "series.csv",
                                         "series.csv.part",
                                         "contacts.csv",
                                         "fields.csv",
                                         "fields_mean.csv",
                                         "fields/fields.p*",
                                         "fields/fields_*.vti",
                                         "frames.bin",
                                         "scene_final.yaml",
                                         "from.txt",
                                         "reloads.csv",
                                         "final.csv",
                                         "final.csv.part",
                                         "movie.mp4",
                                         "movie.mp4.part",
                                         "movie.mp4.new",
                                         "state*.h5",
                                         "state*.h5.part",
                                         "state*.h5.previous",
                                         "from/state*.h5*",
                                         "replay/*.csv",
                                         "checkpoints/*.h5*",
                                         "latest.png",
                                         "latest.png.part",
                                         "members.csv",
                                         "members.csv.part",
                                         "ensemble.csv",
                                         "ensemble.csv.part",
                                         "inclination_fit.csv",
                                         "inclination_spectrum.csv",
                                         "snapshots/tap_*.png*",
                                         "snapshots/time_*.png*",
                                         "snapshots/strobe.png*",
                                         "export/",
                                         "plot.png",
                                         "plot.svg",
                                         "series.png",
                                         NULL};
    static const char *const endings[] = {"final.csv", "members.csv", NULL};
    static const char *const results[] = {"series.csv",     "frames.bin",       "movie.mp4",
                                          "movie.mp4.part", "members.csv.part", NULL};
    return (OzFolderUse){
        .writes = writes, .endings = endings, .results = results, .overwrite = overwrite};
}

OzStatus oz_outputs_choose_folder(char **folder, const OzOptions *options, const char *name)
{
    OzStatus status = OZ_OK;
    char part[32], *whole = NULL;
    OZ_TRY(options->out ? oz_file_join(&whole, NULL, options->out)
                        : oz_file_join(&whole, "runs", name));
    snprintf(part, sizeof part, "part_%05d", options->part);
    OZ_TRY(
        oz_file_join(folder, options->parts > 0 ? whole : NULL, options->parts > 0 ? part : whole));
done:
    free(whole);
    return status;
}

/* The path of a file that is about to be made there; part: under another name first. */
static OzStatus claim(char **path, const char *folder, const char *name, const char *part)
{
    OZ_PASS(oz_file_join(path, folder, name));
    OZ_PASS(oz_folder_note(folder, name));
    return part ? oz_folder_note(folder, part) : OZ_OK;
}

static OzStatus write_scene(const OzScene *scene, const char *folder, const char *name)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    FILE *file = NULL;
    OZ_TRY(claim(&path, folder, name, NULL));
    file = fopen(path, "w");
    if (!file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
        goto done;
    }
    OZ_TRY(oz_scene_write(scene, file));
done:
    if (file && fclose(file) != 0 && status == OZ_OK) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    free(path);
    return status;
}

OzStatus oz_outputs_write_scene(const OzScene *scene, const char *folder)
{
    return write_scene(scene, folder, "scene.yaml");
}

static bool has_pictures(const OzScene *scene)
{
    return scene->movie.present || scene->snapshots.count > 0 || scene->snapshots.strobe > 0;
}

/* What the scene asks for, and what those see who look on. */
static OzStatus open_pictures(OzOutputs *o, const OzOptions *options, const char *device,
                              OzRenderQueue *render_queue)
{
    bool draws = has_pictures(&o->scene) && !options->no_video;
    bool has_movie = draws && o->scene.movie.present;
    bool is_looked_at = o->number == 0 && (options->stream || options->latest || options->serve);
    OzPicturesSettings settings = {.folder = o->folder,
                                   .source_dir = options->source_dir,
                                   .backend = options->gl,
                                   .device = device,
                                   .renderer = oz_render_queue_renderer(render_queue)};
    OzPicturesSettings shown = settings;
    shown.live = is_looked_at ? oz_render_queue_live(render_queue) : NULL;
    o->picture_settings = has_movie ? shown : settings;
    if (draws) {
        o->render_queue = render_queue;
        OZ_PASS(oz_pictures_create(&o->pictures, &o->picture_settings, &o->scene));
    }
    return is_looked_at ? oz_glances_open(&o->glances, render_queue, has_movie ? o->pictures : NULL,
                                          &shown, &o->scene)
                        : OZ_OK;
}

/* contacts.csv and fields.csv. */
static OzStatus open_tables(OzOutputs *o)
{
    OzStatus status = OZ_OK;
    char *contacts = NULL, *fields = NULL;
    if (o->scene.contacts.present) {
        OZ_TRY(claim(&contacts, o->folder, "contacts.csv", NULL));
        OZ_TRY((o->goes_on ? oz_contact_rows_go_on : oz_contact_rows_create)(&o->contact_rows,
                                                                             contacts));
    }
    if (o->scene.fields.present) {
        OZ_TRY(claim(&fields, o->folder, "fields.csv", NULL));
        OZ_TRY((o->goes_on ? oz_coarse_rows_go_on : oz_coarse_rows_create)(&o->fields, fields,
                                                                           &o->scene));
    }
    if (o->scene.fields.present && o->scene.fields.vtk) {
        OZ_TRY(oz_coarse_images_create(&o->field_images, o->folder));
    }
done:
    free(contacts);
    free(fields);
    return status;
}

OzStatus oz_outputs_open(OzOutputs *outputs, const OzOptions *options, const char *device,
                         OzRenderQueue *render_queue)
{
    OzStatus status = OZ_OK;
    char *series = NULL, *frames = NULL;
    const OzScene *scene = &outputs->scene;
    const OzGrains *grains = &outputs->grains;
    bool stores = has_pictures(scene) || scene->export_count > 0;
    outputs->is_open = true;
    if (outputs->name &&
        outputs->name[0]) { /* a plain run's folder is chosen, with its log in it */
        OzFolderUse use = oz_outputs_use(options->overwrite);
        use.keep = outputs->goes_on;
        OZ_TRY(oz_folder_open(&outputs->owned, outputs->folder, &use));
    }
    OZ_TRY(oz_snapshot_create(&outputs->now, scene, grains));
    if (!outputs->goes_on) {
        OZ_TRY(oz_outputs_write_scene(scene, outputs->folder));
    }
    OZ_TRY(claim(&outputs->final, outputs->folder, "final.csv", "final.csv.part"));
    OZ_TRY(oz_final_reserve(grains, outputs->final));
    OZ_TRY(claim(&series, outputs->folder, "series.csv", NULL));
    OZ_TRY((outputs->goes_on ? oz_series_go_on : oz_series_create)(&outputs->series, series, scene,
                                                                   grains));
    OZ_TRY(open_tables(outputs));
    OZ_TRY(oz_reload_log_create(&outputs->reloads, outputs->folder, outputs->goes_on));
    if (options->watch || isinf(scene->duration)) { /* whose end is noted nowhere else */
        OZ_TRY(oz_reload_log_begin(outputs->reloads));
    }
    if (stores) {
        OZ_TRY(claim(&frames, outputs->folder, "frames.bin", NULL));
        OZ_TRY((outputs->goes_on ? oz_frames_go_on : oz_frames_create)(&outputs->frames, frames,
                                                                       scene, grains));
    }
    OZ_TRY(open_pictures(outputs, options, device, render_queue));
done:
    free(series);
    free(frames);
    return status;
}

/* What pictures are due, in the frames' bits. */
static int purpose_of(int due)
{
    return (due & OZ_DUE_MOVIE ? OZ_FRAME_MOVIE : 0) |
           (due & OZ_DUE_SNAPSHOT ? OZ_FRAME_SNAPSHOT : 0) |
           (due & OZ_DUE_STROBE ? OZ_FRAME_STROBE : 0) |
           (due & OZ_DUE_SETTLING ? OZ_FRAME_MOVIE | OZ_FRAME_SETTLING : 0) |
           (due & OZ_DUE_EXPORT ? OZ_FRAME_EXPORT : 0);
}

/* Exports the frames that are stored by now and were not exported before: of a run that goes on,
 * all of them again. */
static OzStatus export_frames(OzOutputs *o)
{
    OzStatus status = OZ_OK;
    const char *replaces[OZ_EXPORT_REPLACES];
    char *frames = NULL;
    if (!o->exporter) {
        OzFolderUse use = oz_export_use(o->scene.exports, o->scene.export_count, replaces);
        OZ_TRY(oz_file_join(&frames, o->folder, "frames.bin"));
        OZ_TRY(oz_folder_note(o->folder, "export/"));
        free(o->export_folder);
        OZ_TRY(oz_file_join(&o->export_folder, o->folder, "export"));
        OZ_TRY(oz_folder_open(&o->exported, o->export_folder, &use));
        OZ_TRY(oz_export_open(&o->exporter, &(OzExportJob){.frames = frames,
                                                           .scene = &o->scene,
                                                           .folder = o->export_folder,
                                                           .kinds = o->scene.exports,
                                                           .kind_count = o->scene.export_count,
                                                           .purpose = OZ_FRAME_EXPORT,
                                                           .every = 1,
                                                           .grows = true}));
    }
    OZ_TRY(oz_export_follow(o->exporter));
done:
    free(frames);
    return status;
}

static OzStatus end_export(OzOutputs *o)
{
    int64_t count = 0;
    bool any = o->exporter != NULL;
    OzStatus status = oz_export_finish(o->exporter, &count);
    if (any && status == OZ_OK) {
        oz_log_line("%lld frames exported into %s", (long long)count, o->export_folder);
    }
    oz_folder_close(&o->exported);
    free(o->export_folder);
    o->export_folder = NULL;
    return status;
}

static OzStatus write_fields(OzOutputs *o)
{
    OZ_PASS(oz_coarse_rows_write(o->fields, &o->now));
    return o->field_images ? oz_coarse_images_add(o->field_images, o->fields, o->now.time) : OZ_OK;
}

OzStatus oz_outputs_look(OzOutputs *outputs, int due)
{
    int purpose = purpose_of(due);
    if (due & OZ_DUE_SAMPLE) {
        oz_series_sample(outputs->series, &outputs->now);
    }
    if (due & OZ_DUE_ROW) {
        OZ_PASS(oz_series_write(outputs->series, &outputs->now));
        OZ_PASS(oz_serve_row(outputs->serve, outputs->series));
    }
    if (due & OZ_DUE_CONTACTS) {
        OZ_PASS(oz_contact_rows_write(outputs->contact_rows, &outputs->now));
    }
    if (due & OZ_DUE_FIELDS) {
        OZ_PASS(write_fields(outputs));
    }
    if (purpose && outputs->frames) {
        OZ_PASS(oz_frames_add(outputs->frames, &outputs->now, purpose));
    }
    if (purpose & OZ_FRAME_EXPORT) {
        OZ_PASS(export_frames(outputs));
    }
    if ((purpose & ~OZ_FRAME_EXPORT) && outputs->pictures) {
        OZ_PASS(
            oz_render_queue_add(outputs->render_queue, outputs->pictures, &outputs->now, purpose));
    }
    return OZ_OK;
}

OzStatus oz_outputs_take(OzOutputs *outputs, OzScene *next, const char *caption)
{
    bool wanted = next->movie.present && next->movie.captions;
    if (outputs->is_open) {
        OZ_PASS(oz_render_queue_take(outputs->render_queue, outputs->pictures, next,
                                     wanted ? caption : ""));
        OZ_PASS(oz_glances_take(&outputs->glances, next));
    }
    oz_scene_free(&outputs->scene);
    outputs->scene = *next;
    *next = (OzScene){0};
    return outputs->is_open ? oz_series_take(outputs->series) : OZ_OK;
}

OzStatus oz_outputs_note_end(OzOutputs *outputs, int64_t step, double time, const char *how)
{
    if (!outputs->reloads || !oz_reload_log_has(outputs->reloads)) {
        return OZ_OK;
    }
    OZ_PASS(oz_reload_log_end(outputs->reloads, step, time, how));
    return write_scene(&outputs->scene, outputs->folder, "scene_final.yaml");
}

static OzStatus write_mean_fields(OzOutputs *o)
{
    OzStatus status = OZ_OK;
    char *mean = NULL;
    OZ_TRY(claim(&mean, o->folder, "fields_mean.csv", NULL));
    OZ_TRY(oz_coarse_rows_write_mean(o->fields, mean));
    if (o->field_images) {
        OZ_TRY(oz_coarse_images_add_mean(o->field_images, o->fields, o->now.time));
    }
done:
    free(mean);
    return status;
}

OzStatus oz_outputs_write_final(OzOutputs *outputs)
{
    OzStatus status = OZ_OK;
    char *spectrum = NULL;
    OZ_TRY(oz_final_write(&outputs->now, outputs->final));
    if (outputs->fields && oz_coarse_rows_has_mean(outputs->fields)) {
        OZ_TRY(write_mean_fields(outputs));
    }
    if (oz_series_has_spectrum(outputs->series)) { /* a name is noted only for a file that comes */
        OZ_TRY(claim(&spectrum, outputs->folder, "inclination_spectrum.csv", NULL));
        OZ_TRY(oz_series_write_spectrum(outputs->series, spectrum));
    }
done:
    free(spectrum);
    return status;
}

/* Which member this is, for who begins with it (run/from.h): its own run knows that. */
static OzStatus identity_state(OzOutputs *o, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    char *text = NULL;
    size_t length = 0;
    OZ_TRY(oz_state_text(visit, "name", &o->name));
    if (!visit->is_loading) {
        OZ_TRY(oz_scene_text(&o->scene, &text, &length));
    }
    OZ_TRY(oz_state_text(visit, "scene", &text));
done:
    free(text);
    return status;
}

OzStatus oz_outputs_state(OzOutputs *o, OzStateVisit *visit)
{
    bool is_open = o->is_open;
    int outcome = (int)o->outcome, loss = (int)o->loss;
    OZ_PASS(oz_state_enter(visit, "outputs", 3));
    OZ_PASS(identity_state(o, visit));
    OZ_PASS(oz_state_bool(visit, "is_open", &is_open));
    OZ_PASS(oz_state_int(visit, "outcome", "none", &outcome));
    OZ_PASS(oz_state_int(visit, "loss", "none", &loss));
#define VISIT(type, member, state, close)                                                          \
    if (is_open && o->member) {                                                                    \
        OZ_PASS(state);                                                                            \
    }
    OZ_OUTPUTS_OWNERS(VISIT)
#undef VISIT
    oz_state_leave(visit);
    o->outcome = (OzOutcome)outcome;
    o->loss = (OzStatus)loss;
    if (o->is_open && !is_open) {
        OZ_PASS(oz_outputs_close(o));
    }
    return OZ_OK;
}

OzStatus oz_outputs_close(OzOutputs *o)
{
    OzStatus status = OZ_OK;
    if (o->frames && o->scene.export_count > 0) { /* of a run that was resumed at its end, too */
        OZ_AFTER(status, export_frames(o));
    }
    OZ_AFTER(status, oz_glances_close(&o->glances));
#define CLOSE(type, member, state, close)                                                          \
    OZ_AFTER(status, close);                                                                       \
    o->member = NULL;
    OZ_OUTPUTS_OWNERS(CLOSE)
#undef CLOSE
    o->is_open = false;
    if (o->final) {
        oz_final_give_up(o->final);
    }
    oz_folder_close(&o->owned);
    return status;
}

void oz_outputs_free(OzOutputs *outputs)
{
    if (!outputs) {
        return;
    }
    oz_outputs_close(outputs);
    oz_snapshot_free(&outputs->now);
    oz_grains_free(&outputs->grains);
    oz_scene_free(&outputs->scene);
    free(outputs->name);
    free(outputs->folder);
    free(outputs->final);
    free(outputs);
}
