/* Signals. */
#include "base/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <time.h>

/* A signal is sent to the process, so what came of it is the process's too. */
static volatile sig_atomic_t interrupted;
static struct timespec first; /* when, on the monotonic clock; used by the handler alone */

/* s: what comes sooner is the same wish; timeout(1) sends each signal twice at once. */
static const double REPEAT = 1;

/* A later one ends a program that hangs, by the default action. */
static void note_signal(int number)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (!interrupted) {
        first = now;
        interrupted = 1;
    } else if ((double)(now.tv_sec - first.tv_sec) + 1e-9 * (double)(now.tv_nsec - first.tv_nsec) >
               REPEAT) {
        signal(number, SIG_DFL);
        raise(number);
    }
}

void oz_interrupt_watch(void)
{
    struct sigaction action = {.sa_handler = note_signal}, before;
    sigaddset(&action.sa_mask, SIGINT); /* one at a time: the handler keeps a time */
    sigaddset(&action.sa_mask, SIGTERM);
    sigaddset(&action.sa_mask, SIGHUP);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
        sigaction(SIGHUP, &action, NULL); /* under nohup it stays ignored */
    }
    signal(SIGXFSZ,
           SIG_IGN); /* a file-size limit is then an error of the write, which has a name */
}

bool oz_interrupt_asked(void)
{
    return interrupted != 0;
}
