/* The three standard streams: safe from the start of the program, judged at its end. */
#pragma once

#include "base/status.h"

/* To be called before any file is opened. A standard descriptor that the starter closed is opened,
 * so that no later file gets its number and with it what the program says; what is read from it or
 * written to it then fails. From now on a reader that leaves ends no program: writing to it fails
 * instead of raising SIGPIPE. Children inherit both. */
void oz_streams_open(void);

/* Sends what was printed to stdout on its way. Fails with OZ_ERR_FILE when some of it did not
 * arrive (a full disk, a closed stream); a reader that has left, as `head` does, is no failure. */
OzStatus oz_streams_flush(void);
