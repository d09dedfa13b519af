/* Polygons of flat grains and of walls. */
#include "export/surface.h"

#include "base/memory.h"
#include "scene/wall_mesh.h"
#include "scene/wall_swing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
enum { AROUND = 64, DISC_CORNERS = 32 };

static OzStatus add_polygon(OzSurface *s, double (*points)[3], int64_t count, int64_t owner)
{
    int64_t cells = s->cell_capacity;
    OZ_PASS(oz_memory_room((void **)&s->points, &s->point_capacity, s->point_count + count,
                           3 * sizeof *s->points, "a surface"));
    OZ_PASS(OZ_ROOM(&s->corners, &s->corner_capacity, s->corner_count + count, "a surface"));
    OZ_PASS(OZ_ROOM(&s->ends, &cells, s->cell_count + 1, "a surface"));
    OZ_PASS(OZ_ROOM(&s->owner, &s->cell_capacity, s->cell_count + 1, "a surface"));
    for (int64_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            s->points[3 * s->point_count + k] = (float)points[i][k];
        }
        s->corners[s->corner_count++] = s->point_count++;
    }
    s->ends[s->cell_count] = s->corner_count;
    s->owner[s->cell_count++] = owner;
    return OZ_OK;
}

static OzStatus add_element(OzSurface *s, const OzSnapshot *now, int64_t i, int64_t owner)
{
    const OzElements *elements = now->grains->elements;
    const double *centre = &now->element_position[2 * i];
    double points[DISC_CORNERS][3] = {{0}}, corners[6], angle = now->element_angle[i];
    bool is_disc = elements->radius[i] > 0;
    oz_elements_corners(elements, i, centre, angle, corners);
    for (int k = 0; k < (is_disc ? DISC_CORNERS : 3); k++) {
        double turn = angle + 2 * PI * k / DISC_CORNERS;
        points[k][0] = is_disc ? centre[0] + elements->radius[i] * cos(turn) : corners[2 * k];
        points[k][1] = is_disc ? centre[1] + elements->radius[i] * sin(turn) : corners[2 * k + 1];
    }
    return add_polygon(s, points, is_disc ? DISC_CORNERS : 3, owner);
}

OzStatus oz_surface_add_flat_grains(OzSurface *s, const OzSnapshot *now)
{
    const OzElements *elements = now->grains->elements;
    for (int64_t i = 0; i < elements->free_count; i++) {
        OZ_PASS(add_element(s, now, i, elements->body[i]));
    }
    return OZ_OK;
}

static OzStatus add_flat_walls(OzSurface *s, const OzSnapshot *now)
{
    const OzElements *elements = now->grains->elements;
    for (int64_t i = elements->free_count; i < elements->count; i++) {
        int64_t wall = elements->body[i] - elements->grain_count;
        if (oz_snapshot_has_wall(now, wall)) {
            OZ_PASS(add_element(s, now, i, wall));
        }
    }
    return OZ_OK;
}

/* The middle of all grains, the distance from it within which they lie, and how low and high. */
typedef struct Ball {
    double middle[3], radius, low, high;
} Ball;

static Ball find_ball(const OzSnapshot *now)
{
    Ball ball = {.low = now->count ? INFINITY : 0, .high = now->count ? -INFINITY : 0};
    for (int64_t i = 0; i < now->count; i++) {
        for (int k = 0; k < 3; k++) {
            ball.middle[k] += now->position[3 * i + k] / (double)now->count;
        }
    }
    for (int64_t i = 0; i < now->count; i++) {
        double square = 0;
        for (int k = 0; k < 3; k++) {
            square += pow(now->position[3 * i + k] - ball.middle[k], 2);
        }
        double reach = 0.5 * (now->grains->diameter[i] + now->grains->length[i]);
        double along = 0.5 * now->grains->length[i] * fabs(now->axis[3 * i + 2]);
        double tall = 0.5 * now->grains->diameter[i] + along;
        ball.radius = fmax(ball.radius, sqrt(square) + reach);
        ball.low = fmin(ball.low, now->position[3 * i + 2] - tall);
        ball.high = fmax(ball.high, now->position[3 * i + 2] + tall);
    }
    return ball;
}

