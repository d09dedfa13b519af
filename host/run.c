/* The straight line of one run. */
#include "run.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "compute/capture.h"
#include "compute/settle.h"
#include "compute/sim.h"
#include "draw/gallery.h"
#include "leftovers.h"
#include "model/place.h"
#include "model/predict.h"
#include "observe/final.h"
#include "observe/frames.h"
#include "observe/schedule.h"
#include "observe/series.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Everything one run owns. Zeroed is valid: what was not opened is not closed. */
typedef struct Run {
    const OzOptions *options;
    OzScene scene;
    OzGrains grains;
    OzDevice device;
    OzSim *sim;
    OzSnapshot now;
    OzSchedule schedule;
    char *folder;
    OzSeries *series;
    OzFrames *frames;
    OzGallery *gallery;
    OzGallerySettings pictures;
    double started, first_step; /* wall clock */
} Run;

static volatile sig_atomic_t interrupted, writing;

/* While kernels are built nothing has been written yet, and nobody wants to wait for them. */
static void note_signal(int number)
{
    (void)number;
    interrupted = 1;
    if (!writing) {
        _exit(130);
    }
}

static void watch_signals(void)
{
    struct sigaction action = {.sa_handler = note_signal};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

/* "DIR/name"; the caller frees. */
static OzStatus in_folder(const Run *run, const char *name, char **path)
{
    return oz_file_join(path, run->folder, name);
}

static OzStatus choose_folder(Run *run)
{
    OzStatus status = OZ_OK;
    char *final = NULL;
    if (run->options->out) {
        OZ_TRY(oz_file_join(&run->folder, NULL, run->options->out));
    } else {
        OZ_TRY(oz_file_join(&run->folder, "runs", run->scene.name));
    }
    OZ_TRY(in_folder(run, "final.csv", &final));
    if (oz_file_exists(final) && !run->options->overwrite) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s holds a finished run; expected another folder (-o) or --overwrite",
                                run->folder);
        goto done;
    }
    OZ_TRY(oz_leftovers_remove(run->folder));
    OZ_TRY(oz_file_make_folder(run->folder));
done:
    free(final);
    return status;
}

static OzStatus write_scene(const Run *run)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    FILE *file = NULL;
    OZ_TRY(in_folder(run, "scene.yaml", &path));
    file = fopen(path, "w");
    if (!file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
        goto done;
    }
    OZ_TRY(oz_scene_write(&run->scene, file));
done:
    if (file && fclose(file) != 0 && status == OZ_OK) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    free(path);
    return status;
}

/* Refuses a step at which a contact of the scene grows by itself. */
static OzStatus check_stability(const Run *run)
{
    OzPrediction *rows = NULL;
    int count = 0;
    OzStatus status = oz_predict_scene(&rows, &count, &run->scene, &run->grains);
    for (int i = 0; status == OZ_OK && i < count; i++) {
        const char *between = rows[i].wall < 0 ? "two grains" : "a grain and a wall";
        if (!rows[i].stable && !run->options->force) {
            status = oz_status_fail(OZ_ERR_INPUT,
                                    "%s: time.step %g s is unstable for a contact of %s; expected "
                                    "below %g s, or --force",
                                    run->scene.path, run->scene.step, between,
                                    rows[i].largest_step);
        } else if (!rows[i].stable || !rows[i].tangential_stable) {
            oz_log_line("warning: at time.step %g s %s contact of %s is unstable", run->scene.step,
                        rows[i].stable ? "a sticking" : "a", between);
        }
    }
    free(rows);
    return status;
}

