/* Which points the walls leave to grains placed at random. Knows nothing of other grains. */
#include "model/fill_region.h"

#include "scene/boundary.h"
#include "scene/wall_mesh.h"
#include "scene/wall_shape.h"

#include <math.h>

/* A plane counts as lying across an axis when its normal is within 1e-6 of it: written normals are
 * normalised in double, and a millionth of a slope is far below any overlap that matters. */
static const double across = 1 - 1e-12;

static const double PI = 3.14159265358979323846;

static void bound_by_plane(OzFillRegion *fill_region, const OzWall *wall)
{
    for (int k = 0; k < 3; k++) {
        if (wall->normal[k] > across) {
            fill_region->low[k] = fmax(fill_region->low[k], wall->point[k]);
            fill_region->walled_low[k] = true;
        } else if (wall->normal[k] < -across) {
            fill_region->high[k] = fmin(fill_region->high[k], wall->point[k]);
            fill_region->walled_high[k] = true;
        }
    }
}

static void bound_between(OzFillRegion *fill_region, int k, double low, double high)
{
    fill_region->low[k] = fmax(fill_region->low[k], low);
    fill_region->high[k] = fmin(fill_region->high[k], high);
    fill_region->walled_low[k] = fill_region->walled_high[k] = true;
}

/* A round body about its axis: within its radius across, and its length along; endless, it bounds
 * what lies across alone. */
static void bound_by_tube(OzFillRegion *fill_region, const OzWall *wall)
{
    double radius = 0.5 * wall->diameter, axis[3];
    oz_wall_shape_axis(wall, axis);
    for (int k = 0; k < 3; k++) {
        double along = axis[k], reach = radius * sqrt(fmax(0, 1 - along * along));
        double far = wall->point[k] + along * wall->length;
        if (wall->length > 0 || fabs(along) < sqrt(1 - across)) {
            bound_between(fill_region, k, fmin(wall->point[k], far) - reach,
                          fmax(wall->point[k], far) + reach);
        }
    }
}

/* A cone or an open tube, with radii at its two ends. */
static void add_vessel(OzFillRegion *fill_region, const OzWall *wall, const double radii[2])
{
    double axis[3];
    oz_wall_shape_axis(wall, axis);
    fill_region->vessels++;
    for (int end = 0; end < 2; end++) {
        for (int k = 0; k < 3; k++) {
            double reach = radii[end] * sqrt(fmax(0, 1 - axis[k] * axis[k]));
            double middle = wall->point[k] + (end ? wall->length * axis[k] : 0);
            fill_region->vessels_low[k] = fmin(fill_region->vessels_low[k], middle - reach);
            fill_region->vessels_high[k] = fmax(fill_region->vessels_high[k], middle + reach);
        }
    }
}

static bool is_vessel(const OzWall *wall)
{
    bool is_tube = wall->kind == OZ_WALL_CYLINDER && wall->ends == OZ_ENDS_OPEN && wall->length > 0;
    return wall->side == OZ_SIDE_INSIDE && (wall->kind == OZ_WALL_CONE || is_tube);
}

static void radii_of(const OzWall *wall, double radii[2])
{
    bool is_cone = wall->kind == OZ_WALL_CONE;
    radii[0] = (is_cone ? wall->diameters[0] : wall->diameter) / 2;
    radii[1] = (is_cone ? wall->diameters[1] : wall->diameter) / 2;
}

static bool vessel_holds(const OzWall *wall, const double point[3])
{
    double axis[3], radii[2], along = 0, far2 = 0;
    oz_wall_shape_axis(wall, axis);
    radii_of(wall, radii);
    for (int k = 0; k < 3; k++) {
        along += (point[k] - wall->point[k]) * axis[k];
    }
    for (int k = 0; k < 3; k++) {
        double out = point[k] - wall->point[k] - along * axis[k];
        far2 += out * out;
    }
    double share = along / wall->length;
    return share >= 0 && share <= 1 && sqrt(far2) < radii[0] + share * (radii[1] - radii[0]);
}

