/* Signals. */
#include "base/interrupt.h"

#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <time.h>
#include <unistd.h>

/* A signal is sent to the process, so what came of it is the process's too. Free of locks: a
 * handler sets it and threads ask. */
static atomic_bool asked;

/* Files are to be read again. */
static atomic_bool reread;
static bool had_terminal; /* when signals began to be watched */

/* Whether a signal came, and when, on the monotonic clock; used by the handler alone. */
static bool came;
static struct timespec first;

/* s: what comes sooner is the same wish; timeout(1) sends each signal twice at once. */
static const double REPEAT = 1;

/* A later one ends a program that hangs, by the default action. */
static void note_signal(int number)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    oz_interrupt_ask();
    if (!came) {
        came = true;
        first = now;
    } else if ((double)(now.tv_sec - first.tv_sec) + 1e-9 * (double)(now.tv_nsec - first.tv_nsec) >
               REPEAT) {
        signal(number, SIG_DFL);
        raise(number);
    }
}

/* Asked by the handler: open is safe there. */
static bool has_terminal(void)
{
    int file = open("/dev/tty", O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (file >= 0) {
        close(file);
    }
    return file >= 0;
}

static void note_hangup(int number)
{
    if (had_terminal && !has_terminal()) {
        note_signal(number);
    } else {
        atomic_store(&reread, true);
    }
}

bool oz_interrupt_take_reread(void)
{
    return atomic_exchange(&reread, false);
}

void oz_interrupt_watch(void)
{
    struct sigaction action = {.sa_handler = note_signal}, before;
    sigaddset(&action.sa_mask, SIGINT); /* one at a time: the handler keeps a time */
    sigaddset(&action.sa_mask, SIGTERM);
    sigaddset(&action.sa_mask, SIGHUP);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    had_terminal = has_terminal();
    action.sa_handler = note_hangup;
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
        sigaction(SIGHUP, &action, NULL); /* under nohup it stays ignored */
    }
}

void oz_interrupt_ask(void)
{
    atomic_store(&asked, true);
}

bool oz_interrupt_asked(void)
{
    return atomic_load(&asked);
}
