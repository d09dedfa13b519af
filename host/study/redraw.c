/* Drawing again from frames.bin, with the run's scene.yaml and other settings over it. */
#include "study/redraw.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "draw/gallery.h"
#include "inputs.h"
#include "observe/frames.h"

#include <stdlib.h>

typedef struct Redraw {
    OzScene scene;
    OzGrains grains;
    OzSnapshot snapshot;
    OzFrames *frames;
    OzGallery *gallery;
    OzGallerySettings settings;
    OzInputs inputs;
    OzFolder owned; /* out, in use */
    char *scene_path, *frames_path, *out;
} Redraw;

/* Takes the folder that pictures go to, which must not be the run's own. Earlier pictures there go.
 */
static OzStatus own_folder(Redraw *r)
{
    static const char *const writes[] = {"movie.mp4", "movie.mp4.part", "snapshots/*.png*", NULL};
    OzStatus status = OZ_OK;
    OzFolderUse use = {.writes = writes};
    OZ_TRY(oz_inputs_add(&r->inputs, r->frames_path));
    OZ_TRY(oz_inputs_add_scene(&r->inputs, &r->scene));
    OZ_TRY(oz_inputs_check(&r->inputs, r->out, &use));
    OZ_TRY(oz_folder_open(&r->owned, r->out, &use));
done:
    return status;
}

static OzStatus open_all(Redraw *r, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    const char *folder = options->paths[0];
    OZ_TRY(oz_file_join(&r->scene_path, folder, "scene.yaml"));
    OZ_TRY(oz_file_join(&r->frames_path, folder, "frames.bin"));
    OZ_TRY(options->out ? oz_file_join(&r->out, NULL, options->out)
                        : oz_file_join(&r->out, folder, "draw"));
    OZ_TRY(oz_scene_load(&r->scene, r->scene_path, options->settings, options->setting_count));
    OZ_TRY(oz_frames_open(&r->frames, r->frames_path, &r->grains));
    OZ_TRY(oz_snapshot_create(&r->snapshot, &r->scene, &r->grains));
    OZ_TRY(own_folder(r));
    r->settings = (OzGallerySettings){.folder = r->out,
                                      .source_dir = options->source_dir,
                                      .backend = options->gl,
                                      .device = "drawn from frames.bin"};
    OZ_TRY(oz_gallery_create(&r->gallery, &r->settings, &r->scene));
done:
    return status;
}

static OzStatus draw_all(Redraw *r)
{
    OzStatus status = OZ_OK;
    int purpose = 0, count = 0;
    int left_out = r->scene.movie.present ? 0 : OZ_FRAME_MOVIE; /* by --set movie=false */
    bool more = true;
    for (;;) {
        OZ_TRY(oz_frames_next(r->frames, &r->snapshot, &purpose, &more));
        if (!more) {
            break;
        }
        if (purpose & ~left_out) {
            OZ_TRY(oz_gallery_add(r->gallery, &r->snapshot, purpose & ~left_out));
            oz_log_progress("frame %d", ++count);
        }
    }
    oz_log_progress(" ");
    oz_log_line("%d frames drawn into %s", count, r->out);
done:
    return status;
}

OzStatus oz_redraw_folder(const OzOptions *options)
{
    OzStatus status = OZ_OK;
    Redraw r = {0};
    OZ_TRY(open_all(&r, options));
    OZ_TRY(draw_all(&r));
done:;
    OzStatus closed = oz_gallery_finish(r.gallery);
    status = status == OZ_OK ? closed : status;
    oz_frames_finish(r.frames);
    oz_inputs_free(&r.inputs);
    oz_folder_close(&r.owned);
    oz_snapshot_free(&r.snapshot);
    oz_grains_free(&r.grains);
    oz_scene_free(&r.scene);
    free(r.scene_path);
    free(r.frames_path);
    free(r.out);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
