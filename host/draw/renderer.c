/* One picture from one snapshot: planes of each view, by OpenGL or by the host, outlines and
 * shadows finished, the overlay on top. Knows how the parts follow each other, not how each is
 * drawn. */
#include "draw/renderer.h"

#include "base/log.h"
#include "base/memory.h"
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
#include <stdlib.h>
#include <string.h>

struct OzRenderer {
    OzGlBackend backend;
    const char *source_dir; /* borrowed */
    bool has_gl;
    bool is_by_gl; /* rods; flat grains always are */
    OzGlDrawing gl;
    OzHostDrawing host;
    OzBodies bodies;
    OzDrawnRoom room;
    OzFinishRoom finish;
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
    oz_host_drawing_free(&renderer->host);
    oz_bodies_free(&renderer->bodies);
    oz_drawn_free(&renderer->room);
    oz_finish_free(&renderer->finish);
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
    double rise = camera->axes[1][1], away = -camera->axes[2][1];
    double share = camera->unit / look->half_width;
    double middle_row = look->height - camera->panels[0].middle_y;
    OzFinish finish = {
        .shadow = oz_shadow_make(fmin(radius * camera->scale, 0.03 * look->height),
                                 0.5 * radius / camera->depth),
        .darkening = look->bare ? 0 : 0.60f,
        .fade = look->bare ? 0 : 0.45f,
        .by_depth = (float)(share * away * 2 * camera->depth),
        .by_row = (float)(share * rise / camera->scale),
        .middle = (float)(-share * (away * camera->depth + rise * middle_row / camera->scale))};
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
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++) {
        memcpy(image->pixels + 4 * i, rgba, 4);
    }
}

static OzStatus draw_view(OzRenderer *renderer, const OzFinish *finish, int view, OzImage *image)
{
    const OzBodies *bodies = &renderer->bodies;
    OzDrawn drawn;
    OzBox box;
    if (renderer->is_by_gl) {
        box = oz_gl_drawing_box(&renderer->gl, bodies, view);
    } else {
        OZ_PASS(oz_host_drawing_begin(&renderer->host, bodies, view, &box));
    }
    OZ_PASS(oz_drawn_open(&drawn, &renderer->room, &box, finish->background));
    OZ_PASS(renderer->is_by_gl ? oz_gl_drawing_read(&renderer->gl, &drawn, bodies->look)
                               : oz_host_drawing_draw(&renderer->host, &drawn, bodies, view));
    return oz_finish_pixels(finish, &renderer->finish, &drawn, image);
}

static OzStatus draw_standing(OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                              const OzCamera *camera, OzImage *image)
{
    OzFinish finish = choose_finish(snapshot, look, camera);
    OZ_PASS(oz_bodies_take(&renderer->bodies, snapshot, look, camera));
    if (renderer->is_by_gl) {
        OZ_PASS(oz_gl_drawing_views(&renderer->gl, &renderer->bodies));
    }
    fill_background(image, look);
    for (int view = 0; view < look->view_count; view++) {
        OZ_PASS(draw_view(renderer, &finish, view, image));
    }
    return OZ_OK;
}

static OzStatus draw(OzRenderer *renderer, const OzSnapshot *snapshots, int count,
                     const OzLook *look, OzImage *image)
{
    OzCamera camera = oz_camera_make(look);
    const OzSnapshot *last = &snapshots[count - 1];
    OZ_PASS(check_look(look, image));
    if (look->flat) {
        OZ_PASS(need_gl(renderer));
        OZ_PASS(oz_gl_drawing_flat(&renderer->gl, snapshots, count, look, &camera, image));
    } else {
        OZ_PASS(draw_standing(renderer, last, look, &camera, image));
    }
    oz_overlay_draw(&renderer->font, image, last, look, &camera);
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