/* A square of twice the grains' reach about the foot of their middle. */
static OzStatus add_plane(OzSurface *s, const OzWall *wall, double offset, const Ball *ball,
                          int64_t number)
{
    double u[3], v[3], corners[4][3], height = 0, shift[3];
    oz_wall_shape_shift(wall, offset, shift);
    oz_wall_shape_across(wall->normal, u, v);
    for (int k = 0; k < 3; k++) {
        height += (ball->middle[k] - wall->point[k] - shift[k]) * wall->normal[k];
    }
    for (int c = 0; c < 4; c++) {
        double a = c == 1 || c == 2 ? 1 : -1, b = c >= 2 ? 1 : -1;
        for (int k = 0; k < 3; k++) {
            double foot = ball->middle[k] - height * wall->normal[k];
            corners[c][k] = foot + 1.5 * ball->radius * (a * u[k] + b * v[k]);
        }
    }
    return add_polygon(s, corners, 4, number);
}

/* The middle of a round wall, its axis and two directions across. */
typedef struct Round {
    double middle[3], axis[3], across[2][3];
} Round;

static void put_on_circle(const Round *round, double along, double radius, int step,
                          double place[3])
{
    double angle = 2 * PI * step / AROUND;
    for (int k = 0; k < 3; k++) {
        place[k] = round->middle[k] + along * round->axis[k] +
                   radius * (cos(angle) * round->across[0][k] + sin(angle) * round->across[1][k]);
    }
}

/* A belt between two circles about the axis. */
static OzStatus add_belt(OzSurface *s, const Round *round, const double along[2],
                         const double radius[2], int64_t number)
{
    for (int i = 0; i < AROUND; i++) {
        double corners[4][3];
        for (int c = 0; c < 4; c++) {
            put_on_circle(round, along[c / 2], radius[c / 2], i + (c == 1 || c == 2), corners[c]);
        }
        OZ_PASS(add_polygon(s, corners, 4, number));
    }
    return OZ_OK;
}

/* With its ends where it has some; endless, as far as the grains reach. */
static OzStatus add_cylinder(OzSurface *s, const OzWall *wall, const Round *round, const Ball *ball,
                             int64_t number)
{
    double radius = 0.5 * wall->diameter, middle = 0, along[2] = {0, wall->length};
    for (int k = 0; k < 3; k++) {
        middle += (ball->middle[k] - round->middle[k]) * round->axis[k];
    }
    if (wall->length == 0) {
        bool upright = oz_wall_shape_is_upright(wall);
        along[0] = upright ? ball->low - round->middle[2] : middle - ball->radius;
        along[1] = upright ? ball->high - round->middle[2] : middle + ball->radius;
    }
    for (int e = 0; wall->length > 0 && e < 2; e++) {
        double lid[AROUND][3];
        for (int i = 0; i < AROUND; i++) {
            put_on_circle(round, along[e], radius, i, lid[i]);
        }
        OZ_PASS(add_polygon(s, lid, AROUND, number));
    }
    return add_belt(s, round, along, (double[2]){radius, radius}, number);
}

/* A rectangle; or what a line makes that is turned about an axis. */
static OzStatus add_sheet(OzSurface *s, const OzWall *wall, const Round *round, int64_t number)
{
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    double corners[4][3];
    oz_wall_shape_sides(wall, sides);
    const OzWallShape shape = sides[0];
    if (wall->kind != OZ_WALL_RECTANGLE) {
        return add_belt(s, round, (double[2]){0, shape.extent[1]},
                        (double[2]){shape.radius, shape.extent[0]}, number);
    }
    for (int c = 0; c < 4; c++) {
        double one = c == 1 || c == 2 ? 1 : -1, other = c >= 2 ? 1 : -1;
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            double second = shape.normal[a] * shape.across[b] - shape.normal[b] * shape.across[a];
            corners[c][k] = round->middle[k] + one * shape.extent[0] * shape.across[k] +
                            other * shape.extent[1] * second;
        }
    }
    return add_polygon(s, corners, 4, number);
}

static OzStatus add_sphere(OzSurface *s, const OzWall *wall, const Round *round, int64_t number)
{
    double radius = 0.5 * wall->diameter;
    for (int i = 0; i < AROUND / 2; i++) {
        double a = 2 * PI * i / AROUND, b = 2 * PI * (i + 1) / AROUND;
        OZ_PASS(add_belt(s, round, (double[2]){-radius * cos(a), -radius * cos(b)},
                         (double[2]){radius * sin(a), radius * sin(b)}, number));
    }
    return OZ_OK;
}

