/* One picture from one snapshot: container, grains and container again into samples, the samples
 * into pixels, the overlay on top. Knows how the parts follow each other, not how each is drawn. */
#include "draw/renderer.h"

#include "base/log.h"
#include "base/memory.h"
#include "draw/camera.h"
#include "draw/capsules.h"
#include "draw/container.h"
#include "draw/context.h"
#include "draw/finish.h"
#include "draw/font.h"
#include "draw/framing.h"
#include "draw/overlay.h"
#include "draw/polygons.h"
#include "draw/targets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PAIRS_LEAST = 6 /* of neighbours of a pixel that may darken it */
};

static const double PI = 3.14159265358979323846;
static const float WHITE[3] = {1, 1, 1};

/* A shade off white, against which glass looks clean. */
static const float BACKGROUND[3] = {0.972f, 0.976f, 0.982f};

struct OzRenderer {
    OzContext context;
    OzCapsules capsules;
    OzContainer container;
    OzPolygons polygons;
    OzFont font;
    GLuint compose, no_vertices;
    OzTargets targets;
};

OzStatus oz_renderer_create(OzRenderer **renderer, OzGlBackend backend, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzRenderer *made = NULL;
    *renderer = NULL;
    OZ_TRY(OZ_NEW(&made, 1));
    OZ_TRY(oz_context_create(&made->context, backend));
    const OzGl *gl = &made->context.gl;
    OZ_TRY(oz_capsules_create(&made->capsules, gl, source_dir));
    OZ_TRY(oz_container_create(&made->container, gl, source_dir));
    OZ_TRY(oz_polygons_create(&made->polygons, gl, source_dir));
    OZ_TRY(oz_gl_program(gl, &made->compose, source_dir, "compose", ""));
    gl->GenVertexArrays(1, &made->no_vertices);
    OZ_TRY(oz_gl_check(gl, "preparing the renderer"));
    oz_font_open(&made->font);
    *renderer = made;
    made = NULL;
done:
    oz_renderer_free(made);
    return status;
}

void oz_renderer_free(OzRenderer *renderer)
{
    if (!renderer) {
        return;
    }
    if (renderer->context.handle && oz_context_use(&renderer->context) == OZ_OK) {
        const OzGl *gl = &renderer->context.gl;
        oz_targets_free(&renderer->targets);
        oz_capsules_free(&renderer->capsules);
        oz_container_free(&renderer->container);
        oz_polygons_free(&renderer->polygons);
        gl->DeleteProgram(renderer->compose);
        gl->DeleteVertexArrays(1, &renderer->no_vertices);
    }
    oz_font_close(&renderer->font);
    oz_context_free(&renderer->context);
    free(renderer);
}

const char *oz_renderer_name(const OzRenderer *renderer)
{
    return renderer->context.name;
}

OzLook oz_renderer_look(const OzScene *scene, const OzSnapshot *snapshot)
{
    return oz_framing_look(scene, snapshot);
}

void oz_renderer_describe(FILE *file)
{
    oz_context_describe(file);
}

static OzStatus check_look(const OzRenderer *renderer, const OzLook *look, const OzImage *image)
{
    GLint largest = 0;
    renderer->context.gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    largest = largest < OZ_PICTURE_SIDE_MAX ? largest : OZ_PICTURE_SIDE_MAX;
    if (look->width < OZ_PICTURE_SIDE_MIN || look->height < OZ_PICTURE_SIDE_MIN ||
        look->width > largest || look->height > largest) {
        return oz_status_fail(OZ_ERR_GRAPHICS,
                              "a picture of %d x %d pixels cannot be drawn; %d to %d a side can "
                              "with %s",
                              look->width, look->height, OZ_PICTURE_SIDE_MIN, largest,
                              renderer->context.name);
    }
    if (image->width != look->width || image->height != look->height) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "the image has %d x %d pixels, the look %d x %d",
                              image->width, image->height, look->width, look->height);
    }
    return OZ_OK;
}

/* The viewport has the panel's middle at its own, so that the origin of view coordinates comes to
 * lie there; the scissor keeps the panel's columns. */
static void open_panel(const OzGl *gl, const OzPanel *panel, int height, double size[2])
{
    int middle_x = (int)lround(panel->middle_x), middle_y = height - (int)lround(panel->middle_y);
    int left = middle_x - panel->x, right = panel->x + panel->width - middle_x;
    int half_width = left > right ? left : right;
    int half_height = middle_y > height - middle_y ? middle_y : height - middle_y;
    gl->Viewport(middle_x - half_width, middle_y - half_height, 2 * half_width, 2 * half_height);
    gl->Scissor(panel->x, 0, panel->width, height);
    size[0] = 2 * half_width;
    size[1] = 2 * half_height;
}

