/* Log lines. Knows nothing of simulations. */
#include "base/log.h"

#include "base/clock.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* stderr's lock is that of these too. */
static FILE *file;
static bool opened; /* a log.txt, once at least */
static char *early; /* lines from before        */
static bool progress_shown;
static double pace = 10;       /* s between plain progress lines              */
static double next_plain = -1; /* on oz_clock_now, of the next; -1: not begun */

static void clear_progress(void)
{
    if (progress_shown) {
        fputs("\r\033[K", stderr);
        progress_shown = false;
    }
}

/* Adds a line to those that wait for a log.txt to be opened. Without memory for it it is lost
 * there. */
static void keep_early(const char *format, va_list arguments)
{
    char *longer = NULL, *line = NULL;
    if (vasprintf(&line, format, arguments) < 0) {
        return;
    }
    if (asprintf(&longer, "%s%s\n", early ? early : "", line) >= 0) {
        free(early);
        early = longer;
    }
    free(line);
}

/* A file that takes no more is said once, then left alone. */
static void write_file(const char *format, va_list arguments)
{
    if (!file) {
        if (!opened) {
            keep_early(format, arguments);
        }
        return;
    }
    vfprintf(file, format, arguments);
    fputc('\n', file);
    if (fflush(file) != 0) {
        clear_progress();
        fprintf(stderr, "warning: log.txt cannot be written any more: %s\n", strerror(errno));
        fclose(file);
        file = NULL;
    }
}

void oz_log_line(const char *format, ...)
{
    va_list arguments;
    flockfile(stderr);
    clear_progress();
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    va_start(arguments, format);
    write_file(format, arguments);
    va_end(arguments);
    funlockfile(stderr);
}

void oz_log_detail(const char *format, ...)
{
    va_list arguments;
    flockfile(stderr);
    va_start(arguments, format);
    write_file(format, arguments);
    va_end(arguments);
    funlockfile(stderr);
}

static bool is_blank(const char *text)
{
    return text[strspn(text, " ")] == '\0';
}

static void draw_progress(const char *text)
{
    clear_progress();
    if (!is_blank(text)) {
        fputs(text, stderr);
        progress_shown = true;
    }
    fflush(stderr);
}

static void print_progress(const char *text)
{
    double now = oz_clock_now();
    if (next_plain < 0) {
        next_plain = now + pace;
    }
    if (now >= next_plain && !is_blank(text)) {
        fprintf(stderr, "%s\n", text);
        next_plain = now + pace;
    }
}

void oz_log_progress(const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    flockfile(stderr);
    if (isatty(STDERR_FILENO)) {
        draw_progress(text);
    } else {
        print_progress(text);
    }
    funlockfile(stderr);
}

void oz_log_pace(double seconds)
{
    flockfile(stderr);
    pace = seconds;
    next_plain = -1;
    funlockfile(stderr);
}

OzStatus oz_log_open(const char *path)
{
    if (file) {
        fclose(file);
        file = NULL;
    }
    if (!path) {
        return OZ_OK;
    }
    file = fopen(path, "w");
    if (!file) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    fputs(early ? early : "", file);
    free(early);
    early = NULL;
    opened = true;
    return OZ_OK;
}