static OzStatus open_outputs(Run *run)
{
    OzStatus status = OZ_OK;
    char *series = NULL, *frames = NULL;
    bool pictures = run->scene.movie.present || run->scene.snapshots.count > 0;
    writing = 1;
    OZ_TRY(write_scene(run));
    OZ_TRY(in_folder(run, "series.csv", &series));
    OZ_TRY(oz_series_create(&run->series, series, &run->scene, &run->grains));
    if (pictures) {
        OZ_TRY(in_folder(run, "frames.bin", &frames));
        OZ_TRY(oz_frames_create(&run->frames, frames, &run->scene, &run->grains));
    }
    if (pictures && !run->options->no_video) {
        run->pictures = (OzGallerySettings){.folder = run->folder,
                                            .source_dir = run->options->source_dir,
                                            .backend = run->options->gl,
                                            .device = run->device.name};
        OZ_TRY(oz_gallery_create(&run->gallery, &run->pictures, &run->scene));
    }
done:
    free(series);
    free(frames);
    return status;
}

static OzStatus open_run(Run *run)
{
    OzStatus status = OZ_OK;
    const OzOptions *options = run->options;
    OZ_TRY(oz_scene_load(&run->scene, options->paths[0], options->settings,
                         options->setting_count));
    OZ_TRY(oz_place_grains(&run->grains, &run->scene));
    OZ_TRY(check_stability(run));
    OZ_TRY(choose_folder(run));
    char *log = NULL;
    OZ_TRY(in_folder(run, "log.txt", &log));
    status = oz_log_open(log);
    free(log);
    OZ_TRY(status);
    oz_log_line("orzo %s: %s, %lld grains", ORZO_VERSION, run->scene.path,
                (long long)run->grains.count);
    if (run->scene.step != run->scene.written_step) {
        oz_log_line("time.step %g s is used as %.17g s: the contact time in whole steps",
                    run->scene.written_step, run->scene.step);
    }
    OZ_TRY(oz_device_open(&run->device, options->device, options->threads));
    oz_log_line("device: %s", run->device.name);
    OzMember member = {&run->scene, &run->grains};
    OZ_TRY(oz_sim_create(&run->sim, &run->device, &member, 1, options->source_dir));
    OZ_TRY(oz_snapshot_create(&run->now, &run->scene, &run->grains));
    OZ_TRY(open_outputs(run));
done:
    return status;
}

static bool show_settling(void *context, double time, double ratio)
{
    (void)context;
    oz_log_progress("settling: %.3f s, kinetic energy %.3g N m g d", time, ratio);
    return !interrupted;
}

static OzStatus settle(Run *run)
{
    double seconds = 0, start = oz_clock_now();
    OzStatus status = oz_settle_run(run->sim, &seconds, show_settling, NULL);
    oz_log_progress(" ");
    if (status == OZ_OK && seconds > 0) {
        oz_log_line("settled in %.3f s (%.1f s of computing)", seconds, oz_clock_now() - start);
    }
    return status;
}

/* What is due at this step. */
static OzStatus look(Run *run, int due)
{
    OzStatus status = OZ_OK;
    int purpose = (due & OZ_DUE_MOVIE ? OZ_FRAME_MOVIE : 0) |
                  (due & OZ_DUE_SNAPSHOT ? OZ_FRAME_SNAPSHOT : 0);
    OZ_TRY(oz_capture_snapshot(run->sim, 0, &run->now, (due & OZ_DUE_ROW) != 0));
    if (due & OZ_DUE_SAMPLE) {
        oz_series_sample(run->series, &run->now);
    }
    if (due & OZ_DUE_ROW) {
        OZ_TRY(oz_series_write(run->series, &run->now));
    }
    if (purpose && run->frames) {
        OZ_TRY(oz_frames_add(run->frames, &run->now, purpose));
    }
    if (purpose && run->gallery) {
        OZ_TRY(oz_gallery_add(run->gallery, &run->now, purpose));
    }
done:
    return status;
}

static void show_progress(const Run *run)
{
    double step = (double)oz_sim_step(run->sim), last = (double)run->schedule.last_step;
    double spent = oz_clock_now() - run->first_step, rate = spent > 0 ? step / spent : 0;
    oz_log_progress("%5.1f %%  %.4f s  %.0f steps/s  %.0f s left", last > 0 ? 100 * step / last : 100,
                    step * run->scene.step, rate, rate > 0 ? (last - step) / rate : 0);
}

