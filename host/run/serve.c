/* Between a run and its page. */
#include "run/serve.h"

#include "base/clock.h"
#include "base/log.h"
#include "base/memory.h"
#include "model/motion.h"
#include "run/page.h"
#include "run/reload.h"
#include "run/serve_keys.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PICTURE_PAUSE = 0.2; /* s: five a second look smooth, and cost little */
static const double RATE_SPAN = 1;       /* s over which steps are counted                */

struct OzServe {
    OzPage *page;
    OzReload *reload;
    OzLive *live;
    _Atomic double pictured; /* wall clock at which the last picture was copied */
    int column_count;        /* that the page knows */
    OzPageStatus status;
    atomic_bool settles; /* time has not begun, and no change takes effect before */
    int64_t rate_step; /* where counting began, and when */
    double rate_start;
};

static bool wants_picture(void *context)
{
    OzServe *serve = context;
    return oz_clock_now() - atomic_load(&serve->pictured) >= PICTURE_PAUSE &&
           oz_page_wants_picture(serve->page);
}

static void show_picture(void *context, const OzImage *image)
{
    OzServe *serve = context;
    char *png = NULL;
    size_t length = 0;
    atomic_store(&serve->pictured, oz_clock_now());
    if (oz_image_png(image, &png, &length) == OZ_OK) { /* else the one before stays */
        oz_page_show_picture(serve->page, png, length);
    }
}

/* The same transaction as an edit of the scene file. */
static bool set_key(void *context, const char *key, const char *value, char *message, size_t size)
{
    OzServe *serve = context;
    char *setting = NULL;
    if (asprintf(&setting, "%s=%s", key, value) < 0) {
        snprintf(message, size, "out of memory");
        return false;
    }
    bool applied = oz_reload_set(serve->reload, &setting, 1, message, size);
    free(setting);
    if (applied && !message[0]) {
        snprintf(message, size, "%s is %s already", key, value);
    }
    if (applied && atomic_load(&serve->settles)) {
        size_t used = strlen(message);
        snprintf(message + used, size - used, ", once grains have settled");
    }
    if (applied) {
        oz_log_line("page: %s", message);
        oz_serve_renew(serve); /* else the table stays as it was */
    }
    return applied;
}

OzStatus oz_serve_renew(OzServe *serve)
{
    OzScene scene = {0};
    if (!serve || !serve->reload) {
        return OZ_OK;
    }
    OzStatus status = oz_reload_scene(serve->reload, &scene);
    status = status == OZ_OK ? oz_serve_keys_show(serve->page, &scene) : status;
    oz_scene_free(&scene);
    return status;
}

/* What others have asked for: the scene's files, a signal. */
static void hear(void *context, bool applied, const char *message)
{
    OzServe *serve = context;
    oz_page_say(serve->page, applied, message);
    oz_serve_renew(serve); /* else the table stays as it was */
}

OzStatus oz_serve_open(OzServe **serve, const OzOptions *options, const OzScene *scene,
                       OzReload *reload, OzRenderQueue *render_queue)
{
    OzStatus status = OZ_OK;
    OzPageSettings settings = {
        .port = options->serve_port, .title = scene->name, .source_dir = options->source_dir};
    OZ_TRY(OZ_NEW(serve, 1));
    (*serve)->rate_start = oz_clock_now();
    (*serve)->status = (OzPageStatus){.tap = NAN, .steps_per_second = NAN};
    (*serve)->reload = reload;
    settings.set = reload ? set_key : NULL;
    settings.context = *serve;
    OZ_TRY(oz_page_open(&(*serve)->page, &settings));
    OZ_TRY(oz_serve_renew(*serve));
    oz_reload_listen(reload, (OzReloadListener){hear, *serve});
    oz_page_show((*serve)->page, &(*serve)->status);
    (*serve)->live = oz_render_queue_live(render_queue);
    (*serve)->live->watcher = (OzLiveWatcher){wants_picture, show_picture, *serve};
    fprintf(oz_log_stream(), "page: %s\n", oz_page_address((*serve)->page));
    fflush(oz_log_stream());
done:
    if (status != OZ_OK && *serve) {
        oz_reload_listen(reload, (OzReloadListener){0});
        oz_page_close((*serve)->page);
        free(*serve);
        *serve = NULL;
    }
    return status;
}

void oz_serve_close(OzServe *serve, OzStatus status)
{
    if (!serve) {
        return;
    }
    oz_reload_listen(serve->reload, (OzReloadListener){0});
    serve->status.done = status == OZ_OK;
    serve->status.stopped = status != OZ_OK;
    if (status != OZ_OK) {
        oz_page_say(serve->page, false, oz_status_text());
    }
    oz_page_show(serve->page, &serve->status);
    oz_page_close(serve->page);
    if (serve->live) {
        serve->live->watcher = (OzLiveWatcher){0};
    }
    free(serve);
}

void oz_serve_show(OzServe *serve, const OzScene *scene, int64_t step, double time,
                   int64_t last_step)
{
    if (!serve) {
        return;
    }
    double now = oz_clock_now();
    OzPageStatus *s = &serve->status;
    s->step = step;
    s->time = time;
    s->settling = 0;
    atomic_store(&serve->settles, false);
    s->tap = scene->period > 0 ? oz_motion_tap(scene, time) : NAN;
    bool ends = last_step > 0 && last_step < INT64_MAX;
    s->progress = ends ? (double)step / (double)last_step : NAN;
    if (now - serve->rate_start >= RATE_SPAN) {
        s->steps_per_second = (double)(step - serve->rate_step) / (now - serve->rate_start);
        serve->rate_step = step;
        serve->rate_start = now;
    }
    oz_page_show(serve->page, s);
}

void oz_serve_settle(OzServe *serve, double time)
{
    if (serve) {
        serve->status.settling = time;
        atomic_store(&serve->settles, true);
        oz_page_show(serve->page, &serve->status);
    }
}

static OzStatus show_columns(OzServe *serve, const OzSeries *series, int count)
{
    OzStatus status = OZ_OK;
    char(*names)[OZ_COLUMN_NAME] = NULL;
    const char **list = NULL;
    OZ_TRY(OZ_NEW(&names, count));
    OZ_TRY(OZ_NEW(&list, count));
    for (int i = 0; i < count; i++) {
        oz_series_name(series, i, names[i]);
        list[i] = names[i];
    }
    OZ_TRY(oz_page_show_columns(serve->page, list, count));
done:
    free(list);
    free(names);
    return status;
}

OzStatus oz_serve_row(OzServe *serve, const OzSeries *series)
{
    const double *values = NULL;
    if (!serve) {
        return OZ_OK;
    }
    int count = oz_series_row(series, &values);
    if (serve->column_count != count) { /* they never get fewer */
        OZ_PASS(show_columns(serve, series, count));
        serve->column_count = count;
    }
    oz_page_show_row(serve->page, values);
    return OZ_OK;
}
