/* Checked allocation. */
#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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

OzStatus oz_memory_text(char **copy, const char *text)
{
    *copy = NULL;
    if (!text) {
        return OZ_OK;
    }
    *copy = strdup(text);
    return *copy ? OZ_OK : oz_status_fail(OZ_ERR_MEMORY, "out of memory for a text");
}
