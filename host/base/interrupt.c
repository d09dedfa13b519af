/* Signals. */
#include "base/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted, held;

static void note_signal(int number)
{
    (void)number;
    interrupted = 1;
    if (!held) {
        _exit(130);
    }
}

void oz_interrupt_watch(void)
{
    struct sigaction action = {.sa_handler = note_signal}, before;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
        sigaction(SIGHUP, &action, NULL); /* under nohup it stays ignored */
    }
    signal(SIGXFSZ,
           SIG_IGN); /* a file-size limit is then an error of the write, which has a name */
}

void oz_interrupt_hold(void)
{
    held = 1;
}

bool oz_interrupt_asked(void)
{
    return interrupted != 0;
}
