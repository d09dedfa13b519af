/* Being asked to end: a question that long work asks between its steps. */
#pragma once

#include <stdbool.h>

/* For a program's main alone: it changes what signals do to the whole process. From now on the
 * first SIGINT or SIGTERM, or SIGHUP of a terminal that goes away (unless it was ignored, as under
 * nohup), asks as oz_interrupt_ask does. One that comes more than a second later ends the process
 * as it does by default. */
void oz_interrupt_watch(void);

/* Whether a SIGHUP came since the last call that asks for files to be read again: any but that of a
 * terminal that has gone, which asks the process to end. From any thread. */
bool oz_interrupt_take_reread(void);

/* Asks all runs of the process to end in order, from any thread: for a user of the library, who
 * watches no signals. It cannot be taken back. */
void oz_interrupt_ask(void);

/* Whether the process was asked to end. From any thread. */
bool oz_interrupt_asked(void);
