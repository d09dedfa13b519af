/* Polygons of flat grains and of walls. */
#include "export/surface.h"

#include "base/memory.h"
#include "model/wall_motion.h"
#include "scene/wall_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
enum { AROUND = 64, DISC_CORNERS = 32 };

static OzStatus grow(void **array, int64_t *capacity, int64_t wanted, size_t size)
{
    int64_t next = wanted > 2 * *capacity ? wanted : 2 * *capacity;
    if (wanted <= *capacity) {
        return OZ_OK;
    }
    OZ_PASS(oz_memory_grow(array, (size_t)*capacity, (size_t)next, size, "a surface"));
    *capacity = next;
    return OZ_OK;
}

OzStatus oz_surface_add(OzSurface *s, double (*points)[3], int64_t count, int64_t owner)
{
    int64_t cells = s->cell_capacity;
    OZ_PASS(grow((void **)&s->points, &s->point_capacity, s->point_count + count,
                 3 * sizeof *s->points));
    OZ_PASS(grow((void **)&s->corners, &s->corner_capacity, s->corner_count + count,
                 sizeof *s->corners));
    OZ_PASS(grow((void **)&s->ends, &cells, s->cell_count + 1, sizeof *s->ends));
    OZ_PASS(grow((void **)&s->owner, &s->cell_capacity, s->cell_count + 1, sizeof *s->owner));
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
    return oz_surface_add(s, points, is_disc ? DISC_CORNERS : 3, owner);
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
        if (oz_wall_motion_present(&now->scene->walls[wall], now->time, false)) {
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

/* Two unit vectors across a third. */
static void find_across(const double normal[3], double u[3], double v[3])
{
    int least = fabs(normal[0]) < fabs(normal[1]) ? 0 : 1;
    least = fabs(normal[2]) < fabs(normal[least]) ? 2 : least;
    double length = sqrt(1 - normal[least] * normal[least]);
    for (int k = 0; k < 3; k++) {
        u[k] = ((k == least) - normal[least] * normal[k]) / length;
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        v[k] = normal[a] * u[b] - normal[b] * u[a];
    }
}

/* A square of twice the grains' reach about the foot of their middle. */
static OzStatus add_plane(OzSurface *s, const OzWall *wall, double offset, const Ball *ball,
                          int64_t number)
{
    double u[3], v[3], corners[4][3], height = 0, shift[3];
    oz_wall_shape_shift(wall, offset, shift);
    find_across(wall->normal, u, v);
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
    return oz_surface_add(s, corners, 4, number);
}

/* As high as the grains reach. */
static OzStatus add_cylinder(OzSurface *s, const OzWall *wall, const Ball *ball, int64_t number)
{
    double radius = 0.5 * wall->diameter, low = ball->low, high = ball->high;
    for (int i = 0; i < AROUND; i++) {
        double a = 2 * PI * i / AROUND, b = 2 * PI * (i + 1) / AROUND;
        double corners[4][3] = {{radius * cos(a), radius * sin(a), low},
                                {radius * cos(b), radius * sin(b), low},
                                {radius * cos(b), radius * sin(b), high},
                                {radius * cos(a), radius * sin(a), high}};
        OZ_PASS(oz_surface_add(s, corners, 4, number));
    }
    return OZ_OK;
}

OzStatus oz_surface_add_walls(OzSurface *s, const OzSnapshot *now)
{
    Ball ball = find_ball(now);
    if (now->grains->elements) {
        return add_flat_walls(s, now);
    }
    for (int w = 0; w < now->scene->wall_count; w++) {
        const OzWall *wall = &now->scene->walls[w];
        if (wall->kind == OZ_WALL_PLANE) {
            OZ_PASS(add_plane(s, wall, now->wall_offset[w], &ball, w));
        } else if (oz_wall_shape_is_upright(wall)) {
            OZ_PASS(add_cylinder(s, wall, &ball, w));
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
