/* Walls are strips along a line or around a circle, with a tooth on each of their sectors or none.
 * Knows no grains. */
#include "model/element_walls.h"

#include <math.h>
#include <stdbool.h>

static const double PI = 3.14159265358979323846;

enum {
    STRIPS_MOST = 8,
    SMOOTH_DRUM = 72 /* sectors: within a thousandth of the radius of a circle */
};

/* A face from `start` on for `length`, its free side on the left; round: a circle about start,
 * passed counter-clockwise, so that the left is the inside. */
typedef struct Strip {
    double start[2], along[2];
    double from, to; /* m, along it                                        */
    double radius;   /* m, round; 0: straight                              */
    int sectors;
    double depth;     /* m, of a tooth on each sector; 0: none              */
    double thickness; /* m                                                  */
    bool thick_start; /* the triangle with the face is thick there, else at the end */
} Strip;

typedef struct Strips {
    Strip row[STRIPS_MOST];
    int count;
    double thickness;
} Strips;

static double length_of(const OzWall *wall)
{
    double segment = hypot(wall->to[0] - wall->from[0], wall->to[1] - wall->from[1]);
    return fmax(fmax(segment, wall->diameter), fmax(wall->width, wall->height));
}

static double thickness_of(const OzWall *wall, double size)
{
    return wall->thickness > 0 ? wall->thickness : size > 0 ? size : length_of(wall) / 20;
}

/* A face between two points with so much more of it, toothless, before and after. */
static void add_face(Strips *strips, const double a[2], const double b[2], double before,
                     double after, bool thick_start)
{
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    if (length > 0) {
        strips->row[strips->count++] =
            (Strip){.start = {a[0], a[1]},
                    .along = {(b[0] - a[0]) / length, (b[1] - a[1]) / length},
                    .from = -before,
                    .to = length + after,
                    .sectors = 1,
                    .thickness = strips->thickness,
                    .thick_start = thick_start};
    }
}

/* The same with teeth between the points; what goes beyond them is a strip of its own. */
static void add_toothed(Strips *strips, const double a[2], const double b[2], double before,
                        double after, const OzWall *wall)
{
    if (wall->tooth_count == 0) {
        add_face(strips, a, b, before, after, before == 0);
        return;
    }
    add_face(strips, a, b, 0, 0, false);
    Strip *teeth = &strips->row[strips->count - 1], beyond = *teeth;
    teeth->sectors = (int)wall->tooth_count;
    teeth->depth = wall->tooth_depth;
    if (before > 0) {
        beyond.from = -before;
        beyond.to = 0;
        strips->row[strips->count++] = beyond;
    }
    if (after > 0) {
        beyond.from = teeth->to;
        beyond.to = teeth->to + after;
        strips->row[strips->count++] = beyond;
    }
}

static void add_floor(Strips *strips, const OzWall *wall)
{
    double a[2] = {wall->point[0] - wall->width / 2, wall->point[1]};
    double b[2] = {wall->point[0] + wall->width / 2, wall->point[1]};
    add_toothed(strips, a, b, 0, 0, wall);
}

/* Sides and slopes go on beyond the knees, each behind the other's face, as far as where their
 * backs meet: their outer corner is whole, and nothing sticks out of it. */
static void add_hopper(Strips *strips, const OzWall *wall)
{
    double x = wall->point[0], y = wall->point[1];
    double beyond = strips->thickness * tan(0.25 * PI - 0.5 * wall->slope);
    double half = wall->width / 2, gap = wall->opening / 2, rise = (half - gap) * tan(wall->slope);
    double left_top[2] = {x - half, y + wall->height}, left_knee[2] = {x - half, y + rise};
    double left_lip[2] = {x - gap, y}, right_lip[2] = {x + gap, y};
    double right_knee[2] = {x + half, y + rise}, right_top[2] = {x + half, y + wall->height};
    add_face(strips, left_top, left_knee, 0, beyond, true);
    add_toothed(strips, left_knee, left_lip, beyond, 0, wall);
    add_toothed(strips, right_lip, right_knee, 0, beyond, wall);
    add_face(strips, right_knee, right_top, beyond, 0, false);
}

static void add_vessel(Strips *strips, const OzWall *wall)
{
    double x = wall->point[0], y = wall->point[1], half = wall->width / 2, t = strips->thickness;
    double left_top[2] = {x - half, y + wall->height}, left[2] = {x - half, y};
    double right[2] = {x + half, y}, right_top[2] = {x + half, y + wall->height};
    add_face(strips, left_top, left, 0, t, true);
    add_face(strips, left, right, t, t, true);
    add_face(strips, right, right_top, t, 0, false);
}