static void bound_by_cone(OzFillRegion *fill_region, const OzWall *wall)
{
    add_vessel(fill_region, wall, (double[]){wall->diameters[0] / 2, wall->diameters[1] / 2});
}

static void bound_by_band(OzFillRegion *fill_region, const OzWall *wall)
{
    add_vessel(fill_region, wall, (double[]){wall->diameter / 2, wall->diameter / 2});
}

/* Grains are outside. */
static void bound_by_obstacle(OzFillRegion *fill_region, const OzWall *wall)
{
    (void)fill_region;
    (void)wall;
}

static void bound_by_solid(OzFillRegion *fill_region, const OzWall *wall)
{
    bound_by_obstacle(fill_region, wall);
}

static void bound_by_cylinder(OzFillRegion *fill_region, const OzWall *wall)
{
    if (is_vessel(wall)) {
        bound_by_band(fill_region, wall);
        return;
    }
    bound_by_tube(fill_region, wall);
    if (oz_wall_shape_is_upright(wall)) {
        fill_region->radius = fmin(fill_region->radius, 0.5 * wall->diameter);
    }
}

static void bound_by_sphere(OzFillRegion *fill_region, const OzWall *wall)
{
    double radius = 0.5 * wall->diameter;
    for (int k = 0; k < 3; k++) {
        bound_between(fill_region, k, wall->point[k] - radius, wall->point[k] + radius);
    }
}

static void bound_by_box(OzFillRegion *fill_region, const OzWall *wall)
{
    for (int k = 0; k < 3; k++) {
        double low = wall->point[k] - (k == 2 ? 0 : wall->size[k] / 2);
        bound_between(fill_region, k, low, low + wall->size[k]);
    }
}

/* Of meshes those that hold grains inside bound; others are kept clear of. */
static void bound_by_mesh(OzFillRegion *fill_region, const OzWall *wall)
{
    for (int k = 0; k < 3 && oz_wall_mesh_is_vessel(wall->mesh); k++) {
        bound_between(fill_region, k, wall->point[k] + wall->mesh->low[k],
                      wall->point[k] + wall->mesh->high[k]);
    }
}

/* A closed mesh's inside is all that grains may be in, or nowhere that they may be. */
static bool mesh_allows(const OzWall *wall, const double point[3])
{
    double from[3];
    for (int k = 0; wall->mesh && k < 3; k++) {
        from[k] = point[k] - wall->point[k];
    }
    return !wall->mesh || !wall->mesh->edges.closed ||
           oz_wall_mesh_encloses(wall->mesh, from) == oz_wall_mesh_is_vessel(wall->mesh);
}

/* Whether a level sheet closes the column at its own height: the corners of the box, or the rim of
 * the cylinder, lie on it. */
static bool closes(const OzFillRegion *fill_region, const OzWall *wall)
{
    enum { RIM = 16 };
    bool is_round = isfinite(fill_region->radius), all_on = fabs(wall->normal[2]) > across;
    for (int i = 0; i < (is_round ? RIM : 4); i++) {
        double angle = 2 * PI * i / RIM, size = 0;
        double point[3] = {fill_region->radius * cos(angle), fill_region->radius * sin(angle),
                           wall->point[2]};
        for (int k = 0; k < 2; k++) {
            double sides[2] = {fill_region->low[k], fill_region->high[k]};
            point[k] = is_round ? point[k] : sides[i >> k & 1];
            size = fmax(size, fabs(point[k]));
        }
        double gap = isfinite(size) ? oz_wall_shape_distance(wall, 0, point, NULL) : INFINITY;
        all_on &= gap <= 1e-9 * size;
    }
    return all_on;
}

static void bound_by_rectangle(OzFillRegion *fill_region, const OzWall *wall)
{
    if (closes(fill_region, wall)) {
        bound_by_plane(fill_region, wall);
    }
}

static void bound_by_disc(OzFillRegion *fill_region, const OzWall *wall)
{
    bound_by_rectangle(fill_region, wall);
}

