/* Meshes of the container's walls. Knows no grains. */
#include "draw/container.h"

#include "draw/framing.h"
#include "draw/obstacle.h"
#include "draw/wall_outline.h"
#include "draw/wall_sheet.h"
#include "scene/wall_swing.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum {
    SEGMENTS = 96,      /* of a circle: below a tenth of a pixel from round at 1000 pixels */
    POLYGON_LIMIT = 160 /* corners of a floor: a circle's and those that clipping adds     */
};

static const float FLOOR[4] = {0.855f, 0.865f, 0.885f, 1.0f};
static const float PANE[4] = {0.80f, 0.84f, 0.88f, 0.35f};
static const float EDGE[4] = {0.42f, 0.46f, 0.53f, 0.85f};
static const float FAINT[4] = {0.42f, 0.46f, 0.53f, 0.40f};

/* What every mesh maker needs to know. */
typedef struct Scope {
    const OzSnapshot *snapshot;
    const OzLook *look;
    const OzCamera *camera;
    OzView view;
    double radius; /* m, of the narrowest cylinder; 0 without one */
    double top;    /* m: the walls are drawn up to here           */
} Scope;

typedef struct Polygon {
    double points[POLYGON_LIMIT][3]; /* m, world */
    int count;
} Polygon;

void oz_container_free(OzContainer *container)
{
    for (int i = 0; i < OZ_CONTAINER_COUNT; i++) {
        oz_mesh_free(&container->meshes[i]);
    }
    memset(container, 0, sizeof *container);
}

static double line_width(const Scope *scope)
{
    return fmax(1.0, 0.0021 * scope->look->height);
}

/* angle: from the right of the picture, so that the eye sees the front from pi to 2 pi. */
static void on_circle(const Scope *scope, double angle, double z, double point[3])
{
    point[0] = scope->radius * cos(angle + scope->camera->azimuth);
    point[1] = scope->radius * sin(angle + scope->camera->azimuth);
    point[2] = z;
}

static void add_arc(OzMesh *mesh, const Scope *scope, double z, double from, double to,
                    const float rgba[4])
{
    for (int i = 0; i < SEGMENTS / 2; i++) {
        double points[2][3];
        on_circle(scope, from + (to - from) * 2 * i / SEGMENTS, z, points[0]);
        on_circle(scope, from + (to - from) * 2 * (i + 1) / SEGMENTS, z, points[1]);
        oz_mesh_line(mesh, scope->camera, points[0], points[1], line_width(scope), rgba);
    }
}

static void add_band(OzMesh *mesh, const Scope *scope, const double angles[2], double low,
                     double high, float rgba[2][4])
{
    double world[4][3], view[4][3];
    on_circle(scope, angles[0], low, world[0]);
    on_circle(scope, angles[0], high, world[1]);
    on_circle(scope, angles[1], high, world[2]);
    on_circle(scope, angles[1], low, world[3]);
    for (int k = 0; k < 4; k++) {
        oz_camera_see(scope->camera, world[k], view[k]);
    }
    oz_mesh_quad(mesh, view, rgba[0], rgba[1]);
}

/* Glass is seen best where one looks along it; a streak of light makes the front look round. */
static void glass_colour(double angle, bool front, float rgba[4])
{
    double edge = pow(fabs(cos(angle)), 5);
    double streak = exp(-pow((angle - 1.32 * PI) / 0.10, 2));
    double alpha = front ? 0.02 + 0.30 * edge + 0.16 * streak : 0.16 + 0.22 * edge;
    double white = front ? 0.16 * streak / alpha : 0;
    rgba[0] = (float)(0.66 + (1 - 0.66) * white);
    rgba[1] = (float)(0.74 + (1 - 0.74) * white);
    rgba[2] = (float)(0.83 + (1 - 0.83) * white);
    rgba[3] = (float)alpha;
}

static void add_glass(OzMesh *mesh, const Scope *scope, bool front, const double ends[2])
{
    double from = front ? PI : 0;
    for (int i = 0; i < SEGMENTS / 2; i++) {
        double angles[2] = {from + 2 * PI * i / SEGMENTS, from + 2 * PI * (i + 1) / SEGMENTS};
        float rgba[2][4];
        glass_colour(angles[0], front, rgba[0]);
        glass_colour(angles[1], front, rgba[1]);
        add_band(mesh, scope, angles, ends[0], ends[1], rgba);
    }
}

/* The edge of the floor's body, lighter where the glass turns towards the light. */
static void piston_colour(double angle, float rgba[4])
{
    float light = (float)(0.74 + 0.13 * fmax(cos(angle - 1.35 * PI), 0));
    rgba[0] = light;
    rgba[1] = light + 0.012f;
    rgba[2] = light + 0.032f;
    rgba[3] = 1;
}

