/* Sheets in small quads, each cut off at the plane of a cut. */
#include "draw/wall_sheet.h"

#include "scene/wall_mesh.h"
#include "scene/wall_swing.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum { AROUND = 96, STAVES = 12, CORNERS = 5 };

static const float GLASS[3] = {0.60f, 0.69f, 0.80f};
static const float RIM[4] = {0.36f, 0.41f, 0.49f, 0.90f};
static const float STAVE[4] = {0.36f, 0.41f, 0.49f, 0.30f};

/* A quad or what a cut leaves of it: m, world. */
typedef struct Patch {
    double points[CORNERS][3];
    int count;
} Patch;

static void cut_off(Patch *patch, double cut)
{
    Patch kept = {.count = 0};
    for (int i = 0; i < patch->count; i++) {
        const double *a = patch->points[i], *b = patch->points[(i + 1) % patch->count];
        if (a[1] >= cut) {
            memcpy(kept.points[kept.count++], a, sizeof kept.points[0]);
        }
        if ((a[1] >= cut) != (b[1] >= cut)) {
            double share = (cut - a[1]) / (b[1] - a[1]);
            for (int k = 0; k < 3; k++) {
                kept.points[kept.count][k] = a[k] + share * (b[k] - a[k]);
            }
            kept.count++;
        }
    }
    *patch = kept;
}

/* Glass is seen best where one looks along it; where it is cut it has an edge. normal: a unit
 * vector; before: drawn after the grains, which shine through. */
static void add_patch(const OzWallSheet *s, Patch *patch, const double normal[3], bool before)
{
    OzMesh *mesh = before ? s->before : s->behind;
    double seen[3];
    if (s->is_cut) {
        cut_off(patch, s->cut);
    }
    oz_camera_turn(s->camera, normal, seen);
    double edge = pow(1 - fmin(fabs(seen[2]), 1), 3);
    const float rgba[4] = {GLASS[0], GLASS[1], GLASS[2],
                           (float)(before ? 0.10 + 0.22 * edge : 0.22 + 0.22 * edge)};
    for (int i = 0; s->is_cut && i < patch->count; i++) {
        const double *a = patch->points[i], *b = patch->points[(i + 1) % patch->count];
        double slack = 1e-6 * s->camera->unit;
        if (fabs(a[1] - s->cut) < slack && fabs(b[1] - s->cut) < slack) {
            oz_mesh_line(s->before, s->camera, a, b, s->line_width, RIM);
        }
    }
    for (int i = 1; i + 1 < patch->count; i++) {
        const int corners[3] = {0, i, i + 1};
        for (int c = 0; c < 3; c++) {
            double view[3];
            oz_camera_see(s->camera, patch->points[corners[c]], view);
            oz_mesh_corner(mesh, view, rgba);
        }
    }
}

static void add_line(const OzWallSheet *s, const double from[3], const double to[3], bool before,
                     const float rgba[4])
{
    double slack = 1e-6 * s->camera->unit;
    if (!s->is_cut || fmin(from[1], to[1]) >= s->cut - slack) {
        oz_mesh_line(before ? s->before : s->behind, s->camera, from, to, s->line_width, rgba);
    }
}

/* A wall that stands between eye and grains is before them; one whose far side faces the eye from
 * below is a floor to what lies on it. */
static void add_rectangle(const OzWallSheet *s, const OzWallShape *shape, const double point[3],
                          bool has_lines)
{
    double second[3], seen[3];
    Patch patch = {.count = 4};
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        second[k] = shape->normal[a] * shape->across[b] - shape->normal[b] * shape->across[a];
    }
    for (int i = 0; i < 4; i++) {
        double one = (i == 1 || i == 2 ? 1 : -1) * shape->extent[0];
        double other = (i >= 2 ? 1 : -1) * shape->extent[1];
        for (int k = 0; k < 3; k++) {
            patch.points[i][k] = point[k] + one * shape->across[k] + other * second[k];
        }
    }
    oz_camera_turn(s->camera, shape->normal, seen);
    bool before = seen[2] < 0;
    Patch whole = patch;
    add_patch(s, &patch, shape->normal, before);
    if (s->is_cut) {
        cut_off(&whole, s->cut);
    }
    for (int i = 0; has_lines && i < whole.count; i++) {
        add_line(s, whole.points[i], whole.points[(i + 1) % whole.count], before, RIM);
    }
}

/* A band at an angle about its axis: a place on either rim, and the unit vector across it, away
 * from the axis (of a disc: along it). */
typedef struct Stave {
    double rims[2][3], normal[3];
} Stave;

static Stave stave_at(const OzWallShape *shape, const double point[3], double angle)
{
    Stave stave;
    double second[3], length = shape->extent[1], wider = shape->extent[0] - shape->radius;
    double size = sqrt(length * length + wider * wider);
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        second[k] = shape->normal[a] * shape->across[b] - shape->normal[b] * shape->across[a];
    }
    for (int k = 0; k < 3; k++) {
        double out = cos(angle) * shape->across[k] + sin(angle) * second[k];
        stave.rims[0][k] = point[k] + shape->radius * out;
        stave.rims[1][k] = point[k] + shape->extent[0] * out + length * shape->normal[k];
        stave.normal[k] = (length * out - wider * shape->normal[k]) / size;
    }
    return stave;
}

