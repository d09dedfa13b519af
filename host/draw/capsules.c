/* Capsule records, sorted by the side of the cut plane on which they lie, and
 * their two programs. Knows nothing of containers, text or files. */
#include "draw/capsules.h"

#include "base/memory.h"
#include "draw/occlusion.h"
#include "draw/palette.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* One grain as the vertex shader reads it. */
typedef struct Record {
    OzBody body;
    GLfloat colour[3], unused;
} Record;

/* All grains and the records of those that are drawn. */
typedef struct Upload {
    const OzBodies *all;
    int64_t *seen[OZ_SIDE_COUNT]; /* count each: those that a view shows, nearest first */
    int64_t seen_count[OZ_SIDE_COUNT];
    Record *records;
    int64_t record_count, record_capacity;
} Upload;

/* Three vectors of four numbers, each grain its own. */
static void describe_records(const OzGl *gl)
{
    for (GLuint i = 0; i < 3; i++) {
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribDivisor(i, 1);
    }
}

OzStatus oz_capsules_create(OzCapsules *capsules, const OzGl *gl, const char *source_dir)
{
    memset(capsules, 0, sizeof *capsules);
    capsules->gl = gl;
    OZ_PASS(oz_gl_program(gl, &capsules->whole, source_dir, "rods", ""));
    OZ_PASS(oz_gl_program(gl, &capsules->sliced, source_dir, "rods", "#define OZ_SLICED\n"));
    OZ_PASS(oz_gl_program(gl, &capsules->outlined, source_dir, "rods", "#define OZ_OUTLINED\n"));
    gl->GenVertexArrays(1, &capsules->vertices);
    gl->BindVertexArray(capsules->vertices);
    gl->GenBuffers(1, &capsules->buffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, capsules->buffer);
    describe_records(gl);
    return oz_gl_check(gl, "preparing the buffer of grains");
}

void oz_capsules_free(OzCapsules *capsules)
{
    if (capsules->gl) {
        capsules->gl->DeleteProgram(capsules->whole);
        capsules->gl->DeleteProgram(capsules->sliced);
        capsules->gl->DeleteProgram(capsules->outlined);
        capsules->gl->DeleteBuffers(1, &capsules->buffer);
        capsules->gl->DeleteVertexArrays(1, &capsules->vertices);
    }
    memset(capsules, 0, sizeof *capsules);
}

/* The part of a body's axis about which nothing of it is cut away. */
static void find_kept(const Upload *upload, const OzBody *body, bool is_cut, double kept[2])
{
    double middle = -upload->all->offset, rise = 0;
    kept[0] = -(double)body->half_shaft;
    kept[1] = (double)body->half_shaft;
    if (!is_cut) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        middle += upload->all->inward[k] * (double)body->centre[k];
        rise += upload->all->inward[k] * (double)body->axis[k];
    }
    middle -= (double)body->radius;
    if (fabs(rise) < 1e-6) {
        kept[1] = middle >= 0 ? kept[1] : -1e9;
    } else if (rise > 0) {
        kept[0] = fmax(kept[0], -middle / rise);
    } else {
        kept[1] = fmin(kept[1], -middle / rise);
    }
}

/* Sorts out what a view shows, by the side of the cut on which it lies. */
static OzStatus see_view(Upload *upload, int view, const OzBox *box)
{
    OzOcclusion occlusion = {0};
    OzView kind = upload->all->look->views[view];
    memset(upload->seen_count, 0, sizeof upload->seen_count);
    OZ_PASS(oz_occlusion_begin(&occlusion, upload->all->camera, view, box));
    for (int64_t k = 0; k < upload->all->count; k++) {
        const OzBody *body = &upload->all->bodies[k];
        OzSide side = oz_bodies_side(upload->all, kind, k);
        if (side == OZ_SIDE_FRONT ? upload->all->look->cut_outlines
                                  : !oz_occlusion_hides(&occlusion, body)) {
            double kept[2];
            upload->seen[side][upload->seen_count[side]++] = k;
            find_kept(upload, body, side != OZ_SIDE_BEHIND, kept);
            oz_occlusion_add(&occlusion, body, kept[0], kept[1]);
        }
    }
    oz_occlusion_free(&occlusion);
    return OZ_OK;
}

static OzStatus add_records(Upload *upload, OzSide side)
{
    int64_t count = upload->seen_count[side], wanted = upload->record_count + count;
    if (wanted > upload->record_capacity) {
        OZ_PASS(oz_memory_grow((void **)&upload->records, (size_t)upload->record_capacity,
                               (size_t)(2 * wanted), sizeof *upload->records, "grains to draw"));
        upload->record_capacity = 2 * wanted;
    }
    for (int64_t k = 0; k < count; k++) {
        int64_t seen = upload->seen[side][k];
        Record *record = &upload->records[upload->record_count++];
        *record = (Record){.body = upload->all->bodies[seen]};
        oz_bodies_colour(upload->all, seen, record->colour);
    }
    return OZ_OK;
}