static OzStatus walk(Run *run)
{
    OzStatus status = OZ_OK;
    int64_t step = 0;
    int due = 0;
    double shown = 0;
    run->schedule = oz_schedule_create(&run->scene, run->options->until);
    run->first_step = oz_clock_now();
    oz_log_line("first step %.2f s after start", run->first_step - run->started);
    while (oz_schedule_next(&run->schedule, &step, &due)) {
        while (oz_sim_step(run->sim) < step) {
            OZ_TRY(oz_sim_launch(run->sim, step));
            if (oz_clock_now() - shown > 0.2) {
                show_progress(run);
                shown = oz_clock_now();
            }
            if (interrupted) {
                status = oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted at step %lld, time %.9g s",
                                        (long long)oz_sim_step(run->sim),
                                        (double)oz_sim_step(run->sim) * run->scene.step);
                goto done;
            }
        }
        OZ_TRY(look(run, due));
    }
done:
    oz_log_progress(" ");
    return status;
}

/* The last state, for a run that ended well or was interrupted. */
static OzStatus write_final(Run *run)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(in_folder(run, "final.csv", &path));
    OZ_TRY(oz_capture_snapshot(run->sim, 0, &run->now, false));
    OZ_TRY(oz_final_write(&run->now, path));
done:
    free(path);
    return status;
}

static void log_costs(const Run *run)
{
    OzSimCounts counts = oz_sim_counts(run->sim);
    double steps = counts.steps > 0 ? (double)counts.steps : 1, drawing = 0, encoding = 0;
    double spent = oz_clock_now() - run->first_step;
    if (run->gallery) {
        oz_gallery_times(run->gallery, &drawing, &encoding);
    }
    oz_log_line("%lld steps in %.2f s: %.1f us a step without pictures (drawing %.2f s, encoding "
                "%.2f s); list refreshed every %.1f, rebuilt every %.0f steps",
                (long long)counts.steps, spent, 1e6 * (spent - drawing - encoding) / steps, drawing,
                encoding, steps / (double)(counts.refreshes ? counts.refreshes : 1),
                steps / (double)(counts.rebuilds ? counts.rebuilds : 1));
    if (counts.crossed > 0) {
        oz_log_line("warning: %lld contacts of crossing shafts had no normal", (long long)counts.crossed);
    }
}

/* Closes what is open, keeping the first failure's text. */
static OzStatus close_run(Run *run, OzStatus status)
{
    char first[16384];
    snprintf(first, sizeof first, "%s", oz_status_text());
    OzStatus closing[] = {oz_gallery_finish(run->gallery), oz_frames_finish(run->frames),
                          oz_series_free(run->series)};
    for (size_t i = 0; i < sizeof closing / sizeof closing[0]; i++) {
        if (status == OZ_OK) {
            status = closing[i];
        } else {
            oz_status_fail(status, "%s", first);
        }
    }
    oz_snapshot_free(&run->now);
    oz_sim_free(run->sim);
    oz_device_close(&run->device);
    oz_grains_free(&run->grains);
    oz_scene_free(&run->scene);
    free(run->folder);
    return status;
}

OzStatus oz_run_scene(const OzOptions *options)
{
    Run run = {.options = options, .started = oz_clock_now()};
    OzStatus status = OZ_OK;
    watch_signals();
    OZ_TRY(open_run(&run));
    OZ_TRY(settle(&run));
    OZ_TRY(walk(&run));
done:
    if (run.sim && run.first_step > 0) {
        log_costs(&run);
    }
    if (run.series && (status == OZ_OK || status == OZ_ERR_INTERRUPTED)) {
        char first[1024];
        snprintf(first, sizeof first, "%s", oz_status_text());
        OzStatus written = write_final(&run);
        status = status == OZ_OK ? written : oz_status_fail(status, "%s", first);
    }
    status = close_run(&run, status);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    oz_log_open(NULL);
    return status;
}
