/* Bytes to a reader who may be late, slow or gone: a file, a named pipe or the standard output. For
 * a thread of its own: it waits for the reader, and nobody for it. */
#pragma once

#include "base/status.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Zeroed is valid: closed. */
typedef struct OzOutlet {
    const char *path;   /* "-": the standard output; borrowed                               */
    int handle;         /* 0: nobody reads yet                                              */
    int standard;       /* what was the standard output, while it is this; 0: it is not     */
    atomic_bool ending; /* set by oz_outlet_end                                     */
    double since;       /* wall clock, of the writer alone: when it saw that, or 0  */
} OzOutlet;

/* Refuses, with OZ_ERR_INPUT, a terminal and a file that is there. From now on
 * and until oz_outlet_close whatever else writes to a standard output that is this goes to standard
 * error instead. path is borrowed. */
OzStatus oz_outlet_claim(OzOutlet *outlet, const char *path);

/* Opens it; *open is false for a named pipe that nobody reads yet. */
OzStatus oz_outlet_open(OzOutlet *outlet, bool *open);

/* Writes all of it, at the reader's pace. Fails with OZ_ERR_FILE when the reader has left or the
 * disk is full, and when he takes nothing for a second after oz_outlet_end. */
OzStatus oz_outlet_write(OzOutlet *outlet, const void *bytes, size_t count);

/* From another thread: what is written now must come to an end. */
void oz_outlet_end(OzOutlet *outlet);

void oz_outlet_close(OzOutlet *outlet); /* zeroed is fine */
