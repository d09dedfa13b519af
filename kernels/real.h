/* The arithmetic dialect that every physics header is written in. `real` is what one statement
 * computes on: a double on the host, a float or double on a GPU, a vector with one lane per contact
 * or grain on a CPU device. The includer declares the dialect, it is never guessed: OZ_HOST host C,
 * real = double OZ_LANES 1|4|8|16 [OZ_DOUBLE]  OpenCL C, real = that many float or double lanes
 * Rules for code in this dialect: literals through REAL(), choices by (condition) ? a : b, which is
 * componentwise on vectors, conditions combined with & and |, no early return, no loop over lanes.
 */
#pragma once

/* Before a loop of few turns over an array: without it a CPU's compiler keeps the array in memory.
 */
#if defined(OZ_HOST)
#define OZ_UNROLL
#else
#define OZ_UNROLL _Pragma("unroll")
#endif

#define OZ_PASTE_(a, b) a##b
#define OZ_PASTE(a, b)  OZ_PASTE_(a, b)

#if defined(OZ_HOST)

#include <math.h>
typedef double scalar;         /* one number                                    */
typedef double real;           /* one number per lane                           */
typedef int mask;              /* what comparing reals gives                    */
typedef double fixed_position; /* a coordinate that stays exact far from origin */
#define REAL(x)   (x)
#define OZ_INLINE static inline
#define OZ_ANY(m) ((m) != 0)
#define OZ_TINY   1e-150 /* its square is still a normal double */
#define OZ_HUGE   1e300  /* beyond this, numbers are none that a motion can have */
#define OZ_PARALLEL                                                                                \
    1e-24 /* sin^2 of the angle below which shafts count as parallel: rounding's limit */
#define oz_fixed_position_to_real(p)   (p)
#define oz_fixed_position_from_real(r) (r)

#elif defined(OZ_LANES)

#if defined(OZ_DOUBLE)
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double scalar;
#define OZ_TINY      1e-150
#define OZ_HUGE      1e300
#define OZ_PARALLEL  1e-24
#define OZ_REAL_NAME double
#else
typedef float scalar;
#define OZ_TINY      1e-18f
#define OZ_HUGE      1e38f
#define OZ_PARALLEL  1e-10f
#define OZ_REAL_NAME float
#endif

#if OZ_LANES == 1
typedef scalar real;
typedef int mask;
#define OZ_ANY(m) ((m) != 0)
#if defined(OZ_DOUBLE)
typedef double fixed_position;
#define oz_fixed_position_to_real(p)   (p)
#define oz_fixed_position_from_real(r) (r)
#else
typedef int fixed_position;
#define oz_fixed_position_to_real(p)   convert_float(p)
#define oz_fixed_position_from_real(r) convert_int(r)
#define oz_fixed_position_bits(p)      as_float(p)
#define oz_fixed_position_of_bits(r)   as_int(r)
#endif
#else
typedef OZ_PASTE(OZ_REAL_NAME, OZ_LANES) real;
#if defined(OZ_DOUBLE)
typedef OZ_PASTE(long, OZ_LANES) mask;
typedef real fixed_position;
#define oz_fixed_position_to_real(p)   (p)
#define oz_fixed_position_from_real(r) (r)
#else
typedef OZ_PASTE(int, OZ_LANES) mask;
typedef OZ_PASTE(int, OZ_LANES) fixed_position;
#define oz_fixed_position_to_real(p)   OZ_PASTE(convert_float, OZ_LANES)(p)
#define oz_fixed_position_from_real(r) OZ_PASTE(convert_int, OZ_LANES)(r)
#define oz_fixed_position_bits(p)      OZ_PASTE(as_float, OZ_LANES)(p)
#define oz_fixed_position_of_bits(r)   OZ_PASTE(as_int, OZ_LANES)(r)
#endif
#define OZ_ANY(m) any(m)
#endif

#define REAL(x) ((real)((scalar)(x)))
#ifndef OZ_INLINE /* a simulator of devices may have to be told not to inline                      \
                     (tests/conformance.sh) */
#define OZ_INLINE static inline __attribute__((always_inline))
#endif

#if defined(OZ_DOUBLE)
#define oz_fixed_position_bits(p)    (p)
#define oz_fixed_position_of_bits(r) (r)
#endif

#else
#error "declare OZ_HOST or OZ_LANES before including kernels/real.h"
#endif

#if !defined(OZ_HOST) && !defined(OZ_DOUBLE) && OZ_LANES == 16 && defined(__AVX512F__)
#define OZ_FAST_INVERSE 1
#else
#define OZ_FAST_INVERSE 0
#endif

OZ_INLINE real oz_smaller(real a, real b)
{
    return a < b ? a : b;
}

OZ_INLINE real oz_larger(real a, real b)
{
    return a > b ? a : b;
}

OZ_INLINE real oz_clamp_unit(real a)
{
    return oz_larger(REAL(-1.0), oz_smaller(REAL(1.0), a));
}

OZ_INLINE real oz_magnitude(real a)
{
    return oz_larger(a, -a);
}

/* 1/x and 1/sqrt(x). Every force waits for several of these one after another, so where a device
 * has a fast first guess (14 bits) and a Newton step, right to 2 units in the last place, that is
 * taken. */
#if OZ_FAST_INVERSE
OZ_INLINE real oz_inverse(real x)
{
    real guess = __builtin_ia32_rcp14ps512_mask(x, (real)(0), (ushort)0xffff);
    return guess + guess * (1 - x * guess);
}

OZ_INLINE real oz_inverse_root(real x)
{
    real guess = __builtin_ia32_rsqrt14ps512_mask(x, (real)(0), (ushort)0xffff);
    return guess + guess * (0.5f - 0.5f * x * guess * guess);
}
#else
OZ_INLINE real oz_inverse(real x)
{
    return REAL(1.0) / x;
}

OZ_INLINE real oz_inverse_root(real x)
{
    return REAL(1.0) / sqrt(x);
}
#endif
