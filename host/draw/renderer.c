/* One picture from one snapshot: container, grains and container again into samples, the samples
 * into pixels, the overlay on top. Knows how the parts follow each other, not how each is drawn. */
#include "draw/renderer.h"

#include "base/log.h"
#include "base/memory.h"
#include "draw/camera.h"
#include "draw/capsules.h"
#include "draw/container.h"
#include "draw/context.h"
#include "draw/font.h"
#include "draw/framing.h"
#include "draw/overlay.h"
#include "draw/polygons.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SAMPLES = 4,           /* of a pixel: smooth edges for a third more time                   */
    MANY_PIXELS = 1 << 24, /* above this a pixel has one sample: 4 would take gigabytes       */
    PAIRS_LEAST = 6,       /* of neighbours of a pixel that may darken it                      */
    PAIRS_MOST = 64        /* each then darkens by a hundredth  ; as in compose.glsl     */
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
    int width, height, sample_count;     /* of the targets; 0 before the first picture */
    GLuint colours, depths, result;      /* textures: samples, and finished pixels     */
    GLuint sample_target, result_target; /* framebuffers                               */
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

static void free_targets(OzRenderer *renderer)
{
    const OzGl *gl = &renderer->context.gl;
    gl->DeleteFramebuffers(1, &renderer->sample_target);
    gl->DeleteFramebuffers(1, &renderer->result_target);
    gl->DeleteTextures(1, &renderer->colours);
    gl->DeleteTextures(1, &renderer->depths);
    gl->DeleteTextures(1, &renderer->result);
    renderer->width = renderer->height = 0;
}

void oz_renderer_free(OzRenderer *renderer)
{
    if (!renderer) {
        return;
    }
    if (renderer->context.handle && oz_context_use(&renderer->context) == OZ_OK) {
        const OzGl *gl = &renderer->context.gl;
        free_targets(renderer);
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

static GLuint sample_texture(const OzRenderer *renderer, GLenum format)
{
    const OzGl *gl = &renderer->context.gl;
    GLuint texture = 0;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
    gl->TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, renderer->sample_count, format,
                              renderer->width, renderer->height, GL_TRUE);
    return texture;
}

static GLuint pixel_texture(const OzRenderer *renderer)
{
    const OzGl *gl = &renderer->context.gl;
    GLuint texture = 0;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, renderer->width, renderer->height, 0, GL_RGBA,
                   GL_UNSIGNED_BYTE, NULL);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    return texture;
}

static OzStatus check_target(const OzRenderer *renderer)
{
    const OzGl *gl = &renderer->context.gl;
    GLenum state = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (state != GL_FRAMEBUFFER_COMPLETE) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "no framebuffer of %d x %d pixels to be had (0x%x)",
                              renderer->width, renderer->height, state);
    }
    return OZ_OK;
}

static OzStatus attach_targets(OzRenderer *renderer)
{
    const OzGl *gl = &renderer->context.gl;
    gl->GenFramebuffers(1, &renderer->result_target);
    gl->BindFramebuffer(GL_FRAMEBUFFER, renderer->result_target);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, renderer->result,
                             0);
    OZ_PASS(check_target(renderer));
    gl->GenFramebuffers(1, &renderer->sample_target);
    gl->BindFramebuffer(GL_FRAMEBUFFER, renderer->sample_target);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                             renderer->colours, 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D_MULTISAMPLE,
                             renderer->depths, 0);
    OZ_PASS(check_target(renderer));
    oz_capsules_find_samples(&renderer->capsules, renderer->sample_count);
    return OZ_OK;
}

static OzStatus fit_targets(OzRenderer *renderer, const OzLook *look)
{
    OzStatus status = OZ_OK;
    if (renderer->width == look->width && renderer->height == look->height) {
        return OZ_OK;
    }
    free_targets(renderer);
    renderer->width = look->width;
    renderer->height = look->height;
    renderer->sample_count = look->width * look->height > MANY_PIXELS ? 1 : SAMPLES;
    renderer->colours = sample_texture(renderer, GL_RGBA8);
    renderer->depths = sample_texture(renderer, GL_DEPTH_COMPONENT32F);
    renderer->result = pixel_texture(renderer);
    OZ_TRY(oz_gl_check(&renderer->context.gl, "making room for a picture"));
    OZ_TRY(attach_targets(renderer));
done:
    if (status != OZ_OK) {
        renderer->width = renderer->height = 0;
    }
    return status;
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
    oz_capsules_draw(&renderer->capsules, look->views[view], look, camera, size[0], size[1]);
    if (!look->bare) {
        oz_container_draw_before(&renderer->container, camera, size[0], size[1]);
    }
    return oz_gl_check(&renderer->context.gl, "drawing a view");
}