#define ROW(NAME, name, choice, fine, edged) [OZ_WALL_##NAME] = bound_by_##name,
#define COMPOUND_ROW(NAME, name, choice)     [OZ_WALL_##NAME] = bound_by_##name,
static void (*const bounds[])(OzFillRegion *fill_region,
                              const OzWall *wall) = {OZ_WALLS(ROW) OZ_COMPOUND_WALLS(COMPOUND_ROW)};
#undef ROW
#undef COMPOUND_ROW

static bool walled(const OzFillRegion *fill_region, int k)
{
    return fill_region->walled_low[k] && fill_region->walled_high[k];
}

/* The length that the directions without walls on both sides must share. */
static double free_length(const OzFillRegion *fill_region, double volume, double extent)
{
    int free_count = 0;
    double area = isfinite(fill_region->radius) ? 0.25 * PI : 1;
    for (int k = 0; k < 3; k++) {
        if (walled(fill_region, k)) {
            area *= fmax(fill_region->high[k] - fill_region->low[k], 0);
        } else {
            free_count++;
        }
    }
    double length = free_count && area > 0 ? pow(volume / area, 1.0 / free_count) : extent;
    return fmax(length, extent);
}

static void cut_off(OzFillRegion *fill_region, int k, double length)
{
    if (fill_region->walled_low[k] && !fill_region->walled_high[k]) {
        fill_region->high[k] = fill_region->low[k] + length;
    } else if (fill_region->walled_high[k] && !fill_region->walled_low[k]) {
        fill_region->low[k] = fill_region->high[k] - length;
    } else if (!walled(fill_region, k)) {
        bool upwards = k == 2 && isfinite(fill_region->radius);
        fill_region->low[k] = upwards ? 0 : -0.5 * length;
        fill_region->high[k] = fill_region->low[k] + length;
    }
}

/* Sheets across the column come last: they close one that is there. */
static void bound_by_walls(OzFillRegion *fill_region, bool are_sheets)
{
    const OzScene *scene = fill_region->scene;
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        bool is_sheet = wall->kind == OZ_WALL_RECTANGLE || wall->kind == OZ_WALL_DISC;
        bool comes_later = wall->since > 0;
        if (wall->side == OZ_SIDE_INSIDE && is_sheet == are_sheets && !comes_later) {
            bounds[wall->kind](fill_region, wall);
        }
    }
}

/* The room of vessels: their bounds, but for above where other walls enclose what is there. */
static void bound_by_vessels(OzFillRegion *fill_region)
{
    bool is_sided =
        isfinite(fill_region->radius) || (walled(fill_region, 0) && walled(fill_region, 1));
    if (fill_region->vessels > 0 && is_sided) {
        fill_region->low[2] = fmax(fill_region->low[2], fill_region->vessels_low[2]);
        fill_region->walled_low[2] = true;
        fill_region->open_above = fill_region->vessels_high[2];
    }
    for (int k = 0; k < 3 && fill_region->vessels > 0 && !is_sided; k++) {
        bound_between(fill_region, k, fill_region->vessels_low[k], fill_region->vessels_high[k]);
    }
}

OzFillRegion oz_fill_region_make(const OzScene *scene, double volume, double extent)
{
    OzFillRegion fill_region = {.scene = scene,
                                .low = {-INFINITY, -INFINITY, -INFINITY},
                                .high = {INFINITY, INFINITY, INFINITY},
                                .radius = INFINITY,
                                .vessels_low = {INFINITY, INFINITY, INFINITY},
                                .vessels_high = {-INFINITY, -INFINITY, -INFINITY},
                                .open_above = INFINITY};
    for (int k = 0; k < 3; k++) {
        double period = oz_boundary_period(&scene->boundary, k);
        if (period > 0) {
            bound_between(&fill_region, k, -period / 2, period / 2);
            fill_region.periodic[k] = true;
        }
    }
    bound_by_walls(&fill_region, false);
    bound_by_vessels(&fill_region);
    bound_by_walls(&fill_region, true);
    double length = free_length(&fill_region, volume, extent);
    for (int k = 0; k < 3; k++) {
        cut_off(&fill_region, k, length);
    }
    return fill_region;
}

