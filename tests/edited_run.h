/* Runs of the program whose scene is edited while they go, what they say, and their repetitions. */
#ifndef OZ_TESTS_EDITED_RUN_H
#define OZ_TESTS_EDITED_RUN_H

#include "program.h"
#include "run_bed.h"

#include <fcntl.h>
#include <sys/prctl.h>

static inline pid_t start(const char *arguments)
{
    char *words[32] = {(char *)(uintptr_t)ORZO_PROGRAM}, copy[512], *rest = copy;
    int count = 1;
    snprintf(copy, sizeof copy, "%s", arguments);
    for (char *word = strsep(&rest, " "); word && count < 31; word = strsep(&rest, " ")) {
        words[count++] = word;
    }
    remove("said");
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a test that fails leaves no run behind */
        int said = open("said", O_CREAT | O_WRONLY | O_TRUNC, 0644);
        dup2(said, 1);
        dup2(said, 2);
        execv(ORZO_PROGRAM, words);
        _exit(99);
    }
    return child;
}

static inline int end_of(pid_t child)
{
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static inline double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static inline void rest(int milliseconds)
{
    usleep((useconds_t)milliseconds * 1000);
}

/* Waits until a file holds the text; a run that is slow to start has three minutes. */
static inline void await(const char *name, const char *text)
{
    for (int i = 0; i < 9000; i++) {
        if (is_there(name) && contains(name, text)) {
            return;
        }
        rest(20);
    }
    char *all = is_there(name) ? read_file(name, NULL) : NULL;
    fail_msg("%s never held \"%s\":\n%s", name, text, all ? all : "(no file)");
}

/* The columns key, old and new of reloads.csv, which do not depend on how fast the machine is. */
static inline void assert_reloads(const char *name, const char *expected)
{
    char *all = read_file(name, NULL), *rest_of = all, told[4096] = "";
    for (char *line = strsep(&rest_of, "\n"); line && *line; line = strsep(&rest_of, "\n")) {
        char *key = strchr(strchr(line, ',') + 1, ',') + 1, *last = strrchr(line, ',');
        *last = '\0';
        size_t used = strlen(told);
        snprintf(told + used, sizeof told - used, "%s\n", key);
    }
    assert_string_equal(told, expected);
    free(all);
}

/* series.csv and final.csv of the same member ("": a plain run) in two folders. */
static inline void assert_repeated(const char *folder, const char *again, const char *member)
{
    static const char *const names[] = {"series.csv", "final.csv"};
    char one[200], other[200];
    for (int i = 0; i < 2; i++) {
        snprintf(one, sizeof one, "%s/%s/%s", folder, member, names[i]);
        snprintf(other, sizeof other, "%s/%s/%s", again, member, names[i]);
        if (!same_files(one, other)) {
            fail_msg("%s and %s differ", one, other);
        }
    }
}

static inline void run_again(const char *folder)
{
    char command[300], again[100];
    const char *slash = strrchr(folder, '/');
    snprintf(again, sizeof again, "again_%s", slash ? slash + 1 : folder);
    snprintf(command, sizeof command, "run %s --replay -o %s --no-video", folder, again);
    assert_int_equal(end_of(start(command)), 0);
    assert_repeated(folder, again, "");
}

/* The bed, endless for a test, with a friction and a step of its own. */
static inline void write_bed(const char *name, const char *friction, const char *step)
{
    char text[sizeof bed + 100];
    snprintf(text, sizeof text, "%s", bed);
    char *taps = strstr(text, "taps: 2}"), *at = strstr(text, "2e-5");
    memcpy(taps, "taps: 9}", 8);
    memcpy(at, step, 4);
    char *contact = strstr(text, "restitution: 0.5}");
    char tail[sizeof text];
    snprintf(tail, sizeof tail, "restitution: 0.5, friction: %s}%s", friction,
             contact + strlen("restitution: 0.5}"));
    *contact = '\0';
    write_file(name, "%s%s", text, tail);
}

#endif