/* Outsides that face the eye are before the grains; a disc has none, and is a floor under most. */
static void add_band(const OzWallSheet *s, const OzWallShape *shape, const double point[3],
                     double turned, bool has_lines)
{
    bool is_flat = shape->extent[1] == 0;
    double seen[3];
    for (int i = 0; i < AROUND; i++) {
        double angle = turned + 2 * PI * i / AROUND, step = 2 * PI / AROUND;
        Stave a = stave_at(shape, point, angle), b = stave_at(shape, point, angle + step);
        Stave middle = stave_at(shape, point, angle + step / 2);
        oz_camera_turn(s->camera, is_flat ? shape->normal : middle.normal, seen);
        bool before = is_flat ? seen[2] < 0 : seen[2] > 0;
        Patch patch = {.count = 4};
        memcpy(patch.points[0], a.rims[0], sizeof a.rims[0]);
        memcpy(patch.points[1], a.rims[1], sizeof a.rims[1]);
        memcpy(patch.points[2], b.rims[1], sizeof b.rims[1]);
        memcpy(patch.points[3], b.rims[0], sizeof b.rims[0]);
        add_patch(s, &patch, middle.normal, before);
        for (int rim = 0; has_lines && rim < 2; rim++) {
            add_line(s, a.rims[rim], b.rims[rim], before, RIM);
        }
        if (has_lines && i % (AROUND / STAVES) == 0) {
            add_line(s, a.rims[0], a.rims[1], before, STAVE);
        }
    }
}

/* Where a corner of a mesh is, whose point and frame (kernels/wall_swing.h) are given. */
static void put_corner(double to[3], const double corner[3], const double point[3],
                       const double frame[9])
{
    memcpy(to, corner, 3 * sizeof *to);
    oz_wall_swing_turn(frame, to);
    for (int k = 0; k < 3; k++) {
        to[k] += point[k];
    }
}

/* Fronts, where grains are, that look away from the eye are before the grains. */
static void add_mesh(const OzWallSheet *s, const OzWallMesh *triangles, const double point[3],
                     const double frame[9])
{
    for (int face = 0; face < triangles->count; face++) {
        const double *corners = triangles->corners + 9 * (size_t)face;
        Patch patch = {.count = 3};
        double normal[3], seen[3];
        oz_mesh_edges_normal(corners, normal);
        oz_wall_swing_turn(frame, normal);
        for (int c = 0; c < 3; c++) {
            put_corner(patch.points[c], corners + 3 * c, point, frame);
        }
        oz_camera_turn(s->camera, normal, seen);
        add_patch(s, &patch, normal, seen[2] < 0);
    }
    for (int crease = 0; crease < triangles->edges.crease_count; crease++) {
        double ends[2][3];
        for (int e = 0; e < 2; e++) {
            const double *corner = triangles->edges.creases + 6 * (size_t)crease + 3 * e;
            put_corner(ends[e], corner, point, frame);
        }
        add_line(s, ends[0], ends[1], false, RIM);
    }
}

/* A tube as a band, and its ends as discs; an endless one is as long as its lines. */
static void add_tube(const OzWallSheet *s, const OzWall *wall, const double point[3])
{
    OzWallShape band = {.kind = OZ_WALL_BAND, .radius = wall->diameter / 2}, end = band;
    double u[3], v[3], far_end[3], from[3], before = wall->length > 0 ? 0 : s->reach;
    oz_wall_shape_axis(wall, band.normal);
    oz_wall_shape_across(band.normal, u, v);
    memcpy(band.across, u, sizeof u);
    band.extent[0] = band.radius;
    band.extent[1] = wall->length + 2 * before;
    for (int k = 0; k < 3; k++) {
        from[k] = point[k] - before * band.normal[k];
    }
    add_band(s, &band, from, 0, false);
    if (wall->ends != OZ_ENDS_CLOSED) {
        return;
    }
    memcpy(end.across, u, sizeof u);
    for (int k = 0; k < 3; k++) {
        far_end[k] = point[k] + wall->length * band.normal[k];
        end.normal[k] = -band.normal[k];
    }
    add_band(s, &end, far_end, 0, false);
    memcpy(end.normal, band.normal, sizeof band.normal);
    add_band(s, &end, point, 0, false);
}

/* A box's sides are planes that face each other: which one is opposite side i, and half the way
 * there, m. */
static int find_opposite(const OzWallShape *sides, int i, double *half)
{
    for (int j = 0; j < OZ_WALL_SIDES_MAX; j++) {
        const double *n = sides[i].normal, *m = sides[j].normal;
        if (n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < -0.5) {
            *half = 0;
            for (int k = 0; k < 3; k++) {
                *half += 0.5 * n[k] * (sides[j].point[k] - sides[i].point[k]);
            }
            return j;
        }
    }
    return i;
}

