/* Capsule records, sorted by the side of the cut plane on which they lie, and their two programs.
 * Knows nothing of containers, text or files. */
#include "draw/capsules.h"

#include "base/memory.h"
#include "draw/palette.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* One grain as the vertex shader reads it, in view coordinates. */
typedef struct Record {
    GLfloat centre[3], radius;
    GLfloat axis[3], half_shaft;
    GLfloat colour[3], unused;
} Record;

typedef enum Side { SIDE_CROSSING, SIDE_BEHIND, SIDE_FRONT, SIDE_COUNT } Side;

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

static Record record_of(const OzSnapshot *snapshot, const OzLook *look, const OzCamera *camera,
                        int64_t i)
{
    Record record = {.radius = (GLfloat)(0.5 * snapshot->grains->diameter[i] / camera->unit),
                     .half_shaft = (GLfloat)(0.5 * snapshot->grains->length[i] / camera->unit)};
    double centre[3], axis[3];
    oz_camera_see(camera, &snapshot->position[3 * i], centre);
    oz_camera_turn(camera, &snapshot->axis[3 * i], axis);
    for (int k = 0; k < 3; k++) {
        record.centre[k] = (GLfloat)centre[k];
        record.axis[k] = (GLfloat)axis[k];
    }
    oz_palette_grain(snapshot, look, i, record.colour);
    return record;
}

/* Widens the reach by a grain, with room for its looking larger in front. */
static void reach_for(OzCapsules *capsules, const Record *record, const OzCamera *camera)
{
    double radius = (double)record->radius + (double)record->half_shaft;
    double gap = camera->distance - (double)record->centre[2] - radius;
    double nearer = camera->distance / fmax(gap, 0.1 * camera->distance);
    for (int k = 0; k < 2; k++) {
        double middle = nearer * (double)record->centre[k];
        capsules->low[k] = fmin(capsules->low[k], middle - nearer * radius);
        capsules->high[k] = fmax(capsules->high[k], middle + nearer * radius);
    }
}

OzStatus oz_capsules_upload(OzCapsules *capsules, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera)
{
    const OzGl *gl = capsules->gl;
    Record *records = NULL;
    int64_t counts[SIDE_COUNT] = {0};
    OZ_PASS(OZ_NEW(&records, snapshot->count));
    for (int64_t i = 0; i < snapshot->count; i++) {
        counts[side_of(snapshot, look, i)]++;
    }
    int64_t next[SIDE_COUNT] = {0, counts[0], counts[0] + counts[1]};
    memset(capsules->low, 0, sizeof capsules->low);
    memset(capsules->high, 0, sizeof capsules->high);
    for (int64_t i = 0; i < snapshot->count; i++) {
        Record *record = &records[next[side_of(snapshot, look, i)]++];
        *record = record_of(snapshot, look, camera, i);
        reach_for(capsules, record, camera);
    }
    capsules->crossing = counts[SIDE_CROSSING];
    capsules->behind = counts[SIDE_CROSSING] + counts[SIDE_BEHIND];
    capsules->count = snapshot->count;
    gl->BindBuffer(GL_ARRAY_BUFFER, capsules->buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)snapshot->count * sizeof *records),
                   records, GL_STREAM_DRAW);
    free(records);
    return oz_gl_check(gl, "sending the grains");
}

void oz_capsules_find_samples(OzCapsules *capsules, int sample_count)
{
    memset(capsules->samples, 0, sizeof capsules->samples);
    for (int i = 0; i < sample_count && i < 4; i++) {
        GLfloat *place = &capsules->samples[2 * i];
        capsules->gl->GetMultisamplefv(GL_SAMPLE_POSITION, (GLuint)i, place);
        place[0] -= 0.5f;
        place[1] -= 0.5f;
    }
}

static void draw_range(const OzCapsules *capsules, GLuint program, int64_t first, int64_t end,
                       const OzLook *look, const OzCamera *camera, const float lens[2])
{
    const OzGl *gl = capsules->gl;
    double cut[3] = {look->centre[0], look->cut, camera->centre[2]}, on_plane[3], inward[3];
    if (end <= first) {
        return;
    }
    oz_camera_see(camera, cut, on_plane);
    oz_camera_turn(camera, (const double[3]){0, 1, 0}, inward);
    double offset = inward[0] * on_plane[0] + inward[1] * on_plane[1] + inward[2] * on_plane[2];
    gl->UseProgram(program);
    gl->Uniform4f(gl->GetUniformLocation(program, "lens"), lens[0], lens[1],
                  (float)camera->distance, (float)camera->depth);
    gl->Uniform1f(gl->GetUniformLocation(program, "pixel"), (float)(1 / camera->scale));
    gl->Uniform2fv(gl->GetUniformLocation(program, "samples"), 4, capsules->samples);
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
static void draw_outlines(const OzCapsules *capsules, const OzLook *look, const OzCamera *camera,
                          const float lens[2])
{
    const OzGl *gl = capsules->gl;
    gl->DepthMask(GL_FALSE);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw_range(capsules, capsules->outlined, capsules->behind, capsules->count, look, camera, lens);
    gl->Disable(GL_BLEND);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthMask(GL_TRUE);
}

void oz_capsules_draw(const OzCapsules *capsules, OzView view, const OzLook *look,
                      const OzCamera *camera, double viewport_width, double viewport_height)
{
    float lens[2] = {(float)(2 * camera->scale / viewport_width),
                     (float)(2 * camera->scale / viewport_height)};
    if (view == OZ_VIEW_CUT) {
        draw_range(capsules, capsules->sliced, 0, capsules->crossing, look, camera, lens);
        draw_range(capsules, capsules->whole, capsules->crossing, capsules->behind, look, camera,
                   lens);
        if (look->cut_outlines) {
            draw_outlines(capsules, look, camera, lens);
        }
    } else {
        draw_range(capsules, capsules->whole, 0, capsules->count, look, camera, lens);
    }
}
