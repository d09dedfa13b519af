/* Handing pictures to those who look on. */
#include "draw/live.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"

#include <stdlib.h>

static const double PAUSE = 0.5;  /* s between two latest.png                                   */
static const double GLANCE = 0.2; /* s between two pictures for others: five a second look smooth */

static OzStatus write_latest(OzLive *live, const OzImage *image, const char *folder)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    if (!live->is_noted) {
        OZ_TRY(oz_folder_note(folder, "latest.png"));
        OZ_TRY(oz_folder_note(folder, "latest.png.part"));
        live->is_noted = true;
    }
    OZ_TRY(oz_file_join(&path, folder, "latest.png"));
    OZ_TRY(oz_image_write_png(image, path));
done:
    free(path);
    return status;
}

/* A failure ends it. */
static void keep_latest(OzLive *live, const OzImage *image, const char *folder)
{
    if (write_latest(live, image, folder) != OZ_OK) {
        atomic_store(&live->wants_latest, false);
        oz_log_line("latest.png: %s; the run goes on without it", oz_status_text());
    }
    live->is_stale = false;
    live->written = oz_clock_now();
}

void oz_live_show(OzLive *live, const OzImage *image, double fps, const char *folder)
{
    atomic_store(&live->shown, oz_clock_now());
    if (live->stream) {
        oz_movie_stream_show(live->stream, image, fps);
    }
    if (live->watcher.wants && live->watcher.wants(live->watcher.context)) {
        live->watcher.show(live->watcher.context, image);
    }
    live->is_stale = true;
    if (atomic_load(&live->wants_latest) && oz_clock_now() - live->written >= PAUSE) {
        keep_latest(live, image, folder);
    }
}

bool oz_live_waits(const OzLive *live)
{
    double since = oz_clock_now() - atomic_load(&live->shown);
    bool watched =
        since >= GLANCE && live->watcher.wants && live->watcher.wants(live->watcher.context);
    if (atomic_load(&live->is_over)) {
        return false;
    }
    return watched || (since >= GLANCE && live->stream && oz_movie_stream_is_on(live->stream)) ||
           (since >= PAUSE && atomic_load(&live->wants_latest));
}

void oz_live_fail(OzLive *live)
{
    if (!atomic_exchange(&live->is_over, true)) {
        oz_log_line("no pictures to look at: %s; the run goes on without them", oz_status_text());
    }
}

void oz_live_end(OzLive *live, const OzImage *image, const char *folder)
{
    if (live->is_stale && atomic_load(&live->wants_latest)) {
        keep_latest(live, image, folder);
    }
}

void oz_live_free(OzLive *live)
{
    oz_movie_stream_finish(live->stream);
    live->stream = NULL;
}