/* Sides as built, each turned as the wall is now. */
static void add_box(const OzWallSheet *s, const OzWallShape *sides, const OzWall *built,
                    double turn, const double shift[3])
{
    double half[OZ_WALL_SIDES_MAX], middle[3] = {0};
    int opposite[OZ_WALL_SIDES_MAX];
    for (int i = 0; i < OZ_WALL_SIDES_MAX; i++) {
        const double *n = sides[i].normal, *p = sides[i].point;
        opposite[i] = find_opposite(sides, i, &half[i]);
        for (int k = 0; k < 3 && opposite[i] > i; k++) {
            middle[k] += n[k] * (n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + half[i]);
        }
    }
    for (int i = 0; i < OZ_WALL_SIDES_MAX; i++) {
        OzWallShape pane = {.kind = OZ_WALL_RECTANGLE};
        int other[2], count = 0;
        double point[3];
        for (int j = 0; j < OZ_WALL_SIDES_MAX && count < 2; j++) {
            if (opposite[j] > j && j != i && opposite[j] != i) {
                other[count++] = j;
            }
        }
        memcpy(pane.normal, sides[i].normal, sizeof pane.normal);
        memcpy(pane.across, sides[other[0]].normal, sizeof pane.across);
        pane.extent[0] = half[other[0]];
        pane.extent[1] = half[other[1]];
        for (int k = 0; k < 3; k++) {
            point[k] = middle[k] - half[i] * pane.normal[k];
        }
        const OzWallSwing swing = oz_wall_swing_side(built, point, turn, 0);
        oz_wall_swing_turn(swing.frame, pane.normal);
        oz_wall_swing_turn(swing.frame, pane.across);
        for (int k = 0; k < 3; k++) {
            point[k] += swing.away[k] + shift[k];
        }
        add_rectangle(s, &pane, point, false);
    }
}

/* A ball in patches between parallels and meridians. */
static void add_ball(const OzWallSheet *s, const OzWall *wall, const double point[3])
{
    for (int i = 0; i < AROUND / 2 * AROUND; i++) {
        Patch patch = {.count = 4};
        double seen[3], normal[3] = {0, 0, 0};
        for (int c = 0; c < 4; c++) {
            double across = 2 * PI * (i % AROUND + (c == 1 || c == 2)) / AROUND;
            double down = 2 * PI * (i / AROUND + (c >= 2)) / AROUND;
            const double out[3] = {sin(down) * cos(across), sin(down) * sin(across), cos(down)};
            for (int k = 0; k < 3; k++) {
                patch.points[c][k] = point[k] + wall->diameter / 2 * out[k];
                normal[k] += out[k] / 4;
            }
        }
        oz_camera_turn(s->camera, normal, seen);
        add_patch(s, &patch, normal, seen[2] > 0);
    }
}

/* What is no sheet, as the sheets it is like. */
static void add_panes(const OzWallSheet *s, int w)
{
    const OzWall *built = &s->snapshot->scene->walls[w];
    double turn = oz_snapshot_turn(s->snapshot, w);
    const OzWall wall = oz_wall_swing_turned(built, turn);
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    double shift[3], point[3];
    oz_wall_shape_shift(&wall, s->snapshot->wall_offset[w], shift);
    for (int k = 0; k < 3; k++) {
        point[k] = wall.point[k] + shift[k];
    }
    if (wall.kind == OZ_WALL_BOX && oz_wall_shape_sides(built, sides) == OZ_WALL_SIDES_MAX) {
        add_box(s, sides, built, turn, shift);
    } else if (wall.kind == OZ_WALL_CYLINDER && wall.side != OZ_SIDE_OUTSIDE) {
        add_tube(s, &wall, point);
    } else if (wall.kind == OZ_WALL_SPHERE) {
        add_ball(s, &wall, point);
    }
}

void oz_wall_sheet_add(const OzWallSheet *s, int w)
{
    const OzWall *built = &s->snapshot->scene->walls[w];
    double turn = oz_snapshot_turn(s->snapshot, w);
    const OzWall turned = oz_wall_swing_turned(built, turn), *wall = &turned;
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    double point[3];
    oz_wall_shape_sides(wall, sides);
    const OzWallShape shape = sides[0];
    oz_wall_shape_shift(wall, s->snapshot->wall_offset[w], point);
    for (int k = 0; k < 3; k++) {
        point[k] += wall->point[k];
    }
    if (!oz_wall_shape_is_sheet(built)) {
        add_panes(s, w);
    } else if (wall->kind == OZ_WALL_MESH) {
        add_mesh(s, wall->mesh, point, oz_wall_swing_at(built, turn, 0).frame);
    } else if (wall->kind == OZ_WALL_RECTANGLE) {
        add_rectangle(s, &shape, point, true);
    } else {
        add_band(s, &shape, point, oz_wall_swing_has(built) ? 0 : turn, true);
    }
}
