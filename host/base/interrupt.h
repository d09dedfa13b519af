/* Ctrl-C and friends as a question that a loop asks. */
#pragma once

#include <stdbool.h>

/* From now on SIGINT, SIGTERM and SIGHUP (unless it was ignored, as under nohup) end the process
 * with status 130, at once: nothing is being written yet. A file-size limit becomes a failed write.
 */
void oz_interrupt_watch(void);

/* From now on they end nothing by themselves. */
void oz_interrupt_hold(void);

/* Whether one has come since. */
bool oz_interrupt_asked(void);
