/* Moving numbers between arrays of records and lanes (OpenCL C only). A record's words are fetched four
 * at a time and turned by 4 x 4 blocks, which serves every width from 4 lanes on; one lane is a plain
 * copy. */
#pragma once

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

OZ_INLINE void oz_lanes_rows(const real *in, scalar4 *out)
{
    out[0] = (scalar4)(in[0], in[1], in[2], in[3]);
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

/* Lane l of the four numbers in becomes out[l]. in is used up. */
OZ_INLINE void oz_lanes_rows(real *in, scalar4 *out)
{
    oz_lanes_turn(in);
#pragma unroll
    for (int r = 0; r < 4; r++) {
        scalar part[OZ_LANES];
        OZ_PASTE(vstore, OZ_LANES)(in[r], 0, part);
#pragma unroll
        for (int g = 0; g < OZ_LANES / 4; g++) {
            out[4 * g + r] = vload4(g, part);
        }
    }
}

#endif

/* Lane l of v becomes out[l], with a zero behind. */
OZ_INLINE void oz_lanes_rows3(OzVec3 v, scalar4 *out)
{
    real words[4] = {v.x, v.y, v.z, REAL(0.0)};
    oz_lanes_rows(words, out);
}

/* Lane l of in[w] goes to word `word + w` of record l of base. in is used up. */
OZ_INLINE void oz_lanes_store4(global scalar *base, int stride, int word, real *in)
{
    scalar4 row[OZ_LANES];
    oz_lanes_rows(in, row);
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        *(global scalar4 *)(base + (size_t)l * stride + word) = row[l];
    }
}

/* Where word `word` of an item is in an array of blocks of `words` words, each with one item a lane. */
OZ_INLINE size_t oz_lanes_at(int item, int words, int word)
{
    uint place = (uint)item;
    return (size_t)((place / OZ_LANES) * words + word) * OZ_LANES + place % OZ_LANES;
}

/* That word of item[0], item[1], ... */
OZ_INLINE real oz_lanes_fetch(global const real *blocks, const int *item, int words, int word)
{
    global const scalar *from = (global const scalar *)blocks;
    scalar lane[OZ_LANES];
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        lane[l] = from[oz_lanes_at(item[l], words, word)];
    }
    return OZ_LANES_LOAD(lane);
}

/* value to that word of item[0], item[1], ... */
OZ_INLINE void oz_lanes_put(global real *blocks, const int *item, int words, int word, real value)
{
    global scalar *to = (global scalar *)blocks;
    scalar lane[OZ_LANES];
    OZ_LANES_STORE(value, lane);
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        to[oz_lanes_at(item[l], words, word)] = lane[l];
    }
}

/* Devices with an instruction that closes up lanes are told so: loops over lanes take most of a list's
 * rebuild otherwise. */
#if OZ_LANES == 16 && !defined(OZ_DOUBLE) && defined(__AVX512F__) && defined(__AVX512DQ__)
#define OZ_LANES_BITS(m)             ((ushort)__builtin_ia32_cvtd2mask512(m))
#define OZ_LANES_CLOSE_UP_INDEX(v, b) __builtin_ia32_compresssi512_mask(v, v, b)
#define OZ_LANES_CLOSE_UP_REAL(v, b) __builtin_ia32_compresssf512_mask(v, v, b)
#elif OZ_LANES == 8 && defined(OZ_DOUBLE) && defined(__AVX512VL__) && defined(__AVX512DQ__)
#define OZ_LANES_BITS(m)             ((uchar)__builtin_ia32_cvtq2mask512(m))
#define OZ_LANES_CLOSE_UP_INDEX(v, b) __builtin_ia32_compresssi256_mask(v, v, b)
#define OZ_LANES_CLOSE_UP_REAL(v, b) __builtin_ia32_compressdf512_mask(v, v, b)
#endif

/* Bit l tells whether the mask holds in lane l. */
OZ_INLINE int oz_lanes_bits(mask m)
{
#if defined(OZ_LANES_BITS)
    return OZ_LANES_BITS(m);
#else
    int hit[OZ_LANES], bits = 0;
    oz_lanes_store_mask(m, hit);
    for (int l = 0; l < OZ_LANES; l++) {
        bits |= hit[l] << l;
    }
    return bits;
#endif
}

/* Writes the values of the lanes whose bit is set to `to`, closed up. Up to OZ_LANES places are written, whatever
 * the number of bits. */
OZ_INLINE void oz_lanes_close_up(int *to, index values, int bits)
{
#if defined(OZ_LANES_BITS)
    OZ_LANES_STORE(OZ_LANES_CLOSE_UP_INDEX(values, bits), to);
#else
    int value[OZ_LANES];
    OZ_LANES_STORE(values, value);
    for (int l = 0, count = 0; l < OZ_LANES; l++) {
        to[count] = value[l];
        count += (bits >> l) & 1;
    }
#endif
}

OZ_INLINE void oz_lanes_close_up_real(scalar *to, real values, int bits)
{
#if defined(OZ_LANES_BITS)
    OZ_LANES_STORE(OZ_LANES_CLOSE_UP_REAL(values, bits), to);
#else
    scalar value[OZ_LANES];
    OZ_LANES_STORE(values, value);
    for (int l = 0, count = 0; l < OZ_LANES; l++) {
        to[count] = value[l];
        count += (bits >> l) & 1;
    }
#endif
}

/* The same with a mask; answers how many lanes it holds in. */
OZ_INLINE int oz_lanes_compact(int *to, index values, mask hits)
{
    int bits = oz_lanes_bits(hits);
    oz_lanes_close_up(to, values, bits);
    return popcount(bits);
}
