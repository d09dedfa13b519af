/* Surfaces in small patches. Planes cut them off one after the other, and each closes the body
 * again with a flat face, patch by patch as they come: a convex section is a fan about its first
 * corner. */
#include "draw/obstacle.h"

#include "scene/wall_swing.h"

#include "kernels/layout.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum {
    AROUND = 96,              /* of a circle: as those of other walls  */
    STAVES = 12,              /* lines that show how a cylinder turns  */
    CORNERS = 12,             /* a quad's, and one more for each plane that meets it */
    PLANES = OZ_WALLS_MAX + 7 /* sides of walls, of the box, and the cut */
};

static const double GREY[3] = {0.73, 0.75, 0.78};
static const double LIGHT[3] = {-0.41, 0.58, 0.70}; /* as on grains (draw/raster_row.c) */
static const float SECTION[4] = {0.80f, 0.82f, 0.85f, 1};
static const float RIM[4] = {0.36f, 0.41f, 0.49f, 0.90f};
static const float STAVE[4] = {0.36f, 0.41f, 0.49f, 0.45f};

/* What lies on its normal's side is kept. */
typedef struct Plane {
    double point[3], normal[3];
    bool is_cut;      /* that of the view */
    bool has_anchor;  /* its section has begun */
    double anchor[3]; /* m: the section's first corner */
} Plane;

typedef struct Body {
    const OzObstacle *o;
    Plane planes[PLANES];
    int plane_count;
} Body;

/* m, world; normals: unit vectors outwards. */
typedef struct Patch {
    double points[CORNERS][3], normals[CORNERS][3];
    int count;
    bool is_section;
} Patch;

/* Seen if one of the two faces beside it is. */
typedef struct Line {
    double ends[2][3], normals[2][3];
    const float *rgba;
} Line;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void mix(double to[3], const double a[3], const double b[3], double share)
{
    for (int k = 0; k < 3; k++) {
        to[k] = a[k] + share * (b[k] - a[k]);
    }
}

static double height(const Plane *plane, const double point[3])
{
    double from[3];
    for (int k = 0; k < 3; k++) {
        from[k] = point[k] - plane->point[k];
    }
    return dot(plane->normal, from);
}

/* Cosine of the angle between the normal and the way to the eye; seen, unless NULL, receives the
 * normal in view coordinates. */
static double facing(const OzCamera *camera, const double point[3], const double normal[3],
                     double seen[3])
{
    double place[3], turned[3];
    oz_camera_see(camera, point, place);
    oz_camera_turn(camera, normal, turned);
    double way[3] = {-place[0], -place[1], camera->distance - place[2]};
    if (seen) {
        memcpy(seen, turned, sizeof turned);
    }
    return dot(turned, way) / sqrt(dot(way, way));
}

/* Soft light from the upper left, a sky from above, edges darkened: as grains have. */
static void shade(float rgba[4], const double seen[3], double towards)
{
    double edge = fmin(fmax(towards, 0), 1);
    double light = 0.58 + 0.42 * fmax(dot(seen, LIGHT), 0) + 0.10 * seen[1];
    light *= 0.42 + (1.10 - 0.42) * edge * (2 - edge);
    for (int k = 0; k < 3; k++) {
        rgba[k] = (float)fmin(GREY[k] * light, 1);
    }
    rgba[3] = 1;
}

static void draw_line(const Body *body, const Line *line)
{
    const OzObstacle *o = body->o;
    bool is_seen = facing(o->camera, line->ends[0], line->normals[0], NULL) > 0 ||
                   facing(o->camera, line->ends[0], line->normals[1], NULL) > 0;
    if (is_seen) {
        oz_mesh_line(o->lines, o->camera, line->ends[0], line->ends[1], o->line_width, line->rgba);
    }
}

/* The outline runs where the surface turns away from the eye. */
static void draw_outline(const Body *body, const Patch *patch, const double towards[CORNERS])
{
    const OzObstacle *o = body->o;
    double ends[2][3];
    int found = 0;
    for (int i = 0; i < patch->count && found < 2; i++) {
        int next = (i + 1) % patch->count;
        if ((towards[i] > 0) != (towards[next] > 0)) {
            mix(ends[found++], patch->points[i], patch->points[next],
                towards[i] / (towards[i] - towards[next]));
        }
    }
    if (found == 2) {
        oz_mesh_line(o->lines, o->camera, ends[0], ends[1], o->line_width, RIM);
    }
}

