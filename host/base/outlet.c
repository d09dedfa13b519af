/* Waiting for readers with poll, never in a write. Knows nothing of what the bytes are. */
#include "base/outlet.h"

#include "base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const double PATIENCE = 1; /* s, at the end */

static OzStatus fail(const OzOutlet *outlet, int code)
{
    return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s",
                          outlet->path[0] == '-' ? "to standard output" : outlet->path,
                          code == EPIPE ? "its reader has left" : strerror(code));
}

/* The standard output is kept aside, and its number leads to standard error. */
static OzStatus claim_standard(OzOutlet *outlet)
{
    if (isatty(STDOUT_FILENO)) {
        return oz_status_fail(OZ_ERR_INPUT, "standard output is a terminal; expected a pipe or a "
                                            "file for --stream -, as in `| mpv -`");
    }
    outlet->standard = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (outlet->standard < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        return fail(outlet, errno);
    }
    outlet->handle = outlet->standard;
    return OZ_OK;
}

OzStatus oz_outlet_claim(OzOutlet *outlet, const char *path)
{
    struct stat what;
    outlet->path = path;
    if (strcmp(path, "-") == 0) {
        return claim_standard(outlet);
    }
    if (stat(path, &what) == 0 && S_ISREG(what.st_mode)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s is there already; expected a new file, a named pipe or -", path);
    }
    return OZ_OK;
}

OzStatus oz_outlet_open(OzOutlet *outlet, bool *open_now)
{
    *open_now = true;
    if (outlet->handle > 0) {
        return OZ_OK;
    }
    outlet->handle =
        open(outlet->path, O_WRONLY | O_CREAT | O_TRUNC | O_NONBLOCK | O_CLOEXEC, 0666);
    if (outlet->handle < 0) {
        int code = errno;
        outlet->handle = 0;
        *open_now = false;
        return code == ENXIO ? OZ_OK : fail(outlet, code);
    }
    return OZ_OK;
}

/* Until a write of PIPE_BUF bytes does not wait. */
static OzStatus wait_for_room(OzOutlet *outlet)
{
    struct pollfd room = {.fd = outlet->handle, .events = POLLOUT};
    while (poll(&room, 1, 50) == 0) {
        bool ending = atomic_load(&outlet->ending);
        outlet->since = ending && outlet->since == 0 ? oz_clock_now() : outlet->since;
        if (ending && oz_clock_now() - outlet->since > PATIENCE) {
            return oz_status_fail(OZ_ERR_FILE, "%s: its reader takes no more", outlet->path);
        }
    }
    return OZ_OK;
}

OzStatus oz_outlet_write(OzOutlet *outlet, const void *bytes, size_t count)
{
    const char *at = bytes;
    while (count > 0) {
        OZ_PASS(wait_for_room(outlet));
        ssize_t written = write(outlet->handle, at, count < PIPE_BUF ? count : PIPE_BUF);
        if (written < 0 && errno != EINTR && errno != EAGAIN) {
            return fail(outlet, errno);
        }
        at += written > 0 ? written : 0;
        count -= written > 0 ? (size_t)written : 0;
    }
    return OZ_OK;
}

void oz_outlet_end(OzOutlet *outlet)
{
    atomic_store(&outlet->ending, true);
}

void oz_outlet_close(OzOutlet *outlet)
{
    if (outlet->standard > 0) {
        dup2(outlet->standard, STDOUT_FILENO);
    }
    if (outlet->handle > 0) {
        close(outlet->handle);
    }
    outlet->handle = outlet->standard = 0;
}
