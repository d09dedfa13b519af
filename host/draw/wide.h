/* Loops that become vectors of what the processor has, found out at run time, and not of what any
 * processor has. The operations are the same, one by one: so are the bits. */
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define OZ_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define OZ_WIDE
#endif

/* Where the k-th byte in memory stands in a word of four. */
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define OZ_WIDE_SHIFT(k) (8 * (k))
#else
#define OZ_WIDE_SHIFT(k) (24 - 8 * (k))
#endif
