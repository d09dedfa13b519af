/* Quiet lines for people: to stderr, and to the run's log.txt once that is open. One log per
 * process, whose lines may come from any thread. A stderr that takes no lines (closed, its reader
 * gone) loses them and nothing else; a log.txt that takes none is said on stderr once and closed.
 */
#pragma once

#include "base/status.h"

/* Writes one line (printf style, no newline at its end). */
void oz_log_line(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Writes one line to the file only: detail that a terminal does not need. */
void oz_log_detail(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* How far a long piece of work is, to be called as often as the caller likes, every time with the
 * whole text. On a terminal the text replaces the one before, and a blank text clears it. Where
 * stderr is a pipe or a file it becomes a line of its own, at most one every ten seconds, counted
 * from the first call; a blank text writes nothing. It never reaches log.txt, which would grow with
 * the run's length. */
void oz_log_progress(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Seconds between the lines of oz_log_progress where stderr is no terminal: 10 from the start. The
 * count begins again. */
void oz_log_pace(double seconds);

/* Lines go to this file too, from now on, and first those that came before any such file; NULL path
 * closes it. */
OzStatus oz_log_open(const char *path);
