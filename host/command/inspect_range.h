/* A line about numbers that lie between two. */
#pragma once

#include <stdio.h>

/* `name low ... high unit`, or one number where both are written alike. */
void oz_inspect_range_print(FILE *file, const char *name, double low, double high,
                            const char *unit);
