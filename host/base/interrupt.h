/* Ctrl-C and friends as a question that a loop asks. */
#ifndef OZ_BASE_INTERRUPT_H
#define OZ_BASE_INTERRUPT_H

#include <stdbool.h>

/* For a program's main alone: it changes what signals do to the whole process. From now on the
 * first SIGINT, SIGTERM or SIGHUP (unless it was ignored, as under nohup) is only noted. One that
 * comes more than a second later ends the process as it does by default. A file-size limit becomes
 * a failed write. */
void oz_interrupt_watch(void);

/* Whether one was noted; never, where nobody watches. */
bool oz_interrupt_asked(void);

#endif
