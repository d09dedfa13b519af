/* Log lines. Knows nothing of simulations. */
#include "base/log.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* stderr's lock is that of the file and of progress_shown too. */
static FILE *file;
static bool progress_shown;

static void clear_progress(void)
{
    if (progress_shown) {
        fputs("\r\033[K", stderr);
        progress_shown = false;
    }
}

static void write_file(const char *format, va_list arguments)
{
    if (file) {
        vfprintf(file, format, arguments);
        fputc('\n', file);
        if (fflush(file) != 0 || ferror(file)) {
            fprintf(stderr, "log.txt cannot be written any more: %s\n", strerror(errno));
            fclose(file);
            file = NULL;
        }
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

void oz_log_progress(const char *format, ...)
{
    if (!isatty(STDERR_FILENO)) {
        return;
    }
    flockfile(stderr);
    clear_progress();
    va_list arguments;
    va_start(arguments, format);
    progress_shown = vfprintf(stderr, format, arguments) > 0;
    va_end(arguments);
    fflush(stderr);
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
    return OZ_OK;
}