static void clear_target(const OzGl *gl, GLuint target, const OzLook *look)
{
    const float *colour = look->bare ? WHITE : BACKGROUND;
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    gl->Disable(GL_SCISSOR_TEST);
    gl->DepthMask(GL_TRUE);
    gl->ClearColor(colour[0], colour[1], colour[2], 1);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static OzStatus draw_samples(OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                             const OzCamera *camera)
{
    const OzGl *gl = &renderer->context.gl;
    clear_target(gl, renderer->sample_target, look);
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
    clear_target(&renderer->context.gl, renderer->sample_target, look);
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
 * and there more of them on a spiral, closer together inwards, make the shadow fade out. Returns
 * their number. */
static int place_taps(GLfloat taps[2 * PAIRS_MOST], double radius)
{
    const double golden = 0.6180339887; /* of half a turn: no two in a line */
    int count = radius > 12 ? (int)fmin(radius, PAIRS_MOST) : PAIRS_LEAST;
    for (int i = 0; i < count; i++) {
        bool few = count == PAIRS_LEAST;
        double ring = few ? (i % 2 ? 1.0 : 0.5) : 0.2 + (i + 0.5) / count;
        double angle = PI * (few ? (i + 0.25) / count : i * golden);
        taps[2 * i] = (GLfloat)round(fmax(radius, 2) * ring * cos(angle));
        taps[2 * i + 1] = (GLfloat)round(fmax(radius, 2) * ring * sin(angle));
    }
    return count;
}

static void set_mood(const OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                     const OzCamera *camera)
{
    const OzGl *gl = &renderer->context.gl;
    GLuint program = renderer->compose;
    const float *colour = look->bare ? WHITE : BACKGROUND;
    double radius = typical_radius(snapshot, camera);
    bool plain = look->bare || look->flat;
    GLfloat taps[2 * PAIRS_MOST];
    int pairs = place_taps(taps, fmin(radius * camera->scale, 0.03 * look->height));
    gl->Uniform2fv(gl->GetUniformLocation(program, "taps"), pairs, taps);
    gl->Uniform1i(gl->GetUniformLocation(program, "pairs"), pairs);
    gl->Uniform4f(gl->GetUniformLocation(program, "mood"),
                  (float)(2 * camera->depth / (1.5 * radius)), plain ? 0 : 0.60f, plain ? 0 : 0.45f,
                  0);
    gl->Uniform4f(gl->GetUniformLocation(program, "background"), colour[0], colour[1], colour[2],
                  1);
}

/* How far behind the middle a pixel's thing lies, along the horizon, as a share of the half width.
 */
static void set_retreat(const OzRenderer *renderer, const OzLook *look, const OzCamera *camera)
{
    const OzGl *gl = &renderer->context.gl;
    double rise = camera->axes[1][1], away = -camera->axes[2][1];
    double share = camera->unit / look->half_width;
    double middle_row = look->height - camera->panels[0].middle_y;
    gl->Uniform4f(gl->GetUniformLocation(renderer->compose, "retreat"),
                  (float)(share * away * 2 * camera->depth), (float)(share * rise / camera->scale),
                  (float)(-share * (away * camera->depth + rise * middle_row / camera->scale)), 0);
}

/* What a view's samples may have changed; flat grains may be anywhere. */
static OzBox changed_box(const OzRenderer *renderer, const OzLook *look, const OzCamera *camera,
                         int view)
{
    const OzCapsules *capsules = &renderer->capsules;
    const double high[2] = {capsules->high[0],
                            fmax(capsules->high[1], look->bare ? 0 : renderer->container.high)};
    return look->flat ? (OzBox){0, 0, look->width, look->height}
                      : oz_camera_box(camera, look, view, capsules->low, high);
}

static OzStatus compose(const OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                        const OzCamera *camera)
{
    const OzGl *gl = &renderer->context.gl;
    GLuint program = renderer->compose;
    gl->UseProgram(program);
    gl->BindVertexArray(renderer->no_vertices);
    gl->ActiveTexture(GL_TEXTURE1);
    gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, renderer->depths);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, renderer->colours);
    gl->Uniform1i(gl->GetUniformLocation(program, "colours"), 0);
    gl->Uniform1i(gl->GetUniformLocation(program, "depths"), 1);
    gl->Uniform1i(gl->GetUniformLocation(program, "sample_count"), renderer->sample_count);
    gl->Uniform1i(gl->GetUniformLocation(program, "rows"), look->height);
    set_mood(renderer, snapshot, look, camera);
    set_retreat(renderer, look, camera);
    clear_target(gl, renderer->result_target, look);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Viewport(0, 0, look->width, look->height);
    for (int view = 0; view < look->view_count; view++) {
        OzBox box = changed_box(renderer, look, camera, view);
        gl->Scissor(box.x, box.y, box.width, box.height);
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
    }
    return oz_gl_check(gl, "turning samples into pixels");
}

static OzStatus read_back(const OzRenderer *renderer, OzImage *image)
{
    const OzGl *gl = &renderer->context.gl;
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->ReadPixels(0, 0, image->width, image->height, GL_RGBA, GL_UNSIGNED_BYTE, image->pixels);
    return oz_gl_check(gl, "reading the picture back");
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
    OZ_PASS(fit_targets(renderer, look));
    OZ_PASS(look->flat ? draw_flat_samples(renderer, snapshots, count, look, &camera)
                       : draw_standing_samples(renderer, last, look, &camera));
    OZ_PASS(compose(renderer, last, look, &camera));
    OZ_PASS(read_back(renderer, image));
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
