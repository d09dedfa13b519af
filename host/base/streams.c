/* Standard streams. Knows nothing of what is printed. */
#include "base/streams.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

/* The wrong way round: a closed stdout must not take lines as if someone had them. Descriptors are
 * given out from the lowest, so each open fills the one just found closed. */
void oz_streams_open(void)
{
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; descriptor++) {
        if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
            (void)!open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

/* A pipe or socket whose other end is closed. */
static bool reader_has_left(int descriptor)
{
    struct pollfd asked = {.fd = descriptor, .events = POLLOUT};
    return poll(&asked, 1, 0) == 1 && asked.revents & (POLLERR | POLLHUP);
}

OzStatus oz_streams_flush(void)
{
    errno = 0;
    bool flushed = fflush(stdout) == 0;
    int why = errno;
    if ((flushed && !ferror(stdout)) || reader_has_left(STDOUT_FILENO)) {
        return OZ_OK;
    }
    return oz_status_fail(OZ_ERR_FILE, "orzo: what was printed did not all arrive: %s",
                          why ? strerror(why) : "stdout failed");
}
