/* Quiet lines for people. A log is where lines go: a stream that people read, and the log.txt of a
 * run once that is open. Several runs of one process have a log each.
 *
 * Whatever speaks does so to the log of its thread, which oz_log_use sets: where a program or a run
 * begins, and nowhere else. A thread that oz_thread_start starts has the log of its starter. A
 * thread that somebody else started (OpenCL's, an encoder's) has none, and so has a program that
 * never calls oz_log_use: without one, lines go to stderr alone, progress and details nowhere.
 *
 * One log takes lines from any number of threads. A stream that takes no lines (closed, its reader
 * gone) loses them and nothing else; a log.txt that takes none is said on the stream once and
 * closed. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct OzLog OzLog;

/* A log on this stream, which stays the caller's and outlives the log; NULL for a log without one.
 * With waits, lines are kept in memory for the log's first file: for whoever will open one. On
 * failure *log is NULL. */
OzStatus oz_log_create(OzLog **log, FILE *stream, bool waits);

/* Lines go to this file too, from now on, and first those that waited for one. A file that was open
 * is closed. */
OzStatus oz_log_open(OzLog *log, const char *path);

/* The same behind what the file holds already. */
OzStatus oz_log_go_on(OzLog *log, const char *path);

/* Closes the file. No thread may use the log any more. NULL is allowed. */
void oz_log_free(OzLog *log);

/* From now on this thread's lines go to this log; NULL: to none. Returns the one before, for who
 * sets it back. */
OzLog *oz_log_use(OzLog *log);

/* This thread's log and its stream: stderr where it has none. */
OzLog *oz_log_used(void);
FILE *oz_log_stream(void);

/* Writes one line (printf style, no newline at its end). */
void oz_log_line(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same, but a log says it once: further lines of this format, which is a literal, are not
 * written. Each log has room for a few; without room, or without a log, it is said every time. */
void oz_log_once(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Writes one line to the file only: detail that a terminal does not need. */
void oz_log_detail(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* How far a long piece of work is, to be called as often as the caller likes, every time with the
 * whole text. On a terminal the text replaces the one before, and a blank text clears it. Where the
 * stream is a pipe or a file it becomes a line of its own, at most one every ten seconds, counted
 * from the first call; a blank text writes nothing. It never reaches log.txt, which would grow with
 * the run's length. */
void oz_log_progress(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Seconds between the lines of oz_log_progress where the stream is no terminal: 10 from the start.
 * The count begins again. */
void oz_log_pace(double seconds);
