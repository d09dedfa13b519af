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
    struct sigaction action = {.sa_handler = note_signal};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void oz_interrupt_hold(void)
{
    held = 1;
}

bool oz_interrupt_asked(void)
{
    return interrupted != 0;
}