static OzStatus draw_view(OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                          const OzCamera *camera, int view)
{
    double size[2];
    open_panel(&renderer->context.gl, &camera->panels[view], look->height, size);
    if (!look->bare) {
        OZ_PASS(
            oz_container_build(&renderer->container, snapshot, look, camera, look->views[view]));
        oz_container_draw_behind(&renderer->container, camera, size[0], size[1]);
    }
    oz_capsules_draw(&renderer->capsules, view, look, camera, size[0], size[1]);
    if (!look->bare) {
        oz_container_draw_before(&renderer->container, camera, size[0], size[1]);
    }
    return oz_gl_check(&renderer->context.gl, "drawing a view");
}

/* alpha: of the background; of samples it is how much of a pixel is filled. */
static void clear_target(const OzGl *gl, GLuint target, const OzLook *look, float alpha)
{
    const float *colour = look->bare ? WHITE : BACKGROUND;
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    gl->Disable(GL_SCISSOR_TEST);
    gl->DepthMask(GL_TRUE);
    gl->ClearColor(colour[0], colour[1], colour[2], alpha);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static OzStatus draw_samples(OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                             const OzCamera *camera)
{
    const OzGl *gl = &renderer->context.gl;
    clear_target(gl, renderer->targets.sample_target, look, 0);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_SCISSOR_TEST);
    for (int view = 0; view < look->view_count; view++) {
        OZ_PASS(draw_view(renderer, snapshot, look, camera, view));
    }
    return OZ_OK;
}

/* States of flat grains over each other; the first of several is faint, the last is opaque. */
static OzStatus draw_flat_samples(OzRenderer *renderer, const OzSnapshot *snapshots, int count,
                                  const OzLook *look, const OzCamera *camera)
{
    const double faintest = 0.12;
    OzPolygons *polygons = &renderer->polygons;
    double size[2];
    clear_target(&renderer->context.gl, renderer->targets.sample_target, look, 0);
    renderer->context.gl.Enable(GL_SCISSOR_TEST);
    open_panel(&renderer->context.gl, &camera->panels[0], look->height, size);
    oz_polygons_clear(polygons);
    if (!look->bare) {
        oz_polygons_add_walls(polygons, &snapshots[count - 1], look, camera);
    }
    for (int i = 0; i < count; i++) {
        double age = count > 1 ? (double)(count - 1 - i) / (count - 1) : 0;
        oz_polygons_add_grains(polygons, &snapshots[i], look, camera, 1 - (1 - faintest) * age);
    }
    return oz_polygons_draw(polygons, look, camera, size[0], size[1]);
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

/* Half of two rings of neighbours, the outer as wide as a grain, pixels. Every pair copies the
 * edges of what stands before a surface onto it: so few are seen as such where they lie far apart,
 * and there more of them on a spiral, closer together inwards, make the shadow fade out. */
static void place_taps(OzFinish *finish, double radius)
{
    const double golden = 0.6180339887; /* of half a turn: no two in a line */
    finish->pairs = radius > 12 ? (int)fmin(radius, OZ_FINISH_PAIRS) : PAIRS_LEAST;
    for (int i = 0; i < finish->pairs; i++) {
        bool few = finish->pairs == PAIRS_LEAST;
        double ring = few ? (i % 2 ? 1.0 : 0.5) : 0.2 + (i + 0.5) / finish->pairs;
        double angle = PI * (few ? (i + 0.25) / finish->pairs : i * golden);
        finish->taps[i][0] = (int)lround(fmax(radius, 2) * ring * cos(angle));
        finish->taps[i][1] = (int)lround(fmax(radius, 2) * ring * sin(angle));
        for (int k = 0; k < 2; k++) {
            int away = abs(finish->taps[i][k]);
            finish->reach = away > finish->reach ? away : finish->reach;
        }
    }
}

/* How far behind the middle a pixel's thing lies, along the horizon, is a share of the half width.
 */
static OzFinish choose_finish(const OzSnapshot *snapshot, const OzLook *look,
                              const OzCamera *camera)
{
    const float *colour = look->bare ? WHITE : BACKGROUND;
    double radius = typical_radius(snapshot, camera);
    double rise = camera->axes[1][1], away = -camera->axes[2][1];
    double share = camera->unit / look->half_width;
    double middle_row = look->height - camera->panels[0].middle_y;
    OzFinish finish = {
        .reach = 1,
        .steepness = (float)(2 * camera->depth / (1.5 * radius)),
        .darkening = look->bare ? 0 : 0.60f,
        .fade = look->bare ? 0 : 0.45f,
        .by_depth = (float)(share * away * 2 * camera->depth),
        .by_row = (float)(share * rise / camera->scale),
        .middle = (float)(-share * (away * camera->depth + rise * middle_row / camera->scale))};
    memcpy(finish.background, colour, sizeof finish.background);
    place_taps(&finish, fmin(radius * camera->scale, 0.03 * look->height));
    return finish;
}

/* What a view may have painted. */
static OzBox changed_box(const OzRenderer *renderer, const OzLook *look, const OzCamera *camera,
                         int view)
{
    const OzCapsules *capsules = &renderer->capsules;
    const double high[2] = {capsules->high[0],
                            fmax(capsules->high[1], look->bare ? 0 : renderer->container.high)};
    return oz_camera_box(camera, look, view, capsules->low, high);
}

/* The mean of the samples of flat grains. */
static OzStatus mean_of_samples(const OzRenderer *renderer, const OzLook *look, OzImage *image)
{
    const OzGl *gl = &renderer->context.gl;
    GLuint program = renderer->compose;
    gl->UseProgram(program);
    gl->BindVertexArray(renderer->no_vertices);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, renderer->targets.colours);
    gl->Uniform1i(gl->GetUniformLocation(program, "colours"), 0);
    gl->Uniform1i(gl->GetUniformLocation(program, "sample_count"), renderer->targets.sample_count);
    gl->Uniform1i(gl->GetUniformLocation(program, "rows"), look->height);
    clear_target(gl, renderer->targets.result_target, look, 1);
    gl->Disable(GL_DEPTH_TEST);
    gl->Viewport(0, 0, look->width, look->height);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->PixelStorei(GL_PACK_ROW_LENGTH, 0);
    gl->ReadPixels(0, 0, image->width, image->height, GL_RGBA, GL_UNSIGNED_BYTE, image->pixels);
    return oz_gl_check(gl, "reading the picture back");
}

