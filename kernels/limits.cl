/* What a device can do at best, to hold a step against: moving memory and multiplying with addition, both
 * in the lanes that the physics uses. Knows nothing of grains. */
#include "kernels/real.h"

/* Copies count reals, forth and back in turn so that no copy is idle. A CPU's work-item takes a stretch
 * of its own, a GPU's takes every items-th. */
kernel void oz_copy(global real *a, global real *b, int count, int repeats)
{
    int item = (int)get_global_id(0), items = (int)get_global_size(0);
#if OZ_GROUP == 1
    int begin = (int)((long)count * item / items), end = (int)((long)count * (item + 1) / items);
    int stride = 1;
#else
    int begin = item, end = count, stride = items;
#endif
    for (int k = 0; k < repeats; k++) {
        global real *from = k % 2 ? b : a, *to = k % 2 ? a : b;
        for (int i = begin; i < end; i += stride) {
            to[i] = from[i];
        }
    }
}

/* Chains that do not wait for each other: enough for two units of a latency of four, and few enough for
 * 16 registers. */
enum { OZ_CHAINS = 10 };

/* out receives one real a work-item, so that nothing is left out. */
kernel void oz_multiply_add(global real *out, int repeats)
{
    int item = (int)get_global_id(0);
    real chain[OZ_CHAINS], factor = REAL(0.999) + REAL(1e-6) * REAL(item), more = REAL(0.001);
#pragma unroll
    for (int c = 0; c < OZ_CHAINS; c++) {
        chain[c] = REAL(c + item);
    }
    for (int k = 0; k < repeats; k++) {
#pragma unroll
        for (int c = 0; c < OZ_CHAINS; c++) {
            chain[c] = fma(chain[c], factor, more);
        }
    }
    real sum = chain[0];
#pragma unroll
    for (int c = 1; c < OZ_CHAINS; c++) {
        sum += chain[c];
    }
    out[item] = sum;
}
