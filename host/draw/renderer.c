/* One picture from one snapshot: planes of each view, by OpenGL or by the host, outlines and
 * shadows finished, the overlay on top. Knows how the parts follow each other, not how each is
 * drawn. */
#include "draw/renderer.h"

#include "base/log.h"
#include "base/memory.h"
#include "base/thread.h"
#include "draw/bodies.h"
#include "draw/camera.h"
#include "draw/finish.h"
#include "draw/font.h"
#include "draw/framing.h"
#include "draw/gl_drawing.h"
#include "draw/host_drawing.h"
#include "draw/overlay.h"

#include <glob.h>
#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>

/* What a view is made in; views of one picture may be made at once. */
typedef struct View {
    OzHostDrawing host;
    OzDrawnRoom room;
    OzFinishRoom finish;
} View;

/* What a picture's views show. */
typedef struct Shown {
    OzCamera cameras[2];
    OzFinish finish[2];
    const OzBodies *bodies[2];
} Shown;

/* A view to be made in a thread of its own. */
typedef struct ViewJob {
    OzRenderer *renderer;
    const Shown *shown;
    OzImage *image;
    int view;
    OzStatus status;
    char text[256];
} ViewJob;

struct OzRenderer {
    OzGlBackend backend;
    const char *source_dir; /* borrowed */
    bool has_gl;
    bool is_by_gl; /* rods; flat grains always are */
    OzGlDrawing gl;
    OzBodies bodies[2]; /* of each view that is seen from a side of its own */
    View views[2];
    bool is_parallel; /* there are processors for both */
    OzFont font;
};

static OzStatus need_gl(OzRenderer *renderer)
{
    if (!renderer->has_gl) {
        OZ_PASS(oz_gl_drawing_create(&renderer->gl, renderer->backend, renderer->source_dir));
        renderer->has_gl = true;
    }
    return OZ_OK;
}

static bool has_gpu(void)
{
    static const char *const nodes[] = {"/dev/dri/renderD*", "/dev/nvidia[0-9]*", "/dev/dxg"};
    bool found = false;
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes && !found; i++) {
        glob_t names;
        found = glob(nodes[i], GLOB_NOSORT, NULL, &names) == 0;
        globfree(&names);
    }
    return found;
}

/* A GPU that cannot be used is no reason to do without pictures. */
static OzStatus choose(OzRenderer *renderer)
{
    if (renderer->backend == OZ_GL_HOST) {
        renderer->backend = OZ_GL_AUTO;
        return OZ_OK;
    }
    renderer->is_by_gl = true;
    if (renderer->backend != OZ_GL_AUTO) {
        return need_gl(renderer);
    }
    renderer->is_by_gl =
        has_gpu() && need_gl(renderer) == OZ_OK && !oz_gl_drawing_is_slow(&renderer->gl);
    return OZ_OK;
}

static bool has_processors(void)
{
    cpu_set_t processors;
    return sched_getaffinity(0, sizeof processors, &processors) == 0 && CPU_COUNT(&processors) > 1;
}

OzStatus oz_renderer_create(OzRenderer **renderer, OzGlBackend backend, const char *source_dir)
{
    OzRenderer *made = NULL;
    *renderer = NULL;
    OZ_PASS(OZ_NEW(&made, 1));
    made->backend = backend;
    made->source_dir = source_dir;
    OzStatus status = choose(made);
    if (status != OZ_OK) {
        oz_renderer_free(made);
        return status;
    }
    made->is_parallel = !made->is_by_gl && has_processors();
    oz_font_open(&made->font);
    *renderer = made;
    return OZ_OK;
}

void oz_renderer_free(OzRenderer *renderer)
{
    if (!renderer) {
        return;
    }
    oz_gl_drawing_free(&renderer->gl);
    for (int i = 0; i < 2; i++) {
        oz_bodies_free(&renderer->bodies[i]);
        oz_host_drawing_free(&renderer->views[i].host);
        oz_drawn_free(&renderer->views[i].room);
        oz_finish_free(&renderer->views[i].finish);
    }
    oz_font_close(&renderer->font);
    free(renderer);
}

