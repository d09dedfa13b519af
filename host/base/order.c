/* Sorting doubles. */
#include "base/order.h"

#include <stdlib.h>

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void oz_order_sort(double *numbers, int64_t count)
{
    if (count > 0) {
        qsort(numbers, (size_t)count, sizeof *numbers, compare);
    }
}

double oz_order_middle(double *numbers, int64_t count)
{
    oz_order_sort(numbers, count);
    return numbers[count / 2];
}
