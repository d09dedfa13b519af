/* Triangles of flat grains, gathered on the host. Knows nothing of how a grain is put together
 * beyond its elements, outlines and beams. */
#include "draw/polygons.h"

#include "base/memory.h"
#include "draw/palette.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const float WALL[4] = {0.74f, 0.755f, 0.78f, 1.0f};
static const float BEAM[3] = {0.85f, 0.20f, 0.12f};

enum {
    FAR = 10000,              /* pixels: an edge without outline is never near             */
    SECTORS_LEAST = 12,       /* of a disc, however small                                   */
    SECTORS_MOST = 180,       /* and however large: a tenth of a pixel from round at 600    */
    MARKED_ELEMENTS_MOST = 4, /* grains of more elements turn visibly without a darker one     */
    EVERY_EDGE = 7
};

/* One element about to be added. */
typedef struct Element {
    const OzSnapshot *snapshot;
    const OzCamera *camera;
    int64_t index;
    int edges; /* bits: of 0..2, those with an outline */
    float rgba[4], ink[3];
} Element;

static void describe_corners(const OzGl *gl)
{
    static const GLint sizes[4] = {2, 4, 3, 3};
    static const size_t places[4] = {
        offsetof(OzPolygonCorner, place), offsetof(OzPolygonCorner, rgba),
        offsetof(OzPolygonCorner, ink), offsetof(OzPolygonCorner, inside)};
    for (GLuint i = 0; i < 4; i++) {
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, sizeof(OzPolygonCorner),
                                (const void *)(uintptr_t)places[i]);
    }
}

OzStatus oz_polygons_create(OzPolygons *polygons, const OzGl *gl, const char *source_dir)
{
    memset(polygons, 0, sizeof *polygons);
    polygons->gl = gl;
    OZ_PASS(oz_gl_program(gl, &polygons->program, source_dir, "polygons", ""));
    gl->GenVertexArrays(1, &polygons->vertices);
    gl->BindVertexArray(polygons->vertices);
    gl->GenBuffers(1, &polygons->buffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, polygons->buffer);
    describe_corners(gl);
    return oz_gl_check(gl, "preparing the buffer of flat grains");
}

void oz_polygons_free(OzPolygons *polygons)
{
    if (polygons->gl) {
        polygons->gl->DeleteProgram(polygons->program);
        polygons->gl->DeleteBuffers(1, &polygons->buffer);
        polygons->gl->DeleteVertexArrays(1, &polygons->vertices);
    }
    free(polygons->corners);
    oz_pressed_free(&polygons->pressed);
    memset(polygons, 0, sizeof *polygons);
}

void oz_polygons_clear(OzPolygons *polygons)
{
    polygons->count = 0;
    polygons->status = OZ_OK;
}

static OzPolygonCorner *room_for_triangle(OzPolygons *polygons)
{
    if (polygons->status == OZ_OK && polygons->count + 3 > polygons->capacity) {
        size_t wanted = polygons->capacity ? 2 * polygons->capacity : 3072;
        polygons->status = oz_memory_grow((void **)&polygons->corners, polygons->capacity, wanted,
                                          sizeof *polygons->corners, "triangles of a picture");
        polygons->capacity = polygons->status == OZ_OK ? wanted : polygons->capacity;
    }
    if (polygons->status != OZ_OK) {
        return NULL;
    }
    polygons->count += 3;
    return polygons->corners + polygons->count - 3;
}

/* Pixels from edge e (from corner e to the next) to the corner across it. */
static double height_over(const double view[6], int e, const OzCamera *camera)
{
    const double *a = view + 2 * e, *b = view + 2 * ((e + 1) % 3), *c = view + 2 * ((e + 2) % 3);
    double along[2] = {b[0] - a[0], b[1] - a[1]};
    double twice_area = fabs(along[0] * (c[1] - a[1]) - along[1] * (c[0] - a[0]));
    return camera->scale * twice_area / fmax(hypot(along[0], along[1]), 1e-30);
}

/* A triangle in view coordinates. edges: bits, those with an outline in ink. */
static void add_triangle(OzPolygons *polygons, const double view[6], const float rgba[4],
                         const float *ink, int edges, const OzCamera *camera)
{
    OzPolygonCorner *corner = room_for_triangle(polygons);
    for (int i = 0; corner && i < 3; i++) {
        corner[i].place[0] = (GLfloat)view[2 * i];
        corner[i].place[1] = (GLfloat)view[2 * i + 1];
        memcpy(corner[i].rgba, rgba, sizeof corner[i].rgba);
        memcpy(corner[i].ink, ink, sizeof corner[i].ink);
        for (int e = 0; e < 3; e++) {
            double height = i == (e + 2) % 3 ? height_over(view, e, camera) : 0;
            corner[i].inside[e] = edges & 1 << e ? (GLfloat)height : FAR;
        }
    }
}

static void see(const OzCamera *camera, const double point[2], double view[2])
{
    for (int k = 0; k < 2; k++) {
        view[k] = (point[k] - camera->centre[k]) / camera->unit;
    }
}

