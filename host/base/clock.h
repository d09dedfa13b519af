/* Wall time for progress, benchmarks and reports. Never enters a simulation. */
#pragma once

#include <stddef.h>

/* Seconds since an arbitrary start, monotonic. */
double oz_clock_now(void);

/* Processor seconds of all threads of this process: what other programs do to the wall clock does
 * not show. */
double oz_clock_processor(void);

/* A duration as people say it, to two or three digits: "0.045 s", "38 s", "4 min 10 s", "2 h 13
 * min", "5 days 3 h"; cut to size. */
void oz_clock_words(double seconds, char *text, size_t size);