bool oz_fill_region_raise(OzFillRegion *fill_region)
{
    int free_count = 0;
    for (int k = 0; k < 3; k++) {
        free_count += !walled(fill_region, k);
    }
    for (int k = 0; k < 3; k++) {
        double more =
            (fill_region->high[k] - fill_region->low[k]) * (pow(1.1, 1.0 / free_count) - 1);
        bool both = !fill_region->walled_low[k] && !fill_region->walled_high[k];
        bool centred = both && !(k == 2 && isfinite(fill_region->radius));
        if (walled(fill_region, k)) {
            continue;
        }
        fill_region->low[k] -= centred ? 0.5 * more : fill_region->walled_high[k] ? more : 0;
        fill_region->high[k] += centred ? 0.5 * more : fill_region->walled_high[k] ? 0 : more;
    }
    return free_count > 0;
}

bool oz_fill_region_admits(const OzFillRegion *fill_region, const OzCapsule *capsule)
{
    for (int k = 0; k < 3; k++) {
        double extent = 2 * (fabs(capsule->half_shaft[k]) + capsule->radius);
        if (!fill_region->periodic[k] && fill_region->high[k] - fill_region->low[k] < extent) {
            return false;
        }
    }
    return hypot(capsule->half_shaft[0], capsule->half_shaft[1]) <=
           fill_region->radius - capsule->radius;
}

void oz_fill_region_draw(const OzFillRegion *fill_region, OzRandom *random, OzCapsule *capsule)
{
    for (int k = 0; k < 3; k++) {
        double extent = fabs(capsule->half_shaft[k]) + capsule->radius;
        double margin = fill_region->periodic[k] ? 0 : extent;
        capsule->centre[k] =
            oz_random_uniform(random, fill_region->low[k] + margin, fill_region->high[k] - margin);
    }
}

/* Whether a point is in a vessel, or above all where that is the room, too. */
static bool is_enclosed(const OzFillRegion *fill_region, const double point[3])
{
    bool found = fill_region->vessels == 0 || point[2] > fill_region->open_above;
    for (int w = 0; w < fill_region->scene->wall_count && !found; w++) {
        const OzWall *wall = &fill_region->scene->walls[w];
        found = !(wall->since > 0) && is_vessel(wall) && vessel_holds(wall, point);
    }
    return found;
}

/* Whether the shaft keeps its radius from a wall. Between its ends no point is nearer to a wall
 * that has grains inside. A sheet or an obstacle is as far from the next point as from this one,
 * less the way there; ways shorter than a hundredth of the radius are not looked at. */
static bool shaft_is_free(const OzWall *wall, const OzCapsule *capsule)
{
    const double *half = capsule->half_shaft;
    double length = 2 * sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
    bool looks_between = oz_wall_shape_is_sheet(wall) || wall->side == OZ_SIDE_OUTSIDE;
    double least = looks_between ? 0.01 * capsule->radius : length;
    for (double way = 0;;) {
        double share = length > 0 ? 2 * way / length - 1 : 0, point[3];
        for (int k = 0; k < 3; k++) {
            point[k] = capsule->centre[k] + share * half[k];
        }
        double spare = oz_wall_shape_distance(wall, 0, point, NULL) - capsule->radius;
        if (!(spare >= 0)) {
            return false;
        }
        if (way >= length) {
            return true;
        }
        way = fmin(way + fmax(least, least < length ? spare : 0), length);
    }
}

bool oz_fill_region_holds(const OzFillRegion *fill_region, const OzCapsule *capsule)
{
    double ends[2][3];
    for (int k = 0; k < 3; k++) {
        ends[0][k] = capsule->centre[k] - capsule->half_shaft[k];
        ends[1][k] = capsule->centre[k] + capsule->half_shaft[k];
    }
    bool holds = is_enclosed(fill_region, ends[0]) && is_enclosed(fill_region, ends[1]);
    for (int w = 0; w < fill_region->scene->wall_count && holds; w++) {
        const OzWall *wall = &fill_region->scene->walls[w];
        holds = wall->since > 0 || (mesh_allows(wall, ends[0]) && shaft_is_free(wall, capsule));
    }
    return holds;
}
