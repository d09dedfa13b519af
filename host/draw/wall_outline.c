/* Lines on walls. A line lies before the grains where the wall's outer side faces the eye. */
#include "draw/wall_outline.h"

#include "draw/wall_levels.h"
#include "model/motion.h"
#include "scene/boundary.h"
#include "scene/wall_swing.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
enum { AROUND = 96, STAVES = 12, RINGS = 5 };

/* Where lines go. */
typedef struct Pen {
    const OzWallOutline *outline;
    OzMesh *behind, *before;
    const float *rgba;
} Pen;

/* outwards: away from the grains, of any length. */
static void draw_line(const Pen *pen, const double from[3], const double to[3],
                      const double outwards[3])
{
    const OzWallOutline *o = pen->outline;
    double seen[3], slack = 1e-6 * o->camera->unit;
    if (o->is_cut && fmin(from[1], to[1]) < o->cut - slack) {
        return;
    }
    oz_camera_turn(o->camera, outwards, seen);
    oz_mesh_line(seen[2] > 1e-9 ? pen->before : pen->behind, o->camera, from, to, o->line_width,
                 pen->rgba);
}

/* A box of a middle and half sides, turned about a point: frame is that of kernels/wall_swing.h,
 * and NULL of one that is not. */
typedef struct Box {
    double middle[3], half[3];
    const double *frame;
} Box;

/* A direction that is given along the box's own sides, as it is now. */
static void turn(const Box *box, double v[3])
{
    if (box->frame) {
        oz_wall_swing_turn(box->frame, v);
    }
}

/* Leaves of a line what lies behind a cut; false where nothing does. */
static bool cut_line(double ends[2][3], double cut)
{
    for (int e = 0; e < 2; e++) {
        const double *other = ends[1 - e];
        double share = (cut - ends[e][1]) / (other[1] - ends[e][1]);
        for (int c = 0; c < 3 && ends[e][1] < cut && other[1] > cut; c++) {
            int k = (c + 2) % 3; /* y, which is asked for, last */
            ends[e][k] = k == 1 ? cut : ends[e][k] + share * (other[k] - ends[e][k]);
        }
    }
    return ends[0][1] >= cut && ends[1][1] >= cut;
}

/* The edge along side k at the sides a and b (-1 or 1) of the other two. */
static void draw_edge(const Pen *pen, const Box *box, int k, const double sides[2])
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    double ends[2][3], outwards[3] = {0};
    for (int e = 0; e < 2; e++) {
        ends[e][k] = e ? box->half[k] : -box->half[k];
        ends[e][i] = sides[0] * box->half[i];
        ends[e][j] = sides[1] * box->half[j];
        turn(box, ends[e]);
        for (int c = 0; c < 3; c++) {
            ends[e][c] += box->middle[c];
        }
    }
    outwards[i] = sides[0];
    outwards[j] = sides[1];
    turn(box, outwards);
    bool is_cut = pen->outline->is_cut && box->frame;
    if (!is_cut || cut_line(ends, pen->outline->cut)) {
        draw_line(pen, ends[0], ends[1], outwards);
    }
}

static void draw_edges(const Pen *pen, const Box *box)
{
    for (int k = 0; k < 3; k++) {
        for (int s = 0; s < 4; s++) {
            draw_edge(pen, box, k, (double[2]){s & 1 ? 1 : -1, s & 2 ? 1 : -1});
        }
    }
}

static void draw_box(const Pen *pen, const OzWall *wall, double angle, const double shift[3])
{
    OzWallSwing swing = oz_wall_swing_at(wall, angle, 0);
    Box box = {.frame = oz_wall_swing_has(wall) ? swing.frame : NULL};
    double up[3] = {0, 0, wall->size[2] / 2};
    turn(&box, up);
    for (int k = 0; k < 3; k++) {
        box.half[k] = wall->size[k] / 2;
        box.middle[k] = wall->point[k] + shift[k] + swing.away[k] + up[k];
    }
    draw_edges(pen, &box);
}