static void add_drum(Strips *strips, const OzWall *wall)
{
    strips->row[strips->count++] =
        (Strip){.start = {wall->point[0], wall->point[1]},
                .to = PI * wall->diameter,
                .radius = wall->diameter / 2,
                .sectors = wall->tooth_count ? (int)wall->tooth_count : SMOOTH_DRUM,
                .depth = wall->tooth_depth,
                .thickness = strips->thickness};
}

static void add_segment(Strips *strips, const OzWall *wall)
{
    add_face(strips, wall->from, wall->to, 0, 0, true);
}

static void list_strips(Strips *strips, const OzWall *wall)
{
#define ROW(NAME, name, choice, rank) [OZ_WALL_##NAME] = add_##name,
    static void (*const adders[OZ_WALLS_END])(Strips * strips,
                                              const OzWall *wall) = {OZ_TRIGRAINS_WALLS(ROW)};
#undef ROW
    if (adders[wall->kind]) {
        adders[wall->kind](strips, wall);
    }
}

/* The point so far along the strip and so far to its left. */
static void point_at(const Strip *strip, double along, double left, double point[2])
{
    double x = strip->along[0], y = strip->along[1];
    if (strip->radius > 0) {
        double angle = along / strip->radius, radius = strip->radius - left;
        point[0] = strip->start[0] + radius * cos(angle);
        point[1] = strip->start[1] + radius * sin(angle);
    } else {
        point[0] = strip->start[0] + along * x - left * y;
        point[1] = strip->start[1] + along * y + left * x;
    }
}

/* Points across the strip: one more than sectors, except around a circle. */
static int rung_count(const Strip *strip)
{
    return strip->sectors + (strip->radius > 0 ? 0 : 1);
}

static int vertex_count(const Strip *strip)
{
    return 2 * rung_count(strip) + (strip->depth > 0 ? strip->sectors : 0);
}

static int triangle_count(const Strip *strip)
{
    return strip->sectors * (strip->depth > 0 ? 3 : 2);
}

static void put_triangle(OzTriangleSet *triangle_set, int a, int b, int c)
{
    int *corner = triangle_set->triangle + 3 * triangle_set->triangle_count++;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
}

static void put_sector(OzTriangleSet *triangle_set, const Strip *strip, int first, int i)
{
    int next = (i + 1) % rung_count(strip);
    int a = first + 2 * i, b = first + 2 * next, deep_a = a + 1, deep_b = b + 1;
    put_triangle(triangle_set, a, b, strip->thick_start ? deep_a : deep_b);
    put_triangle(triangle_set, strip->thick_start ? b : a, deep_b, deep_a);
    if (strip->depth > 0) {
        double step = (strip->to - strip->from) / strip->sectors;
        point_at(strip, strip->from + (i + 0.5) * step, strip->depth,
                 triangle_set->vertex + 2 * triangle_set->vertex_count);
        put_triangle(triangle_set, a, b, triangle_set->vertex_count++);
    }
}

/* Fills in the strip after what the triangle set holds already. */
static void put_strip(OzTriangleSet *triangle_set, const Strip *strip)
{
    int first = triangle_set->vertex_count;
    double step = (strip->to - strip->from) / strip->sectors;
    for (int i = 0; i < rung_count(strip); i++) {
        double along = strip->from + i * step;
        point_at(strip, along, 0, triangle_set->vertex + 2 * triangle_set->vertex_count++);
        point_at(strip, along, -strip->thickness,
                 triangle_set->vertex + 2 * triangle_set->vertex_count++);
    }
    for (int i = 0; i < strip->sectors; i++) {
        put_sector(triangle_set, strip, first, i);
    }
}

OzStatus oz_element_walls_make(OzTriangleSet *triangle_set, const OzWall *wall, double size)
{
    OzStatus status = OZ_OK;
    Strips strips = {.thickness = thickness_of(wall, size)};
    int vertices = 0, triangles = 0;
    list_strips(&strips, wall);
    for (int i = 0; i < strips.count; i++) {
        vertices += vertex_count(&strips.row[i]);
        triangles += triangle_count(&strips.row[i]);
    }
    OZ_TRY(oz_triangle_set_create(triangle_set, vertices, triangles));
    triangle_set->vertex_count = triangle_set->triangle_count = 0;
    for (int i = 0; i < strips.count; i++) {
        put_strip(triangle_set, &strips.row[i]);
    }
    OZ_TRY(oz_triangle_set_join(triangle_set));
done:
    if (status != OZ_OK) {
        oz_triangle_set_free(triangle_set);
    }
    return status;
}
