/* What OpenGL is asked for, and in which order. Knows nothing of outlines, shadows and text. */
#include "draw/gl_drawing.h"

#include <math.h>
#include <string.h>

OzStatus oz_gl_drawing_create(OzGlDrawing *drawing, OzGlBackend backend, const char *source_dir)
{
    memset(drawing, 0, sizeof *drawing);
    drawing->source_dir = source_dir;
    return oz_context_create(&drawing->context, backend);
}

void oz_gl_drawing_free(OzGlDrawing *drawing)
{
    if (drawing->context.handle && oz_context_use(&drawing->context) == OZ_OK) {
        const OzGl *gl = &drawing->context.gl;
        oz_targets_free(&drawing->targets);
        oz_capsules_free(&drawing->capsules);
        oz_mesh_gl_free(&drawing->mesh_gl);
        gl->DeleteProgram(drawing->compose);
        gl->DeleteVertexArrays(1, &drawing->no_vertices);
    } else {
        drawing->polygons.gl = NULL; /* OpenGL's own goes with its context */
    }
    oz_polygons_free(&drawing->polygons);
    oz_container_free(&drawing->container);
    oz_context_free(&drawing->context);
    memset(drawing, 0, sizeof *drawing);
}

bool oz_gl_drawing_is_slow(const OzGlDrawing *drawing)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strstr(drawing->context.name, names[i])) {
            return true;
        }
    }
    return false;
}

static OzStatus make_for_rods(OzGlDrawing *drawing)
{
    const OzGl *gl = &drawing->context.gl;
    if (drawing->capsules.gl) {
        return OZ_OK;
    }
    OZ_PASS(oz_mesh_gl_create(&drawing->mesh_gl, gl, drawing->source_dir));
    return oz_capsules_create(&drawing->capsules, gl, drawing->source_dir);
}

static OzStatus make_for_flat(OzGlDrawing *drawing)
{
    const OzGl *gl = &drawing->context.gl;
    if (drawing->polygons.gl) {
        return OZ_OK;
    }
    OZ_PASS(oz_gl_program(gl, &drawing->compose, drawing->source_dir, "compose", ""));
    gl->GenVertexArrays(1, &drawing->no_vertices);
    OZ_PASS(oz_polygons_create(&drawing->polygons, gl, drawing->source_dir));
    return oz_gl_check(gl, "preparing the drawing of flat grains");
}

static OzStatus check_size(const OzGlDrawing *drawing, const OzLook *look)
{
    GLint largest = 0;
    drawing->context.gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (look->width > largest || look->height > largest) {
        return oz_status_fail(
            OZ_ERR_GRAPHICS,
            "a picture of %d x %d pixels cannot be drawn; up to %d a side can with "
            "%s",
            look->width, look->height, (int)largest, drawing->context.name);
    }
    return OZ_OK;
}