static void draw_patch(const Body *body, const Patch *patch)
{
    const OzCamera *camera = body->o->camera;
    double towards[CORNERS], views[CORNERS][3], most = -1;
    float colours[CORNERS][4];
    for (int i = 0; i < patch->count; i++) {
        double seen[3];
        towards[i] = facing(camera, patch->points[i], patch->normals[i], seen);
        most = fmax(most, towards[i]);
        oz_camera_see(camera, patch->points[i], views[i]);
        shade(colours[i], seen, towards[i]);
    }
    for (int i = 1; i + 1 < patch->count && most > 0; i++) {
        const int corners[3] = {0, i, i + 1};
        for (int c = 0; c < 3; c++) {
            oz_mesh_corner(body->o->solid, views[corners[c]],
                           patch->is_section ? SECTION : colours[corners[c]]);
        }
    }
    draw_outline(body, patch, towards);
}

/* Cuts off what lies behind a plane; true where that leaves an edge. */
static bool cut_patch(Patch *patch, const Plane *plane, double edge[2][3])
{
    Patch kept = {.is_section = patch->is_section};
    int found = 0;
    for (int i = 0; i < patch->count && kept.count + 1 < CORNERS; i++) {
        int next = (i + 1) % patch->count;
        double one = height(plane, patch->points[i]), other = height(plane, patch->points[next]);
        if (one >= 0) {
            memcpy(kept.points[kept.count], patch->points[i], sizeof kept.points[0]);
            memcpy(kept.normals[kept.count++], patch->normals[i], sizeof kept.normals[0]);
        }
        if ((one >= 0) != (other >= 0)) {
            double share = one / (one - other), *at = kept.points[kept.count];
            mix(at, patch->points[i], patch->points[next], share);
            mix(kept.normals[kept.count++], patch->normals[i], patch->normals[next], share);
            memcpy(edge[found < 2 ? found++ : 1], at, 3 * sizeof *at);
        }
    }
    *patch = kept;
    return found == 2;
}

static void add_line(const Body *body, Line line, int from)
{
    for (int k = from; k < body->plane_count; k++) {
        double heights[2];
        for (int e = 0; e < 2; e++) {
            heights[e] = height(&body->planes[k], line.ends[e]);
        }
        if (heights[0] < 0 && heights[1] < 0) {
            return;
        }
        for (int e = 0; e < 2; e++) {
            double share = heights[e] / (heights[e] - heights[1 - e]);
            if (heights[e] < 0) {
                mix(line.ends[e], line.ends[e], line.ends[1 - e], share);
            }
        }
    }
    draw_line(body, &line);
}

/* A part of the face with which a plane closes the body. */
static Patch part_of_face(Plane *plane, double edge[2][3])
{
    Patch part = {.count = 3, .is_section = plane->is_cut};
    if (!plane->has_anchor) {
        memcpy(plane->anchor, edge[0], sizeof plane->anchor);
        plane->has_anchor = true;
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            part.points[i][k] = i == 0 ? plane->anchor[k] : edge[i - 1][k];
            part.normals[i][k] = -plane->normal[k];
        }
    }
    return part;
}

/* Adds what planes, from this one on, leave of a patch, and the faces that they make. */
static void add_patch(Body *body, Patch patch, int from)
{
    for (int k = from; k < body->plane_count && patch.count > 0; k++) {
        double edge[2][3];
        Line rim = {.rgba = RIM};
        memcpy(rim.normals[1], patch.normals[0], sizeof rim.normals[1]);
        if (cut_patch(&patch, &body->planes[k], edge)) {
            Patch face = part_of_face(&body->planes[k], edge);
            memcpy(rim.ends, edge, sizeof rim.ends);
            memcpy(rim.normals[0], face.normals[0], sizeof rim.normals[0]);
            add_line(body, rim, k + 1);
            add_patch(body, face, k + 1);
        }
    }
    draw_patch(body, &patch);
}