static void add_line(OzPolygons *polygons, const OzCamera *camera, const double from[2],
                     const double to[2], double width, const float rgba[4])
{
    double a[2], b[2];
    see(camera, from, a);
    see(camera, to, b);
    double length = fmax(hypot(b[0] - a[0], b[1] - a[1]), 1e-30);
    double half = 0.5 * width / camera->scale / length;
    double x = half * (a[1] - b[1]), y = half * (b[0] - a[0]);
    const double first[6] = {a[0] - x, a[1] - y, b[0] - x, b[1] - y, b[0] + x, b[1] + y};
    const double second[6] = {a[0] - x, a[1] - y, b[0] + x, b[1] + y, a[0] + x, a[1] + y};
    add_triangle(polygons, first, rgba, rgba, 0, camera);
    add_triangle(polygons, second, rgba, rgba, 0, camera);
}

/* So many that the rim lies within a tenth of a pixel of round. */
static int sectors_of(double radius_pixels)
{
    double count = PI / sqrt(0.2 / fmax(radius_pixels, 1e-3));
    return (int)fmin(fmax(ceil(count), SECTORS_LEAST), SECTORS_MOST);
}

/* A fan with the disc's area. */
static void add_fan(OzPolygons *polygons, const Element *element, const double centre[2],
                    double radius)
{
    int sectors = sectors_of(radius * element->camera->scale);
    double turn = 2 * PI / sectors, reach = radius * sqrt(turn / sin(turn));
    for (int i = 0; i < sectors; i++) {
        const double view[6] = {centre[0],
                                centre[1],
                                centre[0] + reach * cos(turn * i),
                                centre[1] + reach * sin(turn * i),
                                centre[0] + reach * cos(turn * (i + 1)),
                                centre[1] + reach * sin(turn * (i + 1))};
        add_triangle(polygons, view, element->rgba, element->ink, 1 << 1, element->camera);
    }
}

static double line_width(const OzCamera *camera)
{
    return fmax(1.0, 0.002 * fmax(camera->content_width, camera->content_height));
}

static void add_disc(OzPolygons *polygons, const Element *element)
{
    const OzSnapshot *s = element->snapshot;
    const double *centre = s->element_position + 2 * element->index;
    double radius = s->grains->elements->radius[element->index],
           angle = s->element_angle[element->index];
    double view[2], width = line_width(element->camera);
    double end = radius - 0.5 * width * element->camera->unit / element->camera->scale;
    double rim[2] = {centre[0] + end * cos(angle), centre[1] + end * sin(angle)};
    float ink[4] = {element->ink[0], element->ink[1], element->ink[2], element->rgba[3]};
    see(element->camera, centre, view);
    add_fan(polygons, element, view, radius / element->camera->unit);
    add_line(polygons, element->camera, centre, rim, 1.5 * width, ink);
}

static void add_element(OzPolygons *polygons, const Element *element)
{
    const OzSnapshot *s = element->snapshot;
    const OzElements *elements = s->grains->elements;
    int64_t i = element->index;
    double corners[6], view[6];
    if (elements->radius[i] > 0) {
        add_disc(polygons, element);
        return;
    }
    oz_elements_corners(elements, i, s->element_position + 2 * i, s->element_angle[i], corners);
    for (int k = 0; k < 3; k++) {
        see(element->camera, corners + 2 * k, view + 2 * k);
    }
    add_triangle(polygons, view, element->rgba, element->ink, element->edges, element->camera);
}

/* The outlined edges of element i; *next moves on over the list, which is in order of elements. */
static int edges_of(const OzElements *elements, int64_t i, int64_t *next)
{
    int edges = 0;
    for (; *next < elements->outline_count && elements->outline_element[*next] <= i; ++*next) {
        edges |= elements->outline_element[*next] == i ? 1 << elements->outline_edge[*next] : 0;
    }
    return edges & EVERY_EDGE;
}

/* Light on dark fills and dark on others, so that neighbours of one colour are told apart. */
static void choose_ink(const float rgb[3], float ink[3])
{
    const float share = 0.62f;
    bool dark = 0.30f * rgb[0] + 0.59f * rgb[1] + 0.11f * rgb[2] < 0.30f;
    for (int k = 0; k < 3; k++) {
        ink[k] = (1 - share) * rgb[k] + share * (dark ? 1.0f : 0.06f);
    }
}

/* Lines along the outer edges of a wall's element, to both sides. */
static void add_edges(OzPolygons *polygons, const Element *element)
{
    const OzSnapshot *s = element->snapshot;
    int64_t i = element->index;
    double corners[6];
    float ink[4] = {element->ink[0], element->ink[1], element->ink[2], 1};
    oz_elements_corners(s->grains->elements, i, s->element_position + 2 * i, s->element_angle[i],
                        corners);
    for (int e = 0; e < 3; e++) {
        if (element->edges & 1 << e) {
            add_line(polygons, element->camera, corners + 2 * e, corners + 2 * ((e + 1) % 3),
                     2 * line_width(element->camera), ink);
        }
    }
}

