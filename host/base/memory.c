/* Checked allocation. */
#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

OzStatus oz_memory_new(void **pointer, size_t count, size_t size, const char *what)
{
    *pointer = calloc(count ? count : 1, size);
    if (!*pointer) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for %s: %zu items of %zu bytes", what,
                              count, size);
    }
    return OZ_OK;
}

OzStatus oz_memory_grow(void **pointer, size_t old_count, size_t count, size_t size,
                        const char *what)
{
    void *grown = count > SIZE_MAX / size ? NULL : realloc(*pointer, count ? count * size : 1);
    if (!grown) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for %s: %zu items of %zu bytes", what,
                              count, size);
    }
    if (count > old_count) {
        memset((char *)grown + old_count * size, 0, (count - old_count) * size);
    }
    *pointer = grown;
    return OZ_OK;
}

OzStatus oz_memory_room(void **pointer, int64_t *capacity, int64_t wanted, size_t size,
                        const char *what)
{
    int64_t next = wanted > 2 * *capacity ? wanted : 2 * *capacity;
    if (wanted > *capacity) {
        OZ_PASS(oz_memory_grow(pointer, (size_t)*capacity, (size_t)next, size, what));
        *capacity = next;
    }
    return OZ_OK;
}

OzStatus oz_memory_text(char **copy, const char *text)
{
    *copy = NULL;
    if (!text) {
        return OZ_OK;
    }
    *copy = strdup(text);
    return *copy ? OZ_OK : oz_status_fail(OZ_ERR_MEMORY, "out of memory for a text");
}

/* A control group's limit (version 2, then 1); "max" and what cannot be read give INFINITY. */
static double group_limit(void)
{
    static const char *const files[] = {"/sys/fs/cgroup/memory.max",
                                        "/sys/fs/cgroup/memory/memory.limit_in_bytes"};
    double least = INFINITY;
    for (int i = 0; i < 2; i++) {
        double bytes = 0;
        FILE *file = fopen(files[i], "r");
        if (file && fscanf(file, "%lf", &bytes) == 1) {
            least = fmin(least, bytes);
        }
        if (file) {
            fclose(file);
        }
    }
    return least;
}

double oz_memory_most(void)
{
    struct rlimit space;
    double pages = (double)sysconf(_SC_PHYS_PAGES), page = (double)sysconf(_SC_PAGESIZE);
    double most = pages > 0 && page > 0 ? pages * page : INFINITY;
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) {
        most = fmin(most, (double)space.rlim_cur);
    }
    return fmin(most, group_limit());
}
