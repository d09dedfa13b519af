/* Trials in a forked process. Knows nothing of what is tried. */
#include "draw/tryout.h"

#include "base/log.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    PATIENCE = 120, /* s: a copy of a process with threads may hang in one of their locks       */
    TEXT_SIZE = 2048
};

/* Address space that must be left over: what the process's arrays may grow by, and for each of its
 * threads a heap of glibc's, since in the copy the heaps of threads that it has not serve new ones.
 */
static const size_t RESERVE = (size_t)64 << 20, HEAP = (size_t)64 << 20;

static const char *const ADVICE = "expected more, a smaller picture, or --no-video";

/* What the copy tells. */
typedef struct Verdict {
    OzStatus status;
    char text[TEXT_SIZE];
} Verdict;

static OzStatus fail(const struct rlimit *limit, const char *how)
{
    return oz_status_fail(OZ_ERR_GRAPHICS,
                          "pictures do not fit into the %.3g GB of address space that this process "
                          "may have (ulimit -v %llu): %s; %s",
                          (double)limit->rlim_cur / 1e9, (unsigned long long)limit->rlim_cur / 1024,
                          how, ADVICE);
}

static bool has_room(size_t bytes)
{
    return mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
}

static size_t count_threads(void)
{
    size_t count = 0;
    DIR *tasks = opendir("/proc/self/task");
    for (struct dirent *task = tasks ? readdir(tasks) : NULL; task; task = readdir(tasks)) {
        count += task->d_name[0] != '.';
    }
    if (tasks) {
        closedir(tasks);
    }
    return count;
}

/* Silence: no word to the log, the terminal or a core file. */
static void fall_silent(void)
{
    int nowhere = open("/dev/null", O_RDWR);
    oz_log_use(NULL);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
}

/* Lets a death by a signal be one, whatever handlers there are. */
static void take_signals(void)
{
    static const int signals[] = {SIGSEGV, SIGBUS, SIGABRT, SIGALRM, SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        signal(signals[i], SIG_DFL);
    }
}

static _Noreturn void try_here(OzStatus (*work)(void *), void *argument, size_t reserve, int out)
{
    Verdict verdict = {OZ_OK, ""};
    take_signals();
    fall_silent();
    alarm(PATIENCE);
    verdict.status = work(argument);
    if (verdict.status == OZ_OK && !has_room(reserve)) {
        verdict.status =
            oz_status_fail(OZ_ERR_GRAPHICS, "pictures leave hardly any memory over; %s", ADVICE);
    }
    if (verdict.status != OZ_OK) {
        snprintf(verdict.text, sizeof verdict.text, "%s", oz_status_text());
    }
    _exit(write(out, &verdict, sizeof verdict) == (ssize_t)sizeof verdict ? 0 : 1);
}

/* Nothing that the copy did: its patience, or somebody who ends both. */
static bool is_from_outside(int number)
{
    return number == SIGALRM || number == SIGINT || number == SIGTERM || number == SIGHUP;
}

static OzStatus judge(const struct rlimit *limit, int outcome, const Verdict *verdict, ssize_t got)
{
    char how[128];
    if (WIFSIGNALED(outcome) && is_from_outside(WTERMSIG(outcome))) {
        return OZ_OK;
    }
    if (WIFSIGNALED(outcome)) {
        snprintf(how, sizeof how, "a trial of them ended by signal %d (%s)", WTERMSIG(outcome),
                 strsignal(WTERMSIG(outcome)));
        return fail(limit, how);
    }
    if (got != (ssize_t)sizeof *verdict) {
        return fail(limit, "a trial of them came to no end");
    }
    if (verdict->status == OZ_OK) {
        return OZ_OK;
    }
    return oz_status_fail(verdict->status,
                          "%s (this process may have no more than %.3g GB of address space: "
                          "ulimit -v %llu)",
                          verdict->text, (double)limit->rlim_cur / 1e9,
                          (unsigned long long)limit->rlim_cur / 1024);
}

OzStatus oz_tryout_run(OzStatus (*work)(void *argument), void *argument)
{
    struct rlimit limit;
    int ends[2], outcome = 0;
    Verdict verdict = {OZ_OK, ""};
    ssize_t got = 0;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || pipe(ends) != 0) {
        return OZ_OK;
    }
    size_t reserve = RESERVE + HEAP * count_threads();
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        try_here(work, argument, reserve, ends[1]);
    }
    close(ends[1]);
    while (child > 0 && (got = read(ends[0], &verdict, sizeof verdict)) < 0 && errno == EINTR) {
    }
    close(ends[0]);
    while (child > 0 && waitpid(child, &outcome, 0) < 0 && errno == EINTR) {
    }
    return child > 0 ? judge(&limit, outcome, &verdict, got) : OZ_OK;
}
