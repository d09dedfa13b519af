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

typedef enum Side { SIDE_BEHIND, SIDE_CROSSING, SIDE_FRONT, SIDE_COUNT } Side;

/* All grains and the records of those that are drawn. */
typedef struct Upload {
    const OzSnapshot *snapshot;
    const OzLook *look;
    const OzCamera *camera;
    double inward[3], offset;  /* the cut: its normal, and its distance along it */
    OzBody *bodies;            /* count, in the snapshot's order                     */
    int64_t *order;            /* count: nearest first                               */
    int64_t *seen[SIDE_COUNT]; /* count each: those that a view shows, nearest first */
    int64_t seen_count[SIDE_COUNT];
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

static Side side_of(const OzSnapshot *snapshot, const OzLook *look, int64_t i)
{
    const OzGrains *grains = snapshot->grains;
    double middle = snapshot->position[3 * i + 1] - look->cut;
    double reach =
        0.5 * (grains->diameter[i] + grains->length[i] * fabs(snapshot->axis[3 * i + 1]));
    if (middle >= reach) {
        return SIDE_BEHIND;
    }
    return middle > -reach ? SIDE_CROSSING : SIDE_FRONT;
}

static OzBody body_of(const OzSnapshot *snapshot, const OzCamera *camera, int64_t i)
{
    OzBody body = {.radius = (float)(0.5 * snapshot->grains->diameter[i] / camera->unit),
                   .half_shaft = (float)(0.5 * snapshot->grains->length[i] / camera->unit)};
    double centre[3], axis[3];
    oz_camera_see(camera, &snapshot->position[3 * i], centre);
    oz_camera_turn(camera, &snapshot->axis[3 * i], axis);
    for (int k = 0; k < 3; k++) {
        body.centre[k] = (float)centre[k];
        body.axis[k] = (float)axis[k];
    }
    return body;
}

/* Widens the reach by a grain, with room for its looking larger in front. */
static void reach_for(OzCapsules *capsules, const OzBody *body, const OzCamera *camera)
{
    double radius = (double)body->radius + (double)body->half_shaft;
    double gap = camera->distance - (double)body->centre[2] - radius;
    double nearer = camera->distance / fmax(gap, 0.1 * camera->distance);
    for (int k = 0; k < 2; k++) {
        double middle = nearer * (double)body->centre[k];
        capsules->low[k] = fmin(capsules->low[k], middle - nearer * radius);
        capsules->high[k] = fmax(capsules->high[k], middle + nearer * radius);
    }
}

/* In buckets of equal depth by counting, each in the grains' order. */
static OzStatus sort_by_depth(Upload *upload)
{
    enum { BUCKETS = 1 << 14 };
    int64_t count = upload->snapshot->count, *starts = NULL, sum = 0;
    double depth = upload->camera->depth;
    OZ_PASS(OZ_NEW(&starts, BUCKETS));
    for (int pass = 0; pass < 2; pass++) {
        for (int64_t i = 0; i < count; i++) {
            double share = 0.5 - 0.5 * (double)upload->bodies[i].centre[2] / depth;
            int64_t *start = &starts[(int)(fmin(fmax(share, 0), 1) * (BUCKETS - 1))];
            if (pass == 1) {
                upload->order[*start] = i;
            }
            ++*start;
        }
        for (int b = 0; pass == 0 && b < BUCKETS; b++) {
            int64_t own = starts[b];
            starts[b] = sum;
            sum += own;
        }
    }
    free(starts);
    return OZ_OK;
}

/* The part of a body's axis about which nothing of it is cut away. */
static void find_kept(const Upload *upload, const OzBody *body, bool is_cut, double kept[2])
{
    double middle = -upload->offset, rise = 0;
    kept[0] = -(double)body->half_shaft;
    kept[1] = (double)body->half_shaft;
    if (!is_cut) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        middle += upload->inward[k] * (double)body->centre[k];
        rise += upload->inward[k] * (double)body->axis[k];
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
    bool is_cut = upload->look->views[view] == OZ_VIEW_CUT;
    memset(upload->seen_count, 0, sizeof upload->seen_count);
    OZ_PASS(oz_occlusion_begin(&occlusion, upload->camera, view, box));
    for (int64_t k = 0; k < upload->snapshot->count; k++) {
        int64_t i = upload->order[k];
        const OzBody *body = &upload->bodies[i];
        Side side = is_cut ? side_of(upload->snapshot, upload->look, i) : SIDE_BEHIND;
        if (side == SIDE_FRONT ? upload->look->cut_outlines
                               : !oz_occlusion_hides(&occlusion, body)) {
            double kept[2];
            upload->seen[side][upload->seen_count[side]++] = i;
            find_kept(upload, body, side != SIDE_BEHIND, kept);
            oz_occlusion_add(&occlusion, body, kept[0], kept[1]);
        }
    }
    oz_occlusion_free(&occlusion);
    return OZ_OK;
}

static OzStatus add_records(Upload *upload, Side side)
{
    int64_t count = upload->seen_count[side], wanted = upload->record_count + count;
    if (wanted > upload->record_capacity) {
        OZ_PASS(oz_memory_grow((void **)&upload->records, (size_t)upload->record_capacity,
                               (size_t)(2 * wanted), sizeof *upload->records, "grains to draw"));
        upload->record_capacity = 2 * wanted;
    }
    for (int64_t k = 0; k < count; k++) {
        int64_t i = upload->seen[side][k];
        Record *record = &upload->records[upload->record_count++];
        *record = (Record){.body = upload->bodies[i]};
        oz_palette_grain(upload->snapshot, upload->look, i, record->colour);
    }
    return OZ_OK;
}

static OzStatus add_view(Upload *upload, OzCapsules *capsules, int view)
{
    const OzCamera *camera = upload->camera;
    OzBox box = oz_camera_box(camera, upload->look, view, capsules->low, capsules->high);
    OzCapsuleRanges *ranges = &capsules->views[view];
    OZ_PASS(see_view(upload, view, &box));
    ranges->first = upload->record_count;
    OZ_PASS(add_records(upload, SIDE_BEHIND));
    ranges->crossing = upload->record_count;
    OZ_PASS(add_records(upload, SIDE_CROSSING));
    ranges->outlined = upload->record_count;
    OZ_PASS(add_records(upload, SIDE_FRONT));
    ranges->end = upload->record_count;
    return OZ_OK;
}

static void find_cut(const OzLook *look, const OzCamera *camera, double inward[3], double *offset)
{
    double cut[3] = {look->centre[0], look->cut, camera->centre[2]}, on_plane[3];
    oz_camera_see(camera, cut, on_plane);
    oz_camera_turn(camera, (const double[3]){0, 1, 0}, inward);
    *offset = inward[0] * on_plane[0] + inward[1] * on_plane[1] + inward[2] * on_plane[2];
}

static OzStatus begin_upload(Upload *upload, OzCapsules *capsules)
{
    int64_t count = upload->snapshot->count;
    OZ_PASS(OZ_NEW(&upload->bodies, count));
    OZ_PASS(OZ_NEW(&upload->order, count));
    for (int side = 0; side < SIDE_COUNT; side++) {
        OZ_PASS(OZ_NEW(&upload->seen[side], count));
    }
    find_cut(upload->look, upload->camera, upload->inward, &upload->offset);
    memset(capsules->low, 0, sizeof capsules->low);
    memset(capsules->high, 0, sizeof capsules->high);
    for (int64_t i = 0; i < count; i++) {
        upload->bodies[i] = body_of(upload->snapshot, upload->camera, i);
        reach_for(capsules, &upload->bodies[i], upload->camera);
    }
    return sort_by_depth(upload);
}

static void end_upload(Upload *upload)
{
    free(upload->bodies);
    free(upload->order);
    for (int side = 0; side < SIDE_COUNT; side++) {
        free(upload->seen[side]);
    }
    free(upload->records);
}

OzStatus oz_capsules_upload(OzCapsules *capsules, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera)
{
    const OzGl *gl = capsules->gl;
    OzStatus status = OZ_OK;
    Upload upload = {.snapshot = snapshot, .look = look, .camera = camera};
    OZ_TRY(begin_upload(&upload, capsules));
    for (int view = 0; view < look->view_count; view++) {
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
                       const OzLook *look, const OzCamera *camera, const float lens[2])
{
    const OzGl *gl = capsules->gl;
    double inward[3], offset = 0;
    if (end <= first) {
        return;
    }
    find_cut(look, camera, inward, &offset);
    gl->UseProgram(program);
    gl->Uniform4f(gl->GetUniformLocation(program, "lens"), lens[0], lens[1],
                  (float)camera->distance, (float)camera->depth);
    gl->Uniform1f(gl->GetUniformLocation(program, "pixel"), (float)(1 / camera->scale));
    gl->Uniform4f(gl->GetUniformLocation(program, "plane"), (float)inward[0], (float)inward[1],
                  (float)inward[2], (float)offset);
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
                          const OzLook *look, const OzCamera *camera, const float lens[2])
{
    const OzGl *gl = capsules->gl;
    gl->DepthMask(GL_FALSE);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    draw_range(capsules, capsules->outlined, ranges->outlined, ranges->end, look, camera, lens);
    gl->Disable(GL_BLEND);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthMask(GL_TRUE);
}

void oz_capsules_draw(const OzCapsules *capsules, int view, const OzLook *look,
                      const OzCamera *camera, double viewport_width, double viewport_height)
{
    const OzCapsuleRanges *ranges = &capsules->views[view];
    float lens[2] = {(float)(2 * camera->scale / viewport_width),
                     (float)(2 * camera->scale / viewport_height)};
    draw_range(capsules, capsules->whole, ranges->first, ranges->crossing, look, camera, lens);
    draw_range(capsules, capsules->sliced, ranges->crossing, ranges->outlined, look, camera, lens);
    draw_outlines(capsules, ranges, look, camera, lens);
}
