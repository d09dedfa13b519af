/* What an evenly sampled series is made of. */
#pragma once

#include <stdint.h>

/* Amplitude of the harmonic that has so many whole periods in the series (1 <= periods <= count/2):
 * a sine of amplitude A with that many periods gives A. */
double oz_spectrum_amplitude(const double *values, int64_t count, int64_t periods);