/* A level floor is the top of a piston, seen from the side or sliced. */
static void add_piston(OzContainer *container, const Scope *scope, double z)
{
    double low = scope->look->height_low;
    bool cut = scope->view == OZ_VIEW_CUT;
    if (z <= low || scope->view == OZ_VIEW_TOP) { /* from above its top hides it */
        return;
    }
    for (int i = 0; i < (cut ? 1 : SEGMENTS / 2); i++) {
        double step = cut ? PI : 2 * PI / SEGMENTS;
        double angles[2] = {PI + i * step, PI + (i + 1) * step};
        float rgba[2][4];
        piston_colour(cut ? 1.6 * PI : angles[0], rgba[0]);
        piston_colour(cut ? 1.6 * PI : angles[1], rgba[1]);
        add_band(&container->meshes[OZ_CONTAINER_BEFORE], scope, angles, low, z, rgba);
    }
    if (!cut) {
        add_arc(&container->meshes[OZ_CONTAINER_BEFORE], scope, z, PI, 2 * PI, FAINT);
        return;
    }
    for (int edge = 0; edge < 2; edge++) {
        double from[3] = {-scope->radius, 0, edge ? z : low};
        double to[3] = {scope->radius, 0, from[2]};
        oz_mesh_line(&container->meshes[OZ_CONTAINER_BEFORE], scope->camera, from, to,
                     line_width(scope), EDGE);
    }
}

/* Side edges and glass between two heights. */
static void add_walls(OzMesh *behind, OzMesh *before, const Scope *scope, const double ends[2])
{
    add_glass(behind, scope, false, ends);
    for (int side = 0; side <= 1; side++) {
        double foot[3], top[3];
        on_circle(scope, side * PI, ends[0], foot);
        on_circle(scope, side * PI, ends[1], top);
        oz_mesh_line(before, scope->camera, foot, top, line_width(scope), EDGE);
    }
    if (scope->view != OZ_VIEW_CUT) {
        add_glass(before, scope, true, ends);
    }
}

/* Up to what is framed it stays the same from picture to picture; grains that fly higher lengthen
 * it. From above all of it is seen from within, behind the grains. */
static void add_cylinder(OzContainer *container, const Scope *scope)
{
    double framed = scope->look->height_high;
    double low = scope->look->height_low, high = fmax(scope->top, framed);
    OzMesh *meshes = container->meshes;
    bool within = scope->view == OZ_VIEW_TOP;
    OzMesh *behind = &meshes[OZ_CONTAINER_GLASS_BEHIND],
           *before = &meshes[within ? OZ_CONTAINER_GLASS_BEHIND : OZ_CONTAINER_GLASS_BEFORE];
    OzMesh *end_behind = &meshes[OZ_CONTAINER_END_BEHIND];
    OzMesh *end_before = &meshes[OZ_CONTAINER_END_BEFORE];
    add_walls(behind, before, scope, (const double[2]){low, framed});
    add_arc(behind, scope, low, 0, PI, FAINT);
    if (high > framed) {
        add_walls(end_behind, end_before, scope, (const double[2]){framed, high});
    }
    add_arc(end_behind, scope, high, 0, PI, EDGE);
    if (scope->view != OZ_VIEW_CUT) {
        add_arc(before, scope, low, PI, 2 * PI, EDGE);
        add_arc(end_before, scope, high, PI, 2 * PI, EDGE);
    }
}

/* Keeps the part of a convex polygon where normal . (p - point) >= 0. */
static void clip(Polygon *polygon, const double point[3], const double normal[3])
{
    Polygon kept = {.count = 0};
    for (int i = 0; i < polygon->count; i++) {
        const double *a = polygon->points[i], *b = polygon->points[(i + 1) % polygon->count];
        double height_a = 0, height_b = 0;
        for (int k = 0; k < 3; k++) {
            height_a += normal[k] * (a[k] - point[k]);
            height_b += normal[k] * (b[k] - point[k]);
        }
        if (height_a >= 0 && kept.count < POLYGON_LIMIT) {
            memcpy(kept.points[kept.count++], a, sizeof kept.points[0]);
        }
        if ((height_a >= 0) != (height_b >= 0) && kept.count < POLYGON_LIMIT) {
            double *crossing = kept.points[kept.count++];
            double share = height_a / (height_a - height_b);
            for (int k = 0; k < 3; k++) {
                crossing[k] = a[k] + share * (b[k] - a[k]);
            }
        }
    }
    *polygon = kept;
}

/* A plane where it is now. */
static void plane_now(const Scope *scope, int row, double point[3], double normal[3])
{
    OzWall wall = oz_wall_swing_turned(&scope->snapshot->scene->walls[row],
                                       oz_snapshot_turn(scope->snapshot, row));
    oz_wall_shape_shift(&wall, scope->snapshot->wall_offset[row], point);
    for (int k = 0; k < 3; k++) {
        point[k] += wall.point[k];
        normal[k] = wall.normal[k];
    }
}

