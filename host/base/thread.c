/* Starting threads. Knows nothing of their work. */
#include "base/thread.h"

#include "base/log.h"

#include <errno.h>
#include <stdlib.h>

/* What a thread begins with. */
typedef struct Start {
    void *(*work)(void *);
    void *argument;
    OzLog *log;
} Start;

static void *begin(void *allocated)
{
    Start start = *(Start *)allocated;
    free(allocated);
    oz_log_use(start.log);
    return start.work(start.argument);
}

int oz_thread_start(pthread_t *thread, void *(*work)(void *), void *argument)
{
    Start *start = malloc(sizeof *start);
    if (!start) {
        return ENOMEM;
    }
    *start = (Start){work, argument, oz_log_used()};
    int code = pthread_create(thread, NULL, begin, start);
    if (code != 0) {
        free(start);
    }
    return code;
}
