/* One contact of the yardstick: vectors, the closest points of two shafts of an6's rods, and the
 * linear spring-dashpot with friction. Knows nothing of lists and walls. P is Pournin et al.
 * (2005). */
#ifndef OZ_TESTS_YARDSTICK_CONTACT_H
#define OZ_TESTS_YARDSTICK_CONTACT_H

#include "yardstick.h"

#include <float.h>
#include <math.h>

#define FRICTION 0.1F
#define STEP     OZ_YARDSTICK_STEP
#define DIAMETER OZ_YARDSTICK_DIAMETER
#define RADIUS   (DIAMETER / 2)
#define HALF     OZ_YARDSTICK_HALF
#define SQUARE   (HALF * HALF)
#define MASS     OZ_YARDSTICK_MASS

static inline OzVec along(OzVec a, float s, OzVec b)
{
    return (OzVec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline OzVec minus(OzVec a, OzVec b)
{
    return (OzVec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline float dot(OzVec a, OzVec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline OzVec cross(OzVec a, OzVec b)
{
    return (OzVec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline OzVec scale(OzVec a, float s)
{
    return (OzVec){s * a.x, s * a.y, s * a.z};
}

/* Closest points a + s, b + t of two shafts apart. The best t for a given s needs no cases, so that
 * there is no branch to mispredict. */
static inline OzVec closest(OzVec apart, OzVec a, OzVec b, float *s, float *t)
{
    float ab = dot(a, b), ad = dot(a, apart), bd = dot(b, apart);
    float determinant = fmaxf(SQUARE * SQUARE - ab * ab, 1e-6F * SQUARE * SQUARE);
    *t = fmaxf(-1, fminf(1, (SQUARE * bd - ab * ad) / determinant));
    *s = fmaxf(-1, fminf(1, (ab * *t - ad) / SQUARE));
    *t = fmaxf(-1, fminf(1, (ab * *s + bd) / SQUARE));
    return along(along(apart, *s, a), -*t, b);
}

/* Force on the second body; normal and relative velocity from the first to the second. Stiffness
 * and damping per mass: (pi^2 + ln^2 e) / t_c^2 and -2 ln e / t_c for t_c = 6e-4 s, e = 0.4. */
static inline OzVec contact(float mass, OzVec normal, float overlap, OzVec velocity, OzVec *stretch)
{
    float stiff = mass * 2.974776e7F, damp = mass * 3.054302e3F, rate = -dot(velocity, normal);
    float push = stiff * overlap + damp * rate, limit = FRICTION * fabsf(push), share = 2.0F / 7;
    OzVec sliding = scale(along(velocity, rate, normal), -1);
    OzVec dashpot = scale(sliding, share * damp);
    OzVec force = along(dashpot, share * stiff, along(*stretch, -dot(*stretch, normal), normal));
    force = scale(force, limit / sqrtf(fmaxf(dot(force, force), limit * limit) + FLT_MIN));
    *stretch = along(scale(minus(force, dashpot), 1 / (share * stiff)), STEP, sliding);
    return along(force, push, normal);
}

#endif