/* Where a plane that is not upright closes the cylinder. */
static void plane_in_cylinder(Polygon *polygon, const Scope *scope, const double point[3],
                              const double normal[3])
{
    polygon->count = fabs(normal[2]) > 0.05 ? SEGMENTS : 0;
    for (int i = 0; i < polygon->count; i++) {
        double *p = polygon->points[i];
        on_circle(scope, 2 * PI * i / SEGMENTS, 0, p);
        p[2] =
            point[2] - (normal[0] * (p[0] - point[0]) + normal[1] * (p[1] - point[1])) / normal[2];
    }
}

/* A square of the plane about the picture's middle, larger than what is framed. */
static void plane_square(Polygon *polygon, const Scope *scope, const double point[3],
                         const double n[3])
{
    const double *centre = scope->camera->centre;
    double size = 8 * scope->camera->unit, height = 0;
    int least = fabs(n[0]) >= fabs(n[1]);
    least = fabs(n[2]) < fabs(n[least]) ? 2 : least;
    double e[3] = {0}, f[3];
    for (int k = 0; k < 3; k++) {
        e[k] = (k == least) - n[least] * n[k];
        height += n[k] * (centre[k] - point[k]);
    }
    double length = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    for (int k = 0; k < 3; k++) {
        e[k] /= length;
    }
    f[0] = n[1] * e[2] - n[2] * e[1];
    f[1] = n[2] * e[0] - n[0] * e[2];
    f[2] = n[0] * e[1] - n[1] * e[0];
    polygon->count = 4;
    for (int i = 0; i < 4; i++) {
        double along = i == 0 || i == 3 ? -size : size, across = i < 2 ? -size : size;
        for (int k = 0; k < 3; k++) {
            polygon->points[i][k] = centre[k] - height * n[k] + along * e[k] + across * f[k];
        }
    }
}

/* The framed box, and the free side of every other plane. */
static void clip_to_scene(Polygon *polygon, const Scope *scope, int row)
{
    const OzLook *look = scope->look;
    const OzScene *scene = scope->snapshot->scene;
    for (int side = -1; side <= 1; side += 2) {
        double point[3] = {look->centre[0] - side * look->half_width,
                           look->centre[1] - side * look->half_width,
                           side > 0 ? look->height_low - 0.02 * scope->camera->unit : scope->top};
        clip(polygon, point, (const double[3]){side, 0, 0});
        clip(polygon, point, (const double[3]){0, side, 0});
        clip(polygon, point, (const double[3]){0, 0, side});
    }
    for (int w = 0; w < scene->wall_count; w++) {
        if (w != row && scene->walls[w].kind == OZ_WALL_PLANE &&
            oz_snapshot_has_wall(scope->snapshot, w)) {
            double point[3], normal[3];
            plane_now(scope, w, point, normal);
            clip(polygon, point, normal);
        }
    }
}

static void add_outline(OzMesh *mesh, const Scope *scope, const Polygon *polygon,
                        const float rgba[4])
{
    for (int i = 0; i < polygon->count; i++) {
        oz_mesh_line(mesh, scope->camera, polygon->points[i],
                     polygon->points[(i + 1) % polygon->count], line_width(scope), rgba);
    }
}

static void add_filled(OzMesh *mesh, const Scope *scope, const Polygon *polygon,
                       const float rgba[4])
{
    for (int i = 1; i + 1 < polygon->count; i++) {
        const int corners[3] = {0, i, i + 1};
        for (int k = 0; k < 3; k++) {
            double view[3];
            oz_camera_see(scope->camera, polygon->points[corners[k]], view);
            oz_mesh_corner(mesh, view, rgba);
        }
    }
}

/* A plane whose free side faces the eye is a floor, or a back wall of glass; others would hide the
 * grains and are outlines. */
static void add_plane(OzContainer *container, const Scope *scope, int row)
{
    Polygon polygon = {.count = 0};
    double point[3], normal[3], seen[3];
    plane_now(scope, row, point, normal);
    if (scope->radius > 0) {
        plane_in_cylinder(&polygon, scope, point, normal);
    } else {
        plane_square(&polygon, scope, point, normal);
        clip_to_scene(&polygon, scope, row);
    }
    if (scope->view == OZ_VIEW_CUT) {
        clip(&polygon, (const double[3]){0, scope->look->cut, 0}, (const double[3]){0, 1, 0});
    }
    oz_camera_turn(scope->camera, normal, seen);
    if (seen[2] > 0) {
        bool floor = normal[2] > 0.3;
        add_filled(floor ? &container->meshes[OZ_CONTAINER_FLOORS]
                         : &container->meshes[OZ_CONTAINER_BEHIND],
                   scope, &polygon, floor ? FLOOR : PANE);
        add_outline(&container->meshes[OZ_CONTAINER_BEHIND], scope, &polygon, FAINT);
        if (scope->radius > 0 && normal[2] > 0.999) {
            add_piston(container, scope, point[2]);
        }
    } else {
        add_outline(&container->meshes[OZ_CONTAINER_BEFORE], scope, &polygon, FAINT);
    }
}

