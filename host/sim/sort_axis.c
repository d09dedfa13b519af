/* The sort along z: enclosing balls by their highest points, from the top; a ball can only meet
 * those after it whose highest point is above its own lowest one. */
#include "sim/sort_axis.h"

#include "base/memory.h"

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
} Ball;

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

static OzStatus sweep(OzPairs *list, const Ball *balls, int64_t count, double skin)
{
    for (int64_t i = 0; i < count; i++) {
        double lowest = balls[i].bottom - skin;
        for (int64_t j = i + 1; j < count && balls[j].top > lowest; j++) {
            OzStatus status =
                near(&balls[i], &balls[j], skin) ? add(list, &balls[i], &balls[j]) : OZ_OK;
            if (status != OZ_OK) {
                return status;
            }
        }
    }
    return OZ_OK;
}

OzStatus oz_sort_axis_pairs(OzPairs *list, const OzGrains *grains, const double *position,
                            const double *axis, double skin)
{
    OzStatus status = OZ_OK;
    Ball *balls = NULL;
    list->count = 0;
    if (grains->count > INT_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "%lld grains, at most %d", (long long)grains->count,
                              INT_MAX);
    }
    OZ_TRY(OZ_NEW(&balls, grains->count));
    for (int i = 0; i < (int)grains->count; i++) {
        balls[i] = enclose(grains, &position[3 * (int64_t)i], &axis[3 * (int64_t)i], i);
    }
    qsort(balls, (size_t)grains->count, sizeof *balls, from_the_top);
    OZ_TRY(sweep(list, balls, grains->count, skin));
    if (list->count > 0) {
        qsort(list->pair, (size_t)list->count, sizeof *list->pair, by_ids);
    }
done:
    free(balls);
    return status;
}

void oz_sort_axis_free(OzPairs *list)
{
    free(list->pair);
    memset(list, 0, sizeof *list);
}
