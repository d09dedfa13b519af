/* Wall time for progress, benchmarks and reports. Never enters a simulation. */
#ifndef OZ_BASE_CLOCK_H
#define OZ_BASE_CLOCK_H

/* Seconds since an arbitrary start, monotonic. */
double oz_clock_now(void);

/* Processor seconds of all threads of this process: what other programs do to the wall clock does not show. */
double oz_clock_processor(void);

#endif