static void add_plane(Body *body, const double point[3], const double normal[3], bool is_cut)
{
    Plane *plane = &body->planes[body->plane_count++];
    memcpy(plane->point, point, sizeof plane->point);
    memcpy(plane->normal, normal, sizeof plane->normal);
    plane->is_cut = is_cut;
}

/* Where the sides of planes and boxes are now. */
static void add_sides(Body *body, const OzSnapshot *snapshot, int w)
{
    const OzWall *wall = &snapshot->scene->walls[w];
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    double shift[3], turn = oz_snapshot_turn(snapshot, w);
    int count = oz_wall_shape_sides(wall, sides);
    oz_wall_shape_shift(wall, snapshot->wall_offset[w], shift);
    for (int s = 0; s < count; s++) {
        OzWallSwing swing = oz_wall_swing_side(wall, sides[s].point, turn, 0);
        oz_wall_swing_turn(swing.frame, sides[s].normal);
        for (int k = 0; k < 3; k++) {
            sides[s].point[k] += shift[k] + swing.away[k];
        }
        add_plane(body, sides[s].point, sides[s].normal, false);
    }
}

/* What is framed, m. */
static void find_frame(const OzObstacle *o, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = k == 2 ? o->look->height_low : o->look->centre[k] - o->look->half_width;
        high[k] = k == 2 ? o->top : o->look->centre[k] + o->look->half_width;
    }
}

static void add_planes(Body *body, bool is_endless)
{
    const OzObstacle *o = body->o;
    double low[3], high[3];
    const OzScene *scene = o->snapshot->scene;
    find_frame(o, low, high);
    if (o->is_cut) {
        add_plane(body, (const double[3]){0, o->look->cut, 0}, (const double[3]){0, 1, 0}, true);
    }
    for (int k = 0; k < 3 && is_endless; k++) {
        double normal[3] = {k == 0, k == 1, k == 2}, back[3] = {-normal[0], -normal[1], -normal[2]};
        add_plane(body, low, normal, false);
        add_plane(body, high, back, false);
    }
    for (int w = 0; w < scene->wall_count; w++) {
        OzWallKind kind = scene->walls[w].kind;
        if ((kind == OZ_WALL_PLANE || kind == OZ_WALL_BOX) &&
            oz_snapshot_has_wall(o->snapshot, w)) {
            add_sides(body, o->snapshot, w);
        }
    }
}

static void set_corner(Patch *patch, int i, const double middle[3], double radius,
                       const double normal[3])
{
    for (int k = 0; k < 3; k++) {
        patch->points[i][k] = middle[k] + radius * normal[k];
        patch->normals[i][k] = normal[k];
    }
}

/* A corner is the same in all patches that meet there, so that a plane through it makes no gap. */
static double angle_of(int i)
{
    return 2 * PI * (i % AROUND) / AROUND;
}

static void add_ball(Body *body, const double middle[3], double radius)
{
    for (int i = 0; i < AROUND * AROUND / 2; i++) {
        Patch patch = {.count = 4};
        for (int c = 0; c < 4; c++) {
            double up = PI * (i / AROUND + (c >= 2)) / (AROUND / 2);
            double around = angle_of(i % AROUND + (c == 1 || c == 2));
            const double normal[3] = {sin(up) * cos(around), sin(up) * sin(around), cos(up)};
            set_corner(&patch, c, middle, radius, normal);
        }
        add_patch(body, patch, 0);
    }
}

/* Along its axis from low to high, m, from its point. */
typedef struct Barrel {
    double point[3], axis[3], across[2][3], radius, low, high, turned;
} Barrel;

static void find_outwards(const Barrel *b, double angle, double outwards[3])
{
    for (int k = 0; k < 3; k++) {
        outwards[k] = cos(angle) * b->across[0][k] + sin(angle) * b->across[1][k];
    }
}