static OzWallOutline outline_of(const Scope *scope)
{
    return (OzWallOutline){.snapshot = scope->snapshot,
                           .camera = scope->camera,
                           .line_width = line_width(scope),
                           .low = scope->look->height_low,
                           .high = scope->top,
                           .reach = 1.5 * scope->look->half_width,
                           .is_cut = scope->view == OZ_VIEW_CUT,
                           .cut = scope->look->cut};
}

static void add_lines(OzContainer *container, const Scope *scope, int row)
{
    OzWallOutline outline = outline_of(scope);
    oz_wall_outline_add(&outline, row, &container->meshes[OZ_CONTAINER_BEHIND],
                        &container->meshes[OZ_CONTAINER_BEFORE], EDGE);
}

static void add_cell(OzContainer *container, const Scope *scope)
{
    OzWallOutline outline = outline_of(scope);
    oz_wall_outline_add_cell(&outline, &container->meshes[OZ_CONTAINER_BEHIND],
                             &container->meshes[OZ_CONTAINER_BEFORE], FAINT);
}

static void add_sheet(OzContainer *container, const Scope *scope, int row)
{
    OzWallSheet sheet = {.snapshot = scope->snapshot,
                         .camera = scope->camera,
                         .behind = &container->meshes[OZ_CONTAINER_BEHIND],
                         .before = &container->meshes[OZ_CONTAINER_BEFORE],
                         .line_width = line_width(scope),
                         .reach = 1.5 * scope->look->half_width,
                         .is_cut = scope->view == OZ_VIEW_CUT,
                         .cut = scope->look->cut};
    oz_wall_sheet_add(&sheet, row);
}

static void add_obstacle(OzContainer *container, const Scope *scope, int row)
{
    OzObstacle obstacle = {.snapshot = scope->snapshot,
                           .look = scope->look,
                           .camera = scope->camera,
                           .solid = &container->meshes[OZ_CONTAINER_OBSTACLES],
                           .lines = &container->meshes[OZ_CONTAINER_OUTLINES],
                           .line_width = line_width(scope),
                           .top = scope->top,
                           .is_cut = scope->view == OZ_VIEW_CUT};
    oz_obstacle_add(&obstacle, row);
}

/* Where its highest corner is seen, view coordinates. */
static double highest(const OzMesh *mesh, const OzCamera *camera)
{
    double high = 0;
    for (size_t i = 0; i < mesh->count; i++) {
        const float *place = mesh->corners[i].place;
        double gap = fmax(camera->distance - (double)place[2], 0.1 * camera->distance);
        high = fmax(high, (double)place[1] * camera->distance / gap);
    }
    return high;
}

OzStatus oz_container_build(OzContainer *container, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera, OzView view)
{
    double radius = oz_framing_radius(snapshot->scene);
    Scope scope = {.snapshot = snapshot,
                   .look = look,
                   .camera = camera,
                   .view = view,
                   .radius = isfinite(radius) ? radius : 0,
                   .top = oz_framing_top(look, camera, snapshot)};
    bool has_cylinder = false;
    OzStatus status = OZ_OK;
    for (int i = 0; i < OZ_CONTAINER_COUNT; i++) {
        oz_mesh_clear(&container->meshes[i]);
    }
    for (int w = 0; w < snapshot->scene->wall_count; w++) {
        const OzWall *wall = &snapshot->scene->walls[w];
        if (!oz_snapshot_has_wall(snapshot, w)) {
            continue;
        }
        has_cylinder |= oz_wall_shape_is_upright(wall);
        if (wall->kind == OZ_WALL_PLANE) {
            add_plane(container, &scope, w);
        } else if (oz_obstacle_is(wall)) {
            add_obstacle(container, &scope, w);
        } else if (!oz_wall_shape_is_upright(wall)) {
            add_sheet(container, &scope, w);
            add_lines(container, &scope, w);
        }
    }
    if (has_cylinder) {
        add_cylinder(container, &scope);
    }
    if (snapshot->scene->boundary.present) {
        add_cell(container, &scope);
    }
    container->high = 0;
    for (int i = 0; i < OZ_CONTAINER_COUNT && status == OZ_OK; i++) {
        status = container->meshes[i].status;
        container->high = fmax(container->high, highest(&container->meshes[i], camera));
    }
    return status;
}
