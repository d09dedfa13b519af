/* Printing a range. */
#include "command/inspect_range.h"

#include <stdbool.h>
#include <string.h>

void oz_inspect_range_print(FILE *file, const char *name, double low, double high, const char *unit)
{
    char from[32], to[32];
    snprintf(from, sizeof from, "%.6g", low);
    snprintf(to, sizeof to, "%.6g", high);
    bool same = strcmp(from, to) == 0;
    fprintf(file, "  %-16s %s%s%s %s\n", name, from, same ? "" : " ... ", same ? "" : to, unit);
}
