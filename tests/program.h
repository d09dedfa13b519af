/* The program run as its users run it, in a folder of the test's own. */
#ifndef OZ_TESTS_PROGRAM_H
#define OZ_TESTS_PROGRAM_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static char work[] = "/tmp/orzo_test_XXXXXX"; /* the working folder of the test and the program */

static inline int enter_work(void **state)
{
    (void)state;
    return mkdtemp(work) && chdir(work) == 0 ? 0 : -1;
}

static inline int leave_work(void **state)
{
    char command[64];
    (void)state;
    snprintf(command, sizeof command, "rm -r '%s'", work);
    return chdir("/") == 0 && system(command) == 0 ? 0 : -1;
}

/* Writes text (printf style) to a file of the working folder. */
static inline void write_file(const char *name, const char *format, ...)
{
    va_list arguments;
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    va_start(arguments, format);
    vfprintf(file, format, arguments);
    va_end(arguments);
    assert_int_equal(fclose(file), 0);
}

/* The whole file with a zero byte at its end; the caller frees it. size may be NULL. */
static inline char *read_file(const char *name, size_t *size)
{
    FILE *file = fopen(name, "rb");
    if (!file) {
        fail_msg("there is no %s", name);
    }
    size_t room = 1 << 24;
    char *text = calloc(room, 1);
    assert_non_null(text);
    size_t got = fread(text, 1, room - 1, file);
    fclose(file);
    if (size) {
        *size = got;
    }
    return text;
}

static inline bool is_there(const char *name)
{
    return access(name, F_OK) == 0;
}

static inline bool contains(const char *name, const char *text)
{
    char *all = read_file(name, NULL);
    bool found = strstr(all, text) != NULL;
    free(all);
    return found;
}

static inline bool same_files(const char *one, const char *other)
{
    size_t size_one, size_other;
    char *a = read_file(one, &size_one), *b = read_file(other, &size_other);
    bool same = size_one == size_other && memcmp(a, b, size_one) == 0;
    free(a);
    free(b);
    return same;
}

/* `orzo` with these arguments (as a shell reads them); what it says goes to the file `said`.
 * Returns its exit status. */
static inline int orzo(const char *arguments)
{
    char command[2048];
    snprintf(command, sizeof command, "'%s' %s >said 2>&1", ORZO_PROGRAM, arguments);
    int status = system(command);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* The same, with the exit status that must come out and a text that must be said. */
static inline void expect(int status, const char *text, const char *arguments)
{
    int got = orzo(arguments);
    if (got != status || !contains("said", text)) {
        char *said = read_file("said", NULL);
        fail_msg("orzo %s: exit status %d, expected %d and \"%s\"; it said:\n%s", arguments, got,
                 status, text, said);
    }
}

/* Starts `orzo` with these arguments, split at spaces, and leaves it running. */
static inline pid_t start_orzo(const char *arguments)
{
    char words[1024], *argv[32] = {ORZO_PROGRAM};
    int count = 1;
    snprintf(words, sizeof words, "%s", arguments);
    for (char *word = strtok(words, " "); word && count < 31; word = strtok(NULL, " ")) {
        argv[count++] = word;
    }
    pid_t child = fork();
    if (child == 0) {
        if (freopen("said", "w", stdout) && dup2(STDOUT_FILENO, STDERR_FILENO) >= 0) {
            execv(ORZO_PROGRAM, argv);
        }
        _exit(127);
    }
    assert_true(child > 0);
    return child;
}

static inline double now_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline void sleep_a_little(void)
{
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
}

/* Waits for the end of a started program; -1 when it takes longer, and it is then killed. */
static inline int wait_for(pid_t child, double seconds)
{
    double end = now_seconds() + seconds;
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (now_seconds() > end) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return -1;
        }
        sleep_a_little();
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* Line `index` of a text, in a buffer that the next call uses again. */
static inline const char *line_of(const char *text, int index)
{
    static char line[4096];
    for (; index > 0 && text; index--) {
        text = strchr(text, '\n');
        text = text ? text + 1 : NULL;
    }
    snprintf(line, sizeof line, "%.*s", text ? (int)strcspn(text, "\n") : 0, text ? text : "");
    return line;
}

static inline int count_lines(const char *name)
{
    char *text = read_file(name, NULL);
    int lines = 0;
    for (const char *c = text; *c; c++) {
        lines += *c == '\n';
    }
    free(text);
    return lines;
}

/* Whether an mp4 file is whole: its boxes fill it, and the index is one of them. */
static inline bool is_playable(const char *name)
{
    size_t size, at = 0;
    bool index = false, data = false;
    unsigned char *bytes = (unsigned char *)read_file(name, &size);
    while (at + 8 <= size) {
        size_t box = (size_t)bytes[at] << 24 | (size_t)bytes[at + 1] << 16 |
                     (size_t)bytes[at + 2] << 8 | bytes[at + 3];
        index |= memcmp(bytes + at + 4, "moov", 4) == 0;
        data |= memcmp(bytes + at + 4, "mdat", 4) == 0 && box > 8;
        at += box < 8 ? size : box;
    }
    free(bytes);
    return index && data && at == size;
}

#endif
