/* Numbers in the device's precision, in host memory. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

size_t oz_scalars_bytes(bool is_double);

/* Converts doubles to the device's scalars at `to`. */
void oz_scalars_put(void *to, const double *from, size_t count, bool is_double);

/* One of the device's scalars. */
double oz_scalars_get(const void *words, size_t index, bool is_double);