/* alpha: of the background; of samples it is how much of a pixel is filled. */
static void clear_target(const OzGl *gl, GLuint target, const OzLook *look, float alpha)
{
    const float *colour = oz_camera_background(look);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    gl->Disable(GL_SCISSOR_TEST);
    gl->DepthMask(GL_TRUE);
    gl->ClearColor(colour[0], colour[1], colour[2], alpha);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static OzStatus open_drawing(OzGlDrawing *drawing, const OzLook *look)
{
    const OzGl *gl = &drawing->context.gl;
    OZ_PASS(oz_context_use(&drawing->context));
    OZ_PASS(check_size(drawing, look));
    OZ_PASS(oz_targets_fit(&drawing->targets, gl, look));
    clear_target(gl, drawing->targets.sample_target, look, 0);
    gl->Enable(GL_SCISSOR_TEST);
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

static void draw_meshes(const OzGlDrawing *drawing, int first, int last, const OzCamera *camera,
                        const double size[2])
{
    for (int i = first; i <= last; i++) {
        const OzMesh *mesh = &drawing->container.meshes[i];
        bool is_solid = i == OZ_CONTAINER_FLOORS || i == OZ_CONTAINER_OBSTACLES;
        (is_solid ? oz_mesh_gl_draw_solid : oz_mesh_gl_draw_over)(&drawing->mesh_gl, mesh, camera,
                                                                  size[0], size[1]);
    }
}

static OzStatus draw_view(OzGlDrawing *drawing, const OzBodies *bodies, int view)
{
    const OzLook *look = bodies->look;
    const OzCamera *camera = bodies->camera;
    OzContainer *container = &drawing->container;
    double size[2];
    open_panel(&drawing->context.gl, &camera->panels[view], look->height, size);
    if (!look->bare) {
        OZ_PASS(oz_container_build(container, bodies->snapshot, look, camera, look->views[view]));
        draw_meshes(drawing, OZ_CONTAINER_FLOORS, OZ_CONTAINER_OUTLINES, camera, size);
    }
    oz_capsules_draw(&drawing->capsules, view, bodies, size[0], size[1]);
    if (!look->bare) {
        draw_meshes(drawing, OZ_CONTAINER_BEFORE, OZ_CONTAINER_END_BEFORE, camera, size);
    }
    return oz_gl_check(&drawing->context.gl, "drawing a view");
}

OzStatus oz_gl_drawing_views(OzGlDrawing *drawing, const OzBodies *const bodies[2])
{
    const OzLook *look = bodies[0]->look;
    OZ_PASS(open_drawing(drawing, look));
    OZ_PASS(make_for_rods(drawing));
    OZ_PASS(oz_capsules_upload(&drawing->capsules, bodies));
    drawing->context.gl.Enable(GL_DEPTH_TEST);
    for (int view = 0; view < look->view_count; view++) {
        OZ_PASS(draw_view(drawing, bodies[view], view));
        drawing->high[view] = drawing->container.high;
    }
    return OZ_OK;
}

OzBox oz_gl_drawing_box(const OzGlDrawing *drawing, const OzBodies *bodies, int view)
{
    return oz_bodies_box(bodies, view, bodies->look->bare ? 0 : drawing->high[view]);
}

OzStatus oz_gl_drawing_read(const OzGlDrawing *drawing, const OzDrawn *drawn, const OzLook *look)
{
    const OzGl *gl = &drawing->context.gl;
    const OzBox *box = &drawn->box;
    int low = look->height - box->y - box->height;
    gl->PixelStorei(GL_PACK_ROW_LENGTH, drawn->stride);
    gl->ReadPixels(box->x, low, box->width, box->height, GL_RGBA, GL_UNSIGNED_BYTE, drawn->colour);
    gl->ReadPixels(box->x, low, box->width, box->height, GL_DEPTH_COMPONENT, GL_FLOAT,
                   drawn->depth);
    return oz_gl_check(gl, "reading the picture back");
}

static OzStatus draw_flat(OzGlDrawing *drawing, const OzSnapshot *snapshots, int count,
                          const OzLook *look, const OzCamera *camera)
{
    const double faintest = 0.12;
    OzPolygons *polygons = &drawing->polygons;
    double size[2];
    OZ_PASS(open_drawing(drawing, look));
    OZ_PASS(make_for_flat(drawing));
    open_panel(&drawing->context.gl, &camera->panels[0], look->height, size);
    oz_polygons_clear(polygons);
    if (!look->bare) {
        oz_polygons_add_walls(polygons, &snapshots[count - 1], look, camera);
    }
    for (int i = 0; i < count; i++) {
        double age = count > 1 ? (double)(count - 1 - i) / (count - 1) : 0;
        oz_polygons_add_grains(polygons, &snapshots[i], look, camera, 1 - (1 - faintest) * age);
    }
    oz_polygons_add_chains(polygons, &snapshots[count - 1], look, camera);
    return oz_polygons_draw(polygons, look, camera, size[0], size[1]);
}

/* The mean of the samples of flat grains. */
static OzStatus mean_of_samples(const OzGlDrawing *drawing, const OzLook *look, OzImage *image)
{
    const OzGl *gl = &drawing->context.gl;
    GLuint program = drawing->compose;
    gl->UseProgram(program);
    gl->BindVertexArray(drawing->no_vertices);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, drawing->targets.colours);
    gl->Uniform1i(gl->GetUniformLocation(program, "colours"), 0);
    gl->Uniform1i(gl->GetUniformLocation(program, "sample_count"), drawing->targets.sample_count);
    gl->Uniform1i(gl->GetUniformLocation(program, "rows"), look->height);
    clear_target(gl, drawing->targets.result_target, look, 1);
    gl->Disable(GL_DEPTH_TEST);
    gl->Viewport(0, 0, look->width, look->height);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->PixelStorei(GL_PACK_ROW_LENGTH, 0);
    gl->ReadPixels(0, 0, image->width, image->height, GL_RGBA, GL_UNSIGNED_BYTE, image->pixels);
    return oz_gl_check(gl, "reading the picture back");
}

OzStatus oz_gl_drawing_flat(OzGlDrawing *drawing, const OzSnapshot *snapshots, int count,
                            const OzLook *look, const OzCamera *camera, OzImage *image)
{
    OZ_PASS(draw_flat(drawing, snapshots, count, look, camera));
    return mean_of_samples(drawing, look, image);
}
