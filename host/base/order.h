/* Numbers in order. */
#pragma once

#include <stdint.h>

/* From the least to the greatest. */
void oz_order_sort(double *numbers, int64_t count);

/* Sorts them; the middle one, or the upper one of the middle two. */
double oz_order_middle(double *numbers, int64_t count);