static void fill_background(OzImage *image, const OzLook *look)
{
    const float *colour = look->bare ? WHITE : BACKGROUND;
    uint8_t rgba[4] = {0, 0, 0, 255};
    for (int k = 0; k < 3; k++) {
        rgba[k] = (uint8_t)lroundf(255 * colour[k]);
    }
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++) {
        memcpy(image->pixels + 4 * i, rgba, 4);
    }
}

/* Reads a view's box back into the middle of larger planes and finishes it. */
static OzStatus finish_view(const OzRenderer *renderer, const OzFinish *finish, const OzBox *box,
                            OzImage *image)
{
    const OzGl *gl = &renderer->context.gl;
    OzStatus status = OZ_OK;
    int stride = box->width + 2 * finish->reach;
    size_t count = (size_t)stride * (size_t)(box->height + 2 * finish->reach);
    size_t inset = (size_t)finish->reach * (size_t)(stride + 1);
    uint8_t *colour = NULL;
    float *depth = NULL;
    OZ_TRY(OZ_NEW(&colour, 4 * count));
    OZ_TRY(OZ_NEW(&depth, count));
    for (size_t i = 0; i < count; i++) {
        depth[i] = 1;
    }
    OzDrawn drawn = {*box, stride, colour + 4 * inset, depth + inset};
    int low = image->height - box->y - box->height;
    gl->PixelStorei(GL_PACK_ROW_LENGTH, stride);
    gl->ReadPixels(box->x, low, box->width, box->height, GL_RGBA, GL_UNSIGNED_BYTE, drawn.colour);
    gl->ReadPixels(box->x, low, box->width, box->height, GL_DEPTH_COMPONENT, GL_FLOAT, drawn.depth);
    OZ_TRY(oz_gl_check(gl, "reading the picture back"));
    OZ_TRY(oz_finish_pixels(finish, &drawn, image));
done:
    free(colour);
    free(depth);
    return status;
}

static OzStatus finish_views(const OzRenderer *renderer, const OzSnapshot *snapshot,
                             const OzLook *look, const OzCamera *camera, OzImage *image)
{
    OzFinish finish = choose_finish(snapshot, look, camera);
    fill_background(image, look);
    for (int view = 0; view < look->view_count; view++) {
        OzBox box = changed_box(renderer, look, camera, view);
        OZ_PASS(finish_view(renderer, &finish, &box, image));
    }
    return OZ_OK;
}

static OzStatus draw_standing_samples(OzRenderer *renderer, const OzSnapshot *snapshot,
                                      const OzLook *look, const OzCamera *camera)
{
    OzStatus status = oz_capsules_upload(&renderer->capsules, snapshot, look, camera);
    return status == OZ_OK ? draw_samples(renderer, snapshot, look, camera) : status;
}

static OzStatus draw(OzRenderer *renderer, const OzSnapshot *snapshots, int count,
                     const OzLook *look, OzImage *image)
{
    OzCamera camera = oz_camera_make(look);
    const OzSnapshot *last = &snapshots[count - 1];
    OZ_PASS(oz_context_use(&renderer->context));
    OZ_PASS(check_look(renderer, look, image));
    OZ_PASS(oz_targets_fit(&renderer->targets, &renderer->context.gl, look));
    OZ_PASS(look->flat ? draw_flat_samples(renderer, snapshots, count, look, &camera)
                       : draw_standing_samples(renderer, last, look, &camera));
    OZ_PASS(look->flat ? mean_of_samples(renderer, look, image)
                       : finish_views(renderer, last, look, &camera, image));
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
