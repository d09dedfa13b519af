/* Child processes. */
#include "base/subprocess.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/* What a child leaves in the memory that it shares with its parent; the result follows. */
typedef struct Note {
    bool ended;
    OzStatus status;
    char text[4096];
} Note;

static void work_as_child(OzStatus (*work)(void *context), void *context, const void *result,
                          size_t size, Note *note)
{
    note->status = work(context);
    snprintf(note->text, sizeof note->text, "%s", oz_status_text());
    memcpy(note + 1, result, size);
    note->ended = true;
    fflush(NULL);
    _exit(0);
}

static OzStatus wait_for(pid_t child, const Note *note)
{
    int how = 0;
    while (waitpid(child, &how, 0) < 0 && errno == EINTR) {
    }
    if (!note->ended) {
        return oz_status_fail(OZ_ERR_DEVICE, "a benchmark's process ended by %s %d",
                              WIFSIGNALED(how) ? "signal" : "exit status",
                              WIFSIGNALED(how) ? WTERMSIG(how) : WEXITSTATUS(how));
    }
    return note->status == OZ_OK ? OZ_OK : oz_status_fail(note->status, "%s", note->text);
}

OzStatus oz_subprocess_run(OzStatus (*work)(void *context), void *context, void *result,
                           size_t size)
{
    size_t bytes = sizeof(Note) + size;
    Note *note = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (note == MAP_FAILED) {
        return oz_status_fail(OZ_ERR_MEMORY, "no memory to share with another process: %s",
                              strerror(errno));
    }
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        work_as_child(work, context, result, size, note);
    }
    OzStatus status = child > 0 ? wait_for(child, note)
                                : oz_status_fail(OZ_ERR_DEVICE, "no process: %s", strerror(errno));
    if (note->ended) {
        memcpy(result, note + 1, size);
    }
    munmap(note, bytes);
    return status;
}