const char *oz_renderer_name(const OzRenderer *renderer)
{
    return renderer->is_by_gl ? renderer->gl.context.name : "the host, rays cast by the processor";
}

OzLook oz_renderer_look(const OzScene *scene, const OzSnapshot *snapshot)
{
    return oz_framing_look(scene, snapshot);
}

void oz_renderer_describe(FILE *file)
{
    oz_context_describe(file);
}

static OzStatus check_look(const OzLook *look, const OzImage *image)
{
    if (look->width < OZ_PICTURE_SIDE_MIN || look->height < OZ_PICTURE_SIDE_MIN ||
        look->width > OZ_PICTURE_SIDE_MAX || look->height > OZ_PICTURE_SIDE_MAX) {
        return oz_status_fail(OZ_ERR_GRAPHICS,
                              "a picture of %d x %d pixels cannot be drawn; %d to %d a side can",
                              look->width, look->height, OZ_PICTURE_SIDE_MIN, OZ_PICTURE_SIDE_MAX);
    }
    if (image->width != look->width || image->height != look->height) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "the image has %d x %d pixels, the look %d x %d",
                              image->width, image->height, look->width, look->height);
    }
    return OZ_OK;
}

/* A typical grain's radius in units of view coordinates. */
static double typical_radius(const OzSnapshot *snapshot, const OzCamera *camera)
{
    double sum = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        sum += snapshot->grains->diameter[i];
    }
    return snapshot->count ? 0.5 * sum / (double)snapshot->count / camera->unit : 1;
}

/* How far behind the middle a pixel's thing lies, along the horizon, is a share of the half width.
 */
static OzFinish choose_finish(const OzSnapshot *snapshot, const OzLook *look,
                              const OzCamera *camera)
{
    const float *colour = oz_camera_background(look);
    double radius = typical_radius(snapshot, camera);
    double away[3];
    oz_camera_away(camera, away);
    double share = camera->unit / look->half_width;
    double middle_row = look->height - camera->panels[0].middle_y;
    OzFinish finish = {.shadow = oz_shadow_make(fmin(radius * camera->scale, 0.03 * look->height),
                                                0.5 * radius / camera->depth),
                       .darkening = look->bare ? 0 : 0.60f,
                       .fade = look->bare ? 0 : 0.45f,
                       .by_depth = (float)(share * -away[2] * 2 * camera->depth),
                       .by_row = (float)(share * away[1] / camera->scale),
                       .middle = (float)(share * (away[2] * camera->depth -
                                                  away[1] * middle_row / camera->scale))};
    memcpy(finish.background, colour, sizeof finish.background);
    return finish;
}

static void fill_background(OzImage *image, const OzLook *look)
{
    const float *colour = oz_camera_background(look);
    uint8_t rgba[4] = {0, 0, 0, 255};
    for (int k = 0; k < 3; k++) {
        rgba[k] = (uint8_t)lroundf(255 * colour[k]);
    }
    size_t row = 4 * (size_t)image->width;
    for (size_t i = 0; i < row; i += 4) {
        memcpy(image->pixels + i, rgba, 4);
    }
    for (int y = 1; y < image->height; y++) {
        memcpy(image->pixels + (size_t)y * row, image->pixels, row);
    }
}

static OzStatus draw_view(OzRenderer *renderer, const Shown *shown, int view, OzImage *image)
{
    const OzBodies *bodies = shown->bodies[view];
    const OzFinish *finish = &shown->finish[view];
    View *own = &renderer->views[view];
    OzDrawn drawn;
    OzBox box;
    if (renderer->is_by_gl) {
        box = oz_gl_drawing_box(&renderer->gl, bodies, view);
    } else {
        OZ_PASS(oz_host_drawing_begin(&own->host, bodies, view, &box));
    }
    OZ_PASS(oz_drawn_open(&drawn, &own->room, &box, finish->background));
    OZ_PASS(renderer->is_by_gl ? oz_gl_drawing_read(&renderer->gl, &drawn, bodies->look)
                               : oz_host_drawing_draw(&own->host, &drawn, bodies, view));
    return oz_finish_pixels(finish, &own->finish, &drawn, image);
}