static OzStatus add_view(Upload *upload, OzCapsules *capsules, int view)
{
    const OzCamera *camera = upload->all->camera;
    OzBox box = oz_camera_box(camera, upload->all->look, view, upload->all->low, upload->all->high);
    OzCapsuleRanges *ranges = &capsules->views[view];
    OZ_PASS(see_view(upload, view, &box));
    ranges->first = upload->record_count;
    OZ_PASS(add_records(upload, OZ_SIDE_BEHIND));
    ranges->crossing = upload->record_count;
    OZ_PASS(add_records(upload, OZ_SIDE_CROSSING));
    ranges->outlined = upload->record_count;
    OZ_PASS(add_records(upload, OZ_SIDE_FRONT));
    ranges->end = upload->record_count;
    return OZ_OK;
}

static OzStatus begin_upload(Upload *upload)
{
    for (int side = 0; side < OZ_SIDE_COUNT; side++) {
        OZ_PASS(OZ_NEW(&upload->seen[side], upload->all->count));
    }
    return OZ_OK;
}

static void end_upload(Upload *upload)
{
    for (int side = 0; side < OZ_SIDE_COUNT; side++) {
        free(upload->seen[side]);
    }
    free(upload->records);
}

OzStatus oz_capsules_upload(OzCapsules *capsules, const OzBodies *const bodies[2])
{
    const OzGl *gl = capsules->gl;
    OzStatus status = OZ_OK;
    Upload upload = {.all = bodies[0]};
    OZ_TRY(begin_upload(&upload));
    for (int view = 0; view < bodies[0]->look->view_count; view++) {
        upload.all = bodies[view];
        OZ_TRY(add_view(&upload, capsules, view));
    }
    gl->BindBuffer(GL_ARRAY_BUFFER, capsules->buffer);
    gl->BufferData(GL_ARRAY_BUFFER,
                   (GLsizeiptr)((size_t)upload.record_count * sizeof *upload.records),
                   upload.records, GL_STREAM_DRAW);
    OZ_TRY(oz_gl_check(gl, "sending the grains"));
done:
    end_upload(&upload);
    return status;
}

static void draw_range(const OzCapsules *capsules, GLuint program, int64_t first, int64_t end,
                       const OzBodies *bodies, const float lens[2])
{
    const OzGl *gl = capsules->gl;
    const OzCamera *camera = bodies->camera;
    const double *inward = bodies->inward;
    if (end <= first) {
        return;
    }
    gl->UseProgram(program);
    gl->Uniform4f(gl->GetUniformLocation(program, "lens"), lens[0], lens[1],
                  (float)camera->distance, (float)camera->depth);
    gl->Uniform1f(gl->GetUniformLocation(program, "pixel"), (float)(1 / camera->scale));
    gl->Uniform4f(gl->GetUniformLocation(program, "plane"), (float)inward[0], (float)inward[1],
                  (float)inward[2], (float)bodies->offset);
    gl->BindVertexArray(capsules->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, capsules->buffer);
    for (GLuint i = 0; i < 3; i++) {
        uintptr_t place = (uintptr_t)first * sizeof(Record) + 4 * sizeof(GLfloat) * i;
        gl->VertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, sizeof(Record), (const void *)place);
    }
    gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)(end - first));
}

/* Over what is there, whose depth they leave alone. */
static void draw_outlines(const OzCapsules *capsules, const OzCapsuleRanges *ranges,
                          const OzBodies *bodies, const float lens[2])
{
    const OzGl *gl = capsules->gl;
    gl->DepthMask(GL_FALSE);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    draw_range(capsules, capsules->outlined, ranges->outlined, ranges->end, bodies, lens);
    gl->Disable(GL_BLEND);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthMask(GL_TRUE);
}

void oz_capsules_draw(const OzCapsules *capsules, int view, const OzBodies *bodies,
                      double viewport_width, double viewport_height)
{
    const OzCapsuleRanges *ranges = &capsules->views[view];
    double scale = bodies->camera->scale;
    float lens[2] = {(float)(2 * scale / viewport_width), (float)(2 * scale / viewport_height)};
    draw_range(capsules, capsules->whole, ranges->first, ranges->crossing, bodies, lens);
    draw_range(capsules, capsules->sliced, ranges->crossing, ranges->outlined, bodies, lens);
    draw_outlines(capsules, ranges, bodies, lens);
}
