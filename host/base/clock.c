/* The monotonic clock, and durations in words. */
#include "base/clock.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

double oz_clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double oz_clock_processor(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void oz_clock_words(double seconds, char *text, size_t size)
{
    const double minute = 60, hour = 3600, day = 86400;
    double whole = round(seconds);
    if (seconds < 0.95) {
        snprintf(text, size, "%.2g s", seconds);
    } else if (seconds < 9.95) {
        snprintf(text, size, "%.1f s", seconds);
    } else if (whole < 2 * minute) {
        snprintf(text, size, "%.0f s", whole);
    } else if (whole < 2 * hour) {
        snprintf(text, size, "%.0f min %.0f s", floor(whole / minute), fmod(whole, minute));
    } else if (whole < 2 * day) {
        snprintf(text, size, "%.0f h %.0f min", floor(whole / hour),
                 floor(fmod(whole, hour) / minute));
    } else {
        snprintf(text, size, "%.0f days %.0f h", floor(whole / day),
                 floor(fmod(whole, day) / hour));
    }
}
