/* Counter-based random numbers: a value depends on (seed, stream, counter) alone, so that grain 17 of
 * population 2 is the same whatever else was drawn, on any number of threads.
 * SplitMix64 finaliser over a mixed counter (Steele, Lea & Flood 2014). */
#pragma once

#include <stdint.h>

typedef struct OzRandom {
    uint64_t seed, stream, counter; /* counter is the number of values drawn so far */
} OzRandom;

OzRandom oz_random_stream(uint64_t seed, uint64_t stream);

/* The next 64 random bits. */
uint64_t oz_random_bits(OzRandom *random);

/* The next number, uniform in [low, high). */
double oz_random_uniform(OzRandom *random, double low, double high);

/* The next number of the normal distribution about 0 with variance 1. */
double oz_random_normal(OzRandom *random);

/* A unit vector, uniform on the sphere. */
void oz_random_direction(OzRandom *random, double direction[3]);