/* The lines come first, so that where parts of walls overlap the fills hide them. */
void oz_polygons_add_walls(OzPolygons *polygons, const OzSnapshot *snapshot, const OzLook *look,
                           const OzCamera *camera)
{
    const OzElements *elements = snapshot->grains->elements;
    Element element = {.snapshot = snapshot, .camera = camera};
    memcpy(element.rgba, WALL, sizeof element.rgba);
    choose_ink(WALL, element.ink);
    for (int fill = look->outlines ? 0 : 1; fill < 2; fill++) {
        int64_t next = 0;
        for (int64_t i = elements->free_count; i < elements->count; i++) {
            element.index = i;
            element.edges = fill ? 0 : edges_of(elements, i, &next);
            if (oz_snapshot_has_wall(snapshot, elements->body[i] - elements->grain_count)) {
                (fill ? add_element : add_edges)(polygons, &element);
            }
        }
    }
}

static void add_beams(OzPolygons *polygons, const OzSnapshot *snapshot, const OzCamera *camera,
                      double presence)
{
    const OzElements *elements = snapshot->grains->elements;
    const float rgba[4] = {BEAM[0], BEAM[1], BEAM[2], (float)presence};
    for (int64_t k = 0; k < elements->beam_count; k++) {
        if (!snapshot->wear.whole || snapshot->wear.whole[k] > 0) {
            add_line(polygons, camera, snapshot->element_position + 2 * elements->beam_a[k],
                     snapshot->element_position + 2 * elements->beam_b[k], 1.4 * line_width(camera),
                     rgba);
        }
    }
}

/* Whether an element shows by its darker colour how its grain has turned. */
static bool is_mark(const OzElements *elements, int64_t grain, int64_t i)
{
    int64_t count = elements->first[grain + 1] - elements->first[grain];
    return i == oz_elements_at(elements, elements->first[grain]) && count > 1 &&
           count <= MARKED_ELEMENTS_MOST;
}

void oz_polygons_add_grains(OzPolygons *polygons, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera, double presence)
{
    const OzElements *elements = snapshot->grains->elements;
    Element element = {.snapshot = snapshot, .camera = camera, .rgba = {0, 0, 0, (float)presence}};
    OzStatus status = oz_pressed_find(&polygons->pressed, snapshot, look);
    polygons->status = polygons->status == OZ_OK ? status : polygons->status;
    for (int64_t g = 0; polygons->status == OZ_OK && g < elements->grain_count; g++) {
        float rgb[3];
        oz_palette_grain(snapshot, look, polygons->pressed.share, g, rgb);
        choose_ink(rgb, element.ink);
        for (int64_t n = elements->first[g]; n < elements->first[g + 1]; n++) {
            int64_t i = oz_elements_at(elements, n);
            float shade = is_mark(elements, g, i) ? 0.6f : 1.0f;
            for (int k = 0; k < 3; k++) {
                element.rgba[k] = shade * rgb[k];
            }
            element.index = i;
            element.edges = oz_elements_outer_edges(elements, i);
            add_element(polygons, &element);
        }
    }
    if (look->beams) {
        add_beams(polygons, snapshot, camera, presence);
    }
}

void oz_polygons_add_chains(OzPolygons *polygons, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera)
{
    static const float rgba[4] = {0.70f, 0.13f, 0.10f, 0.85f};
    double pixels = 0;
    for (int64_t g = 0; g < snapshot->count; g++) {
        pixels += snapshot->grains->diameter[g] / (double)snapshot->count;
    }
    pixels *= camera->scale / camera->unit;
    for (int64_t i = 0; i < polygons->pressed.chain_count; i++) {
        const OzChain *chain = &polygons->pressed.chains[i];
        add_line(polygons, camera, chain->from, chain->to,
                 fmax(pixels * oz_pressed_width(chain, look), line_width(camera)), rgba);
    }
}

OzStatus oz_polygons_draw(const OzPolygons *polygons, const OzLook *look, const OzCamera *camera,
                          double viewport_width, double viewport_height)
{
    const OzGl *gl = polygons->gl;
    GLuint program = polygons->program;
    if (polygons->status != OZ_OK) {
        return polygons->status;
    }
    gl->UseProgram(program);
    gl->Uniform4f(gl->GetUniformLocation(program, "lens"),
                  (float)(2 * camera->scale / viewport_width),
                  (float)(2 * camera->scale / viewport_height), (float)camera->distance,
                  (float)camera->depth);
    gl->Uniform1f(gl->GetUniformLocation(program, "line"),
                  look->outlines ? (float)line_width(camera) : 0);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->BindVertexArray(polygons->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, polygons->buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(polygons->count * sizeof *polygons->corners),
                   polygons->corners, GL_STREAM_DRAW);
    gl->DrawArrays(GL_TRIANGLES, 0, (GLsizei)polygons->count);
    gl->Disable(GL_BLEND);
    return oz_gl_check(gl, "drawing flat grains");
}
