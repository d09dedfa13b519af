/* Quiet lines for people: to stderr, and to the run's log.txt once that is open. A progress line is
 * drawn on a terminal only and never reaches the file. One log per process,
 * whose lines may come from any thread. */
#ifndef OZ_BASE_LOG_H
#define OZ_BASE_LOG_H

#include "base/status.h"

/* Writes one line (printf style, no newline at its end). */
void oz_log_line(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Writes one line to the file only: detail that a terminal does not need. */
void oz_log_detail(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Replaces the progress line on a terminal; does nothing when stderr is no terminal. An empty text
 * clears it. */
void oz_log_progress(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Lines go to this file too, from now on; NULL path closes it. When it cannot be written any more
 * that is said once on stderr, and lines go there alone. */
OzStatus oz_log_open(const char *path);

#endif