/* point: where its own is now; frame: of how it stands (kernels/wall_swing.h). */
static OzStatus add_box(OzSurface *s, const OzWall *wall, const double point[3],
                        const double frame[9], int64_t number)
{
    for (int side = 0; side < 6; side++) {
        int k = side / 2, i = (k + 1) % 3, j = (k + 2) % 3;
        double corners[4][3];
        for (int c = 0; c < 4; c++) {
            double place[3];
            place[k] = side % 2 - 0.5;
            place[i] = (c == 1 || c == 2) - 0.5;
            place[j] = (c >= 2) - 0.5;
            for (int n = 0; n < 3; n++) {
                place[n] = (place[n] + (n == 2 ? 0.5 : 0)) * wall->size[n];
            }
            oz_wall_swing_turn(frame, place);
            for (int n = 0; n < 3; n++) {
                corners[c][n] = point[n] + place[n];
            }
        }
        OZ_PASS(add_polygon(s, corners, 4, number));
    }
    return OZ_OK;
}

/* frame: of how it stands (kernels/wall_swing.h). */
static OzStatus add_mesh(OzSurface *s, const OzWallMesh *mesh, const double point[3],
                         const double frame[9], int64_t number)
{
    for (int face = 0; face < mesh->count; face++) {
        double corners[3][3];
        memcpy(corners, mesh->corners + 9 * face, sizeof corners);
        for (int c = 0; c < 3; c++) {
            oz_wall_swing_turn(frame, corners[c]);
            for (int k = 0; k < 3; k++) {
                corners[c][k] += point[k];
            }
        }
        OZ_PASS(add_polygon(s, corners, 3, number));
    }
    return OZ_OK;
}

static OzStatus add_wall(OzSurface *s, const OzSnapshot *now, const Ball *ball, int w)
{
    const OzWall *built = &now->scene->walls[w];
    double turn = oz_snapshot_turn(now, w);
    const OzWall turned = oz_wall_swing_turned(built, turn), *wall = &turned;
    Round round = {.axis = {0, 0, 1}};
    double shift[3];
    oz_wall_shape_shift(wall, now->wall_offset[w], shift);
    for (int k = 0; k < 3; k++) {
        round.middle[k] = wall->point[k] + shift[k];
    }
    if (wall->kind == OZ_WALL_CYLINDER || wall->kind == OZ_WALL_CONE) {
        oz_wall_shape_axis(wall, round.axis);
    } else if (wall->kind == OZ_WALL_DISC) {
        memcpy(round.axis, wall->normal, sizeof round.axis);
    }
    oz_wall_shape_across(round.axis, round.across[0], round.across[1]);
    if (wall->mesh) {
        return add_mesh(s, wall->mesh, round.middle, oz_wall_swing_at(built, turn, 0).frame, w);
    }
    if (oz_wall_shape_is_sheet(wall)) {
        return add_sheet(s, wall, &round, w);
    }
    switch (wall->kind) {
    case OZ_WALL_PLANE:
        return add_plane(s, wall, now->wall_offset[w], ball, w);
    case OZ_WALL_CYLINDER:
        return add_cylinder(s, wall, &round, ball, w);
    case OZ_WALL_SPHERE:
        return add_sphere(s, wall, &round, w);
    case OZ_WALL_BOX:
        return add_box(s, wall, round.middle, oz_wall_swing_at(built, turn, 0).frame, w);
    default:
        return OZ_OK;
    }
}

OzStatus oz_surface_add_walls(OzSurface *s, const OzSnapshot *now)
{
    Ball ball = find_ball(now);
    if (now->grains->elements) {
        return add_flat_walls(s, now);
    }
    for (int w = 0; w < now->scene->wall_count; w++) {
        if (oz_snapshot_has_wall(now, w)) {
            OZ_PASS(add_wall(s, now, &ball, w));
        }
    }
    return OZ_OK;
}

void oz_surface_free(OzSurface *s)
{
    free(s->points);
    free(s->corners);
    free(s->ends);
    free(s->owner);
    memset(s, 0, sizeof *s);
}