/* A cylinder's axis, two directions across it, and from where to where it is drawn. */
typedef struct Barrel {
    double axis[3], across[2][3], point[3], radius, low, high;
} Barrel;

static Barrel make_barrel(const OzWallOutline *o, const OzWall *wall, const double shift[3])
{
    Barrel b = {.radius = wall->diameter / 2, .high = wall->length};
    if (wall->length == 0) {
        b.low = -o->reach;
        b.high = o->reach;
    }
    for (int k = 0; k < 3; k++) {
        b.axis[k] = wall->axis[k];
        b.point[k] = wall->point[k] + shift[k];
    }
    oz_wall_shape_across(b.axis, b.across[0], b.across[1]);
    return b;
}

/* The place at an angle and so far along; outwards receives its direction from the axis. */
static void find_place(const Barrel *b, double angle, double along, double place[3],
                       double outwards[3])
{
    for (int k = 0; k < 3; k++) {
        outwards[k] = cos(angle) * b->across[0][k] + sin(angle) * b->across[1][k];
        place[k] = b->point[k] + along * b->axis[k] + b->radius * outwards[k];
    }
}

static void draw_barrel(const Pen *pen, const Barrel *b, double turned)
{
    double from[3], to[3], outwards[3];
    for (int r = 0; r < RINGS; r++) {
        double along = b->low + (b->high - b->low) * r / (RINGS - 1);
        for (int i = 0; i < AROUND; i++) {
            find_place(b, 2 * PI * i / AROUND, along, from, outwards);
            find_place(b, 2 * PI * (i + 1) / AROUND, along, to, outwards);
            draw_line(pen, from, to, outwards);
        }
    }
    for (int i = 0; i < STAVES; i++) {
        double angle = turned + 2 * PI * i / STAVES;
        find_place(b, angle, b->low, from, outwards);
        find_place(b, angle, b->high, to, outwards);
        draw_line(pen, from, to, outwards);
    }
}

static void draw_levels(const Pen *pen, const OzWall *wall, double offset)
{
    const OzWallOutline *o = pen->outline;
    OzWallLevels levels = {.wall = wall,
                           .offset = offset,
                           .camera = o->camera,
                           .low = o->low,
                           .high = o->high,
                           .line_width = o->line_width,
                           .is_cut = o->is_cut};
    oz_wall_levels_add(&levels, pen->behind, pen->before, pen->rgba);
}

void oz_wall_outline_add_cell(const OzWallOutline *o, OzMesh *behind, OzMesh *before,
                              const float rgba[4])
{
    Pen pen = {o, behind, before, rgba};
    Box box = {.frame = NULL};
    for (int k = 0; k < 3; k++) {
        double period = oz_boundary_period(&o->snapshot->scene->boundary, k);
        bool is_height = k == 2 && period == 0;
        box.middle[k] = is_height ? (o->low + o->high) / 2 : 0;
        box.half[k] = is_height ? (o->high - o->low) / 2 : period > 0 ? period / 2 : o->reach / 3;
    }
    draw_edges(&pen, &box);
}

void oz_wall_outline_add(const OzWallOutline *o, int w, OzMesh *behind, OzMesh *before,
                         const float rgba[4])
{
    const OzWall *wall = &o->snapshot->scene->walls[w];
    double shift[3], offset = o->snapshot->wall_offset[w];
    double angle = oz_snapshot_turn(o->snapshot, w);
    Pen pen = {o, behind, before, rgba};
    oz_wall_shape_shift(wall, offset, shift);
    if (oz_wall_shape_is_sheet(wall)) {
        return;
    }
    if (wall->kind == OZ_WALL_BOX) {
        draw_box(&pen, wall, angle, shift);
    } else if (wall->kind == OZ_WALL_CYLINDER) {
        Barrel barrel = make_barrel(o, wall, shift);
        draw_barrel(&pen, &barrel, angle);
    } else {
        draw_levels(&pen, wall, offset);
    }
}
