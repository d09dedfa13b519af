/* Moving numbers between arrays of records and lanes (OpenCL C only). A record's words are fetched four
 * at a time and turned by 4 x 4 blocks, which serves every width from 4 lanes on; one lane is a plain
 * copy. */
#ifndef OZ_KERNELS_LANES_H
#define OZ_KERNELS_LANES_H

#include "kernels/vec3.h"

typedef OZ_PASTE(OZ_REAL_NAME, 4) scalar4;

#if OZ_LANES == 1

typedef int index;
#define OZ_LANES_LOAD(array)         ((array)[0])
#define OZ_LANES_STORE(value, array) ((array)[0] = (value))
#define OZ_LANES_IOTA                0
#define oz_lanes_mask_of(m)          (m)

OZ_INLINE void oz_lanes_store_mask(mask m, int *hits)
{
    hits[0] = m ? 1 : 0;
}

OZ_INLINE void oz_lanes_load4(global const scalar *base, const int *slot, int stride, int word,
                              real *out)
{
    global const scalar *record = base + (size_t)slot[0] * stride + word;
    out[0] = record[0];
    out[1] = record[1];
    out[2] = record[2];
    out[3] = record[3];
}

OZ_INLINE void oz_lanes_store4(global scalar *base, int stride, int word, const real *in)
{
    (void)stride;
    base[word] = in[0];
    base[word + 1] = in[1];
    base[word + 2] = in[2];
    base[word + 3] = in[3];
}

#else

typedef OZ_PASTE(int, OZ_LANES) index; /* one integer a lane */
#define OZ_LANES_LOAD(array)         OZ_PASTE(vload, OZ_LANES)(0, (array))
#define OZ_LANES_STORE(value, array) OZ_PASTE(vstore, OZ_LANES)((value), 0, (array))
#if OZ_LANES == 16
#define OZ_LANES_IOTA ((index)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#elif OZ_LANES == 8
#define OZ_LANES_IOTA ((index)(0, 1, 2, 3, 4, 5, 6, 7))
#else
#define OZ_LANES_IOTA ((index)(0, 1, 2, 3))
#endif
/* A comparison of integers as a mask of reals. */
#if defined(OZ_DOUBLE)
#define oz_lanes_mask_of(m) OZ_PASTE(convert_long, OZ_LANES)(m)
#else
#define oz_lanes_mask_of(m) (m)
#endif

/* 1 where the mask holds, else 0. */
OZ_INLINE void oz_lanes_store_mask(mask m, int *hits)
{
    OZ_PASTE(vstore, OZ_LANES)(OZ_PASTE(convert_int, OZ_LANES)(-m), 0, hits);
}

/* Turns 4 x 4 blocks: lane 4g + r of row w becomes lane 4g + w of row r. */
#if OZ_LANES == 16
#define OZ_LANES_PAIRS_LOW(a, b)                                                                   \
    __builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29)
#define OZ_LANES_PAIRS_HIGH(a, b)                                                                  \
    __builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31)
#define OZ_LANES_EVEN(a, b)                                                                        \
    __builtin_shufflevector(a, b, 0, 16, 2, 18, 4, 20, 6, 22, 8, 24, 10, 26, 12, 28, 14, 30)
#define OZ_LANES_ODD(a, b)                                                                         \
    __builtin_shufflevector(a, b, 1, 17, 3, 19, 5, 21, 7, 23, 9, 25, 11, 27, 13, 29, 15, 31)
#define OZ_LANES_JOIN(p, r) ((real)(p[r], p[4 + r], p[8 + r], p[12 + r]))
#elif OZ_LANES == 8
#define OZ_LANES_PAIRS_LOW(a, b)  __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13)
#define OZ_LANES_PAIRS_HIGH(a, b) __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15)
#define OZ_LANES_EVEN(a, b)       __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14)
#define OZ_LANES_ODD(a, b)        __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15)
#define OZ_LANES_JOIN(p, r)       ((real)(p[r], p[4 + r]))
#elif OZ_LANES == 4
#define OZ_LANES_PAIRS_LOW(a, b)  __builtin_shufflevector(a, b, 0, 1, 4, 5)
#define OZ_LANES_PAIRS_HIGH(a, b) __builtin_shufflevector(a, b, 2, 3, 6, 7)
#define OZ_LANES_EVEN(a, b)       __builtin_shufflevector(a, b, 0, 4, 2, 6)
#define OZ_LANES_ODD(a, b)        __builtin_shufflevector(a, b, 1, 5, 3, 7)
#define OZ_LANES_JOIN(p, r)       (p[r])
#endif

OZ_INLINE void oz_lanes_turn(real *rows)
{
    real a = OZ_LANES_PAIRS_LOW(rows[0], rows[2]), b = OZ_LANES_PAIRS_LOW(rows[1], rows[3]);
    real c = OZ_LANES_PAIRS_HIGH(rows[0], rows[2]), d = OZ_LANES_PAIRS_HIGH(rows[1], rows[3]);
    rows[0] = OZ_LANES_EVEN(a, b);
    rows[1] = OZ_LANES_ODD(a, b);
    rows[2] = OZ_LANES_EVEN(c, d);
    rows[3] = OZ_LANES_ODD(c, d);
}

/* out[w] receives word `word + w` of the records slot[0], slot[1], ... */
OZ_INLINE void oz_lanes_load4(global const scalar *base, const int *slot, int stride, int word,
                              real *out)
{
    scalar4 part[OZ_LANES];
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        part[l] = *(global const scalar4 *)(base + (size_t)slot[l] * stride + word);
    }
#pragma unroll
    for (int r = 0; r < 4; r++) {
        out[r] = OZ_LANES_JOIN(part, r);
    }
    oz_lanes_turn(out);
}

/* Lane l of in[w] goes to word `word + w` of record l of base. in is used up. */
OZ_INLINE void oz_lanes_store4(global scalar *base, int stride, int word, real *in)
{
    oz_lanes_turn(in);
#pragma unroll
    for (int r = 0; r < 4; r++) {
        scalar part[OZ_LANES];
        OZ_PASTE(vstore, OZ_LANES)(in[r], 0, part);
#pragma unroll
        for (int g = 0; g < OZ_LANES / 4; g++) {
            *(global scalar4 *)(base + (size_t)(4 * g + r) * stride + word) = vload4(g, part);
        }
    }
}

#endif

/* Writes the values of the lanes that hit to `to`, closed up, and gives their number. Up to OZ_LANES places
 * are written, whatever the number. Where the device has an instruction for it, that is used: the loop
 * takes most of a list's rebuild otherwise. */
OZ_INLINE int oz_lanes_compact(int *to, index values, mask hits)
{
#if OZ_LANES == 16 && !defined(OZ_DOUBLE) && defined(__AVX512F__) && defined(__AVX512DQ__)
    ushort bits = __builtin_ia32_cvtd2mask512(hits);
    vstore16(__builtin_ia32_compresssi512_mask(values, values, bits), 0, to);
    return popcount(bits);
#else
    int value[OZ_LANES], hit[OZ_LANES], count = 0;
    OZ_LANES_STORE(values, value);
    oz_lanes_store_mask(hits, hit);
    for (int l = 0; l < OZ_LANES; l++) {
        to[count] = value[l];
        count += hit[l];
    }
    return count;
#endif
}

#endif
