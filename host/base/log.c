/* Log lines. Knows nothing of simulations. */
#include "base/log.h"

#include "base/clock.h"
#include "base/memory.h"

#include <errno.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ONCE_MOST = 4 }; /* lines that a log says once */

struct OzLog {
    pthread_mutex_t mutex;
    FILE *stream, *file; /* either may be NULL                 */
    bool waits;          /* for a file: lines are kept till then */
    char *early;         /* those lines                        */
    const char *said[ONCE_MOST];
    bool progress_shown;
    double pace;       /* s between plain progress lines              */
    double next_plain; /* on oz_clock_now, of the next; -1: not begun */
};

/* As errno is: what a thread's code speaks to without being handed it. */
static _Thread_local OzLog *used;

OzStatus oz_log_create(OzLog **log, FILE *stream, bool waits)
{
    OZ_PASS(OZ_NEW(log, 1));
    pthread_mutex_init(&(*log)->mutex, NULL);
    (*log)->stream = stream;
    (*log)->waits = waits;
    (*log)->pace = 10;
    (*log)->next_plain = -1;
    return OZ_OK;
}

static OzStatus open_file(OzLog *log, const char *path, const char *mode)
{
    FILE *file = fopen(path, mode);
    if (!file) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    pthread_mutex_lock(&log->mutex);
    if (log->file) {
        fclose(log->file);
    }
    fputs(log->early ? log->early : "", file);
    free(log->early);
    log->early = NULL;
    log->waits = false;
    log->file = file;
    pthread_mutex_unlock(&log->mutex);
    return OZ_OK;
}

OzStatus oz_log_open(OzLog *log, const char *path)
{
    return open_file(log, path, "w");
}

OzStatus oz_log_go_on(OzLog *log, const char *path)
{
    return open_file(log, path, "a");
}

void oz_log_free(OzLog *log)
{
    if (!log) {
        return;
    }
    if (log->file) {
        fclose(log->file);
    }
    pthread_mutex_destroy(&log->mutex);
    free(log->early);
    free(log);
}

OzLog *oz_log_use(OzLog *log)
{
    OzLog *before = used;
    used = log;
    return before;
}

OzLog *oz_log_used(void)
{
    return used;
}

FILE *oz_log_stream(void)
{
    return used ? used->stream : stderr;
}

/* The rest down to the functions of log.h wants the mutex held. */
static void clear_progress(OzLog *log)
{
    if (log->progress_shown) {
        fputs("\r\033[K", log->stream);
        log->progress_shown = false;
    }
}

/* Adds a line to those that wait for a file. Without memory for it it is lost there. */
static void keep_early(OzLog *log, const char *line)
{
    char *longer = NULL;
    if (asprintf(&longer, "%s%s\n", log->early ? log->early : "", line) >= 0) {
        free(log->early);
        log->early = longer;
    }
}

/* A file that takes no more is said once, then left alone. */
static void write_file(OzLog *log, const char *line)
{
    if (log->waits) {
        keep_early(log, line);
    }
    if (!log->file) {
        return;
    }
    fprintf(log->file, "%s\n", line);
    if (fflush(log->file) != 0) {
        if (log->stream) {
            clear_progress(log);
            fprintf(log->stream, "warning: log.txt cannot be written any more: %s\n",
                    strerror(errno));
        }
        fclose(log->file);
        log->file = NULL;
    }
}

/* Whether this format has been said; notes it. */
static bool was_said(OzLog *log, const char *format)
{
    for (int i = 0; i < ONCE_MOST; i++) {
        if (!log->said[i] || log->said[i] == format) {
            bool before = log->said[i] != NULL;
            log->said[i] = format;
            return before;
        }
    }
    return false;
}

static bool is_blank(const char *text)
{
    return text[strspn(text, " ")] == '\0';
}

static void draw_progress(OzLog *log, const char *text)
{
    clear_progress(log);
    if (!is_blank(text)) {
        fputs(text, log->stream);
        log->progress_shown = true;
    }
    fflush(log->stream);
}

static void print_progress(OzLog *log, const char *text)
{
    double now = oz_clock_now();
    if (log->next_plain < 0) {
        log->next_plain = now + log->pace;
    }
    if (now >= log->next_plain && !is_blank(text)) {
        fprintf(log->stream, "%s\n", text);
        log->next_plain = now + log->pace;
    }
}

/* A line for the stream (unless it is a detail) and for the file, unless it was said. */
static void write_line(bool detail, const char *once, const char *format, va_list arguments)
{
    char *line = NULL;
    OzLog *log = used;
    if (vasprintf(&line, format, arguments) < 0) {
        return;
    }
    if (log) {
        pthread_mutex_lock(&log->mutex);
        if (!once || !was_said(log, once)) {
            if (log->stream && !detail) {
                clear_progress(log);
                fprintf(log->stream, "%s\n", line);
            }
            write_file(log, line);
        }
        pthread_mutex_unlock(&log->mutex);
    } else if (!detail) {
        fprintf(stderr, "%s\n", line);
    }
    free(line);
}

void oz_log_line(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(false, NULL, format, arguments);
    va_end(arguments);
}

void oz_log_once(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(false, format, format, arguments);
    va_end(arguments);
}

void oz_log_detail(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(true, NULL, format, arguments);
    va_end(arguments);
}

void oz_log_progress(const char *format, ...)
{
    char text[512];
    va_list arguments;
    OzLog *log = used;
    if (!log || !log->stream) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pthread_mutex_lock(&log->mutex);
    if (isatty(fileno(log->stream))) {
        draw_progress(log, text);
    } else {
        print_progress(log, text);
    }
    pthread_mutex_unlock(&log->mutex);
}

void oz_log_pace(double seconds)
{
    if (used) {
        pthread_mutex_lock(&used->mutex);
        used->pace = seconds;
        used->next_plain = -1;
        pthread_mutex_unlock(&used->mutex);
    }
}
