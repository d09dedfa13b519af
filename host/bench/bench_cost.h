/* How much work a step is, by one counting rule: what the step's description asks for, not what
 * caches or compilers make of it. Bytes: every load and store of the arrays in kernels/fields.h by
 * pairs (two indices, two records, the spring there and back, the result and its two readings by
 * the gather) and by grains (state there and back, the springs at walls, the record, the reference
 * of the list, three list words). Making lists is not counted. Operations: every addition,
 * multiplication, division, root and every comparison with its selection of kernels/rods.h,
 * contact_hooke.h, closest.h and body.h, one each, for capsules that are all equal, the Euler step,
 * forces on surfaces; a wall counts its distances only. Other switches change it by a few per cent.
 */
#pragma once

#include "sim/counters.h"

/* Of one step of everything that the probe counted. */
typedef struct OzBenchCost {
    double bytes, operations;
} OzBenchCost;

OzBenchCost oz_bench_cost_step(const OzCounters *probe);
