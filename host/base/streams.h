/* The three standard streams: safe from the start of the program, judged at its end. */
#pragma once

#include "base/status.h"

/* For a program's main alone, before any file is opened, since streams and signals are the
 * process's. A standard descriptor that the starter closed is opened, so that no later file gets
 * its number and with it what the program says; what is read from it or written to it then fails.
 * From now on writing to a reader that has left, or beyond the limit of a file's size, fails with
 * an error that has a name instead of ending the program (SIGPIPE, SIGXFSZ). Children inherit this.
 */
void oz_streams_open(void);

/* Sends what was printed to stdout on its way. Fails with OZ_ERR_FILE when some of it did not
 * arrive (a full disk, a closed stream); a reader that has left, as `head` does, is no failure. */
OzStatus oz_streams_flush(void);
