/* Vectors of three lanes-wide numbers, quaternions, and places: coordinates whose differences are
 * exact. In single precision a place is a 32-bit integer count of length_unit with a carried
 * remainder, so that overlaps keep their digits far from the origin and slow grains do not stall at
 * small steps; in double it is the coordinate itself. A quaternion carries a remainder too. */
#pragma once

#include "kernels/real.h"

typedef struct OzVec3 {
    real x, y, z;
} OzVec3;

typedef struct OzFixedPosition {
    fixed_position x, y, z;
} OzFixedPosition;

typedef struct OzQuaternion { /* turns body z into the shaft's axis */
    real x, y, z, w;
} OzQuaternion;

OZ_INLINE OzVec3 oz_vec3(real x, real y, real z)
{
    OzVec3 v = {x, y, z};
    return v;
}

OZ_INLINE OzVec3 oz_add(OzVec3 a, OzVec3 b)
{
    return oz_vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

OZ_INLINE OzVec3 oz_minus(OzVec3 a, OzVec3 b)
{
    return oz_vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

OZ_INLINE OzVec3 oz_scale(OzVec3 a, real s)
{
    return oz_vec3(a.x * s, a.y * s, a.z * s);
}

/* a + s b */
OZ_INLINE OzVec3 oz_along(OzVec3 a, real s, OzVec3 b)
{
    return oz_vec3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

OZ_INLINE real oz_dot(OzVec3 a, OzVec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

OZ_INLINE OzVec3 oz_cross(OzVec3 a, OzVec3 b)
{
    return oz_vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* a where the condition holds, else b. */
OZ_INLINE OzVec3 oz_choose(mask condition, OzVec3 a, OzVec3 b)
{
    return oz_vec3(condition ? a.x : b.x, condition ? a.y : b.y, condition ? a.z : b.z);
}

/* a where the condition holds, else nothing. */
OZ_INLINE OzVec3 oz_where(mask condition, OzVec3 a)
{
    return oz_choose(condition, a, oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)));
}

#if defined(OZ_HOST) || defined(OZ_DOUBLE)

OZ_INLINE void oz_fixed_position_move(OzFixedPosition *position_, OzVec3 *rest, OzVec3 shift,
                                      scalar inverse_unit)
{
    (void)rest;
    (void)inverse_unit;
    position_->x += shift.x;
    position_->y += shift.y;
    position_->z += shift.z;
}

OZ_INLINE mask oz_fixed_position_is_number(OzFixedPosition p)
{
    return (p.x == p.x) & (p.y == p.y) & (p.z == p.z);
}

#else

/* Integers always are. */
OZ_INLINE mask oz_fixed_position_is_number(OzFixedPosition p)
{
    (void)p;
    return (mask)(-1);
}

OZ_INLINE void oz_fixed_position_move_one(fixed_position *count, real *rest, real shift)
{
    real sum = *rest + shift;
    real whole = rint(sum);
    *count += oz_fixed_position_from_real(whole);
    *rest = sum - whole;
}

/* Moves by shift (m); what is less than one unit stays in rest (units). */
OZ_INLINE void oz_fixed_position_move(OzFixedPosition *position_, OzVec3 *rest, OzVec3 shift,
                                      scalar inverse_unit)
{
    oz_fixed_position_move_one(&position_->x, &rest->x, shift.x * inverse_unit);
    oz_fixed_position_move_one(&position_->y, &rest->y, shift.y * inverse_unit);
    oz_fixed_position_move_one(&position_->z, &rest->z, shift.z * inverse_unit);
}

#endif

/* The shaft's unit axis: body z turned into the world. */
OZ_INLINE OzVec3 oz_quaternion_axis(OzQuaternion q)
{
    return oz_vec3(REAL(2.0) * (q.x * q.z + q.w * q.y), REAL(2.0) * (q.y * q.z - q.w * q.x),
                   REAL(1.0) - REAL(2.0) * (q.x * q.x + q.y * q.y));
}

/* First b, then a. */
OZ_INLINE OzQuaternion oz_quaternion_times(OzQuaternion a, OzQuaternion b)
{
    OzQuaternion q = {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
                      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
    return q;
}

/* What the turn about `angle` (a rotation vector, rad) adds to the turn that changes nothing:
 * series of sin(h)/h and cos(h) - 1 in h^2, h half the angle, exact to 1e-8 up to an angle of 1
 * rad, more than any stable step turns. Its product with q is what the turn adds to q, to full
 * relative precision. */
OZ_INLINE OzQuaternion oz_quaternion_turn(OzVec3 angle)
{
    real h2 = REAL(0.25) * oz_dot(angle, angle);
    real half_sine =
        REAL(0.5) - h2 * (REAL(1.0 / 12) - h2 * (REAL(1.0 / 240) - h2 * (REAL(1.0 / 10080) -
                                                                         h2 * REAL(1.0 / 725760))));
    real cosine_less_one =
        -h2 * (REAL(0.5) - h2 * (REAL(1.0 / 24) - h2 * (REAL(1.0 / 720) - h2 * REAL(1.0 / 40320))));
    OzQuaternion q = {angle.x * half_sine, angle.y * half_sine, angle.z * half_sine,
                      cosine_less_one};
    return q;
}

OZ_INLINE OzQuaternion oz_quaternion_add(OzQuaternion a, OzQuaternion b)
{
    OzQuaternion q = {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
    return q;
}

/* What brings a quaternion of nearly unit length back to it: one step of Newton's. */
OZ_INLINE OzQuaternion oz_quaternion_to_unit(OzQuaternion q)
{
    real share = REAL(0.5) - REAL(0.5) * (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    OzQuaternion change = {q.x * share, q.y * share, q.z * share, q.w * share};
    return change;
}

#if defined(OZ_HOST) || defined(OZ_DOUBLE)

OZ_INLINE void oz_quaternion_move(OzQuaternion *turn, OzQuaternion *rest, OzQuaternion change)
{
    (void)rest;
    *turn = oz_quaternion_add(*turn, change);
}

#else

OZ_INLINE void oz_quaternion_move_one(real *turn, real *rest, real change)
{
    real sum = *rest + change;
    real moved = *turn + sum;
    *rest = sum - (moved - *turn);
    *turn = moved;
}

/* Adds a change; what is less than a digit of turn stays in rest (Kahan 1965). */
OZ_INLINE void oz_quaternion_move(OzQuaternion *turn, OzQuaternion *rest, OzQuaternion change)
{
    oz_quaternion_move_one(&turn->x, &rest->x, change.x);
    oz_quaternion_move_one(&turn->y, &rest->y, change.y);
    oz_quaternion_move_one(&turn->z, &rest->z, change.z);
    oz_quaternion_move_one(&turn->w, &rest->w, change.w);
}

#endif
