/* Handing pictures to those who look on. */
#include "draw/live.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"

#include <stdlib.h>

static const double PAUSE = 0.5; /* s between two latest.png */

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