static void *work_on_view(void *argument)
{
    ViewJob *job = argument;
    job->status = draw_view(job->renderer, job->shown, job->view, job->image);
    snprintf(job->text, sizeof job->text, "%s", oz_status_text());
    return NULL;
}

/* Where processors are idle, the second view beside the first: no pixel is of both. */
static OzStatus draw_views(OzRenderer *renderer, const Shown *shown, int count, OzImage *image)
{
    pthread_t thread;
    ViewJob job = {renderer, shown, image, 1, OZ_OK, ""};
    bool beside =
        count > 1 && renderer->is_parallel && oz_thread_start(&thread, work_on_view, &job) == 0;
    OzStatus status = draw_view(renderer, shown, 0, image);
    if (beside) {
        pthread_join(thread, NULL);
        if (status == OZ_OK && job.status != OZ_OK) {
            status = oz_status_fail(job.status, "%s", job.text);
        }
    } else if (status == OZ_OK && count > 1) {
        status = draw_view(renderer, shown, 1, image);
    }
    return status;
}

/* Each view's grains; one that is seen from the side of the first shares those. */
static OzStatus take_bodies(OzRenderer *renderer, Shown *shown, const OzSnapshot *snapshot,
                            const OzLook *look)
{
    for (int view = 0; view < look->view_count; view++) {
        const OzCamera *camera = &shown->cameras[view];
        bool shares = view > 0 && oz_camera_agrees(camera, &shown->cameras[0]);
        shown->finish[view] = choose_finish(snapshot, look, camera);
        shown->bodies[view] = &renderer->bodies[shares ? 0 : view];
        if (!shares) {
            OZ_PASS(oz_bodies_take(&renderer->bodies[view], snapshot, look, camera));
        }
    }
    return OZ_OK;
}

static OzStatus draw_standing(OzRenderer *renderer, Shown *shown, const OzSnapshot *snapshot,
                              const OzLook *look, OzImage *image)
{
    OZ_PASS(take_bodies(renderer, shown, snapshot, look));
    if (renderer->is_by_gl) {
        OZ_PASS(oz_gl_drawing_views(&renderer->gl, shown->bodies));
    }
    fill_background(image, look);
    return draw_views(renderer, shown, look->view_count, image);
}

/* What the look shows of this moment. */
static OzLook look_at(const OzLook *look, const OzSnapshot *snapshot)
{
    OzLook now = *look;
    if (look->has_follow && look->follow < snapshot->count) {
        oz_snapshot_place(snapshot, look->follow, now.target);
        now.has_target = true;
    }
    return now;
}

static OzStatus draw(OzRenderer *renderer, const OzSnapshot *snapshots, int count,
                     const OzLook *asked, OzImage *image)
{
    const OzLook now = look_at(asked, &snapshots[count - 1]), *look = &now;
    Shown shown = {
        .cameras = {oz_camera_make(look, 0), oz_camera_make(look, look->view_count - 1)}};
    const OzSnapshot *last = &snapshots[count - 1];
    OZ_PASS(check_look(look, image));
    if (look->flat) {
        OZ_PASS(need_gl(renderer));
        OZ_PASS(
            oz_gl_drawing_flat(&renderer->gl, snapshots, count, look, &shown.cameras[0], image));
    } else {
        OZ_PASS(draw_standing(renderer, &shown, last, look, image));
    }
    oz_overlay_draw(&renderer->font, image, last, look, &shown.cameras[0]);
    return OZ_OK;
}

OzStatus oz_renderer_draw(OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                          OzImage *image)
{
    return draw(renderer, snapshot, 1, look, image);
}

OzStatus oz_renderer_draw_states(OzRenderer *renderer, const OzSnapshot *snapshots, int count,
                                 const OzLook *look, OzImage *image)
{
    return draw(renderer, snapshots, count, look, image);
}
