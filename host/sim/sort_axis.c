/* The sort along z: enclosing balls by their highest points, from the top; a ball can only meet
 * those after it whose highest point is above its own lowest one. */
#include "sim/sort_axis.h"

#include "base/memory.h"
#include "scene/boundary.h"

#define OZ_HOST
#include "kernels/closest.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

typedef struct Ball {
    double top, bottom, reach;
    OzVec3 centre, half_shaft;
    double radius; /* of the grain */
    int id;
    bool is_image;
} Ball;

typedef struct Balls {
    Ball *ball;
    int64_t count, capacity;
} Balls;

static Ball enclose(const OzGrains *grains, const double *x, const double *u, int id)
{
    double half_length = grains->length[id] / 2;
    Ball ball = {.centre = oz_vec3(x[0], x[1], x[2]),
                 .half_shaft = oz_scale(oz_vec3(u[0], u[1], u[2]), half_length),
                 .radius = grains->diameter[id] / 2,
                 .id = id};
    ball.reach = half_length + ball.radius;
    ball.top = x[2] + ball.reach;
    ball.bottom = x[2] - ball.reach;
    return ball;
}

static int from_the_top(const void *one, const void *other)
{
    const Ball *a = one, *b = other;
    return (a->top < b->top) - (a->top > b->top);
}

static int by_ids(const void *one, const void *other)
{
    const OzPair *a = one, *b = other;
    return a->a != b->a ? (a->a > b->a) - (a->a < b->a) : (a->b > b->b) - (a->b < b->b);
}

/* The balls are compared first: most pairs end there. */
static bool near(const Ball *a, const Ball *b, double skin)
{
    OzVec3 apart = oz_minus(a->centre, b->centre);
    double far = a->reach + b->reach + skin, touch = a->radius + b->radius + skin;
    if (oz_dot(apart, apart) >= far * far) {
        return false;
    }
    OzClosest at = oz_closest(apart, a->half_shaft, b->half_shaft);
    OzVec3 gap = oz_along(oz_along(apart, at.s, a->half_shaft), -at.t, b->half_shaft);
    return oz_dot(gap, gap) < touch * touch;
}

static OzStatus add(OzPairs *list, const Ball *one, const Ball *other)
{
    OZ_PASS(OZ_ROOM(&list->pair, &list->capacity, list->count + 1, "list of pairs"));
    bool in_order = one->reach != other->reach ? one->reach > other->reach : one->id < other->id;
    OzPair pair = {in_order ? one->id : other->id, in_order ? other->id : one->id};
    list->pair[list->count++] = pair;
    return OZ_OK;
}

static OzStatus sweep(OzPairs *list, const Balls *balls, double skin)
{
    for (int64_t i = 0; i < balls->count; i++) {
        const Ball *one = &balls->ball[i];
        double lowest = one->bottom - skin;
        for (int64_t j = i + 1; j < balls->count && balls->ball[j].top > lowest; j++) {
            const Ball *other = &balls->ball[j];
            bool meets = !(one->is_image && other->is_image) && one->id != other->id;
            OzStatus status = meets && near(one, other, skin) ? add(list, one, other) : OZ_OK;
            if (status != OZ_OK) {
                return status;
            }
        }
    }
    return OZ_OK;
}

static OzStatus add_ball(Balls *balls, const Ball *ball, const double shift[3])
{
    OZ_PASS(OZ_ROOM(&balls->ball, &balls->capacity, balls->count + 1, "balls"));
    Ball *to = &balls->ball[balls->count++];
    *to = *ball;
    to->centre = oz_add(ball->centre, oz_vec3(shift[0], shift[1], shift[2]));
    to->top += shift[2];
    to->bottom += shift[2];
    to->is_image = shift[0] != 0 || shift[1] != 0 || shift[2] != 0;
    return OZ_OK;
}

/* A ball and its images that may meet something of the cell. */
static OzStatus add_images(Balls *balls, const Ball *ball, double far, const OzBoundary *boundary)
{
    const double at[3] = {ball->centre.x, ball->centre.y, ball->centre.z};
    for (int n = 0; n < 45; n++) { /* of a sheared cell, two to either side may be near */
        const int cells[3] = {n % 5 - 2, n / 5 % 3 - 1, n / 15 - 1};
        double shift[3];
        bool meets = true;
        for (int k = 0; k < 3; k++) {
            double period = oz_boundary_period(boundary, k);
            shift[k] = cells[k] * period;
            shift[k] += k == 0 ? cells[1] * boundary->tilt * oz_boundary_period(boundary, 1) : 0;
            meets &= cells[k] == 0 || (period > 0 && fabs(at[k] + shift[k]) < period / 2 + far);
        }
        if (meets) {
            OZ_PASS(add_ball(balls, ball, shift));
        }
    }
    return OZ_OK;
}

static OzStatus make_balls(Balls *balls, const OzGrains *grains, const double *position,
                           const double *axis, double skin, const OzBoundary *boundary)
{
    double reach = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        reach = fmax(reach, (grains->length[i] + grains->diameter[i]) / 2);
    }
    for (int i = 0; i < (int)grains->count; i++) {
        double place[3];
        memcpy(place, &position[3 * (int64_t)i], sizeof place);
        oz_boundary_wrap(boundary, place);
        Ball ball = enclose(grains, place, &axis[3 * (int64_t)i], i);
        OZ_PASS(add_images(balls, &ball, ball.reach + reach + skin, boundary));
    }
    return OZ_OK;
}

/* A pair that meets across the border is found from both sides. */
static void leave_out_twins(OzPairs *list)
{
    int64_t kept = 0;
    for (int64_t k = 0; k < list->count; k++) {
        if (k == 0 || by_ids(&list->pair[kept - 1], &list->pair[k]) != 0) {
            list->pair[kept++] = list->pair[k];
        }
    }
    list->count = kept;
}

OzStatus oz_sort_axis_pairs(OzPairs *list, const OzGrains *grains, const double *position,
                            const double *axis, double skin, const OzBoundary *boundary)
{
    OzStatus status = OZ_OK;
    Balls balls = {0};
    list->count = 0;
    if (grains->count > INT_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "%lld grains, at most %d", (long long)grains->count,
                              INT_MAX);
    }
    OZ_TRY(make_balls(&balls, grains, position, axis, skin, boundary));
    if (balls.count > 0) {
        qsort(balls.ball, (size_t)balls.count, sizeof *balls.ball, from_the_top);
    }
    OZ_TRY(sweep(list, &balls, skin));
    if (list->count > 0) {
        qsort(list->pair, (size_t)list->count, sizeof *list->pair, by_ids);
        leave_out_twins(list);
    }
done:
    free(balls.ball);
    return status;
}

void oz_sort_axis_free(OzPairs *list)
{
    free(list->pair);
    memset(list, 0, sizeof *list);
}
