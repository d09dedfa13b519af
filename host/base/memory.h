/* Checked memory: sizes are multiplied with overflow checks, memory comes zeroed, and running out
 * is a status with a text rather than a crash. */
#pragma once

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* *pointer receives count zeroed items of size bytes (never NULL on success, also for count 0); the
 * caller frees it with free(). On failure *pointer is NULL. what names the array in the message. */
OzStatus oz_memory_new(void **pointer, size_t count, size_t size, const char *what);

/* Grows *pointer to count items, new items zeroed from old_count on. On failure *pointer is kept. */
OzStatus oz_memory_grow(void **pointer, size_t old_count, size_t count, size_t size,
                        const char *what);

/* Room for so many items: fewer become twice as many, or as many as wanted if that is more, new ones
 * zeroed. On failure both are kept. */
OzStatus oz_memory_room(void **pointer, int64_t *capacity, int64_t wanted, size_t size,
                        const char *what);

/* A copy of text made with malloc, or NULL for NULL; the caller frees it. */
OzStatus oz_memory_text(char **copy, const char *text);

/* Bytes that this process may use at most: the machine's memory, or the limit of its control group or of its address
 * space where that is less. INFINITY when none of them is told. */
double oz_memory_most(void);

#define OZ_NEW(pointer, count)                                                                     \
    oz_memory_new((void **)(pointer), (size_t)(count), sizeof **(pointer), #pointer)
#define OZ_ROOM(pointer, capacity, wanted, what)                                                   \
    oz_memory_room((void **)(pointer), capacity, wanted, sizeof **(pointer), what)