/* The end's part between two directions. */
static void add_end(Body *body, const Barrel *b, bool is_far, double outwards[2][3])
{
    Patch part = {.count = 3};
    Line rim = {.rgba = RIM};
    for (int i = 0; i < 3; i++) {
        double radius = i == 0 ? 0 : b->radius, along = is_far ? b->high : b->low;
        for (int k = 0; k < 3; k++) {
            part.points[i][k] =
                b->point[k] + along * b->axis[k] + radius * outwards[i > 0 ? i - 1 : 0][k];
            part.normals[i][k] = is_far ? b->axis[k] : -b->axis[k];
        }
    }
    memcpy(rim.ends, part.points[1], sizeof rim.ends);
    memcpy(rim.normals[0], part.normals[0], sizeof rim.normals[0]);
    memcpy(rim.normals[1], outwards[0], sizeof rim.normals[1]);
    add_line(body, rim, 0);
    add_patch(body, part, 0);
}

static void add_stave(Body *body, const Barrel *b, double angle)
{
    Line line = {.rgba = STAVE};
    for (int e = 0; e < 2; e++) {
        find_outwards(b, angle, line.normals[e]);
        for (int k = 0; k < 3; k++) {
            line.ends[e][k] =
                b->point[k] + (e ? b->high : b->low) * b->axis[k] + b->radius * line.normals[e][k];
        }
    }
    add_line(body, line, 0);
}

static void add_barrel(Body *body, const Barrel *b, bool turns)
{
    for (int i = 0; i < AROUND; i++) {
        Patch patch = {.count = 4};
        double outwards[2][3], middle[3];
        for (int side = 0; side < 2; side++) {
            find_outwards(b, angle_of(i + side), outwards[side]);
        }
        for (int c = 0; c < 4; c++) {
            for (int k = 0; k < 3; k++) {
                middle[k] = b->point[k] + (c >= 2 ? b->high : b->low) * b->axis[k];
            }
            set_corner(&patch, c, middle, b->radius, outwards[c == 1 || c == 2]);
        }
        add_patch(body, patch, 0);
        add_end(body, b, false, outwards);
        add_end(body, b, true, outwards);
    }
    for (int i = 0; i < STAVES && turns; i++) {
        add_stave(body, b, b->turned + 2 * PI * i / STAVES);
    }
}

/* An endless cylinder reaches farther than what is framed, where it ends. */
static void find_ends(Barrel *b, const OzObstacle *o, const OzWall *wall)
{
    double reach = 0, low[3], high[3];
    find_frame(o, low, high);
    b->low = 0;
    b->high = wall->length;
    for (int k = 0; k < 3 && wall->length == 0; k++) {
        reach += fmax(fabs(low[k] - b->point[k]), fabs(high[k] - b->point[k]));
    }
    if (wall->length == 0) {
        b->low = -reach;
        b->high = reach;
    }
}

bool oz_obstacle_is(const OzWall *wall)
{
    bool is_round = wall->kind == OZ_WALL_SPHERE || wall->kind == OZ_WALL_CYLINDER;
    return is_round && wall->side == OZ_SIDE_OUTSIDE && !oz_wall_shape_is_sheet(wall);
}

void oz_obstacle_add(const OzObstacle *obstacle, int w)
{
    const OzWall *wall = &obstacle->snapshot->scene->walls[w];
    bool is_endless = wall->kind == OZ_WALL_CYLINDER && wall->length == 0;
    Body body = {.o = obstacle};
    Barrel b = {.radius = wall->diameter / 2, .turned = oz_snapshot_turn(obstacle->snapshot, w)};
    add_planes(&body, is_endless);
    oz_wall_shape_shift(wall, obstacle->snapshot->wall_offset[w], b.point);
    for (int k = 0; k < 3; k++) {
        b.point[k] += wall->point[k];
    }
    if (wall->kind == OZ_WALL_SPHERE) {
        add_ball(&body, b.point, b.radius);
        return;
    }
    oz_wall_shape_axis(wall, b.axis);
    oz_wall_shape_across(b.axis, b.across[0], b.across[1]);
    find_ends(&b, obstacle, wall);
    add_barrel(&body, &b, wall->motion.present && wall->motion.angular_velocity != 0);
}
