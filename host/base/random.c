/* Counter-based random numbers. */
#include "base/random.h"

#include <math.h>

static uint64_t mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

OzRandom oz_random_stream(uint64_t seed, uint64_t stream)
{
    return (OzRandom){.seed = seed, .stream = stream, .counter = 0};
}

uint64_t oz_random_bits(OzRandom *random)
{
    uint64_t golden = 0x9e3779b97f4a7c15u;
    uint64_t key = mix(random->seed + golden) ^ mix(random->stream * golden + 1);
    return mix(key + golden * ++random->counter);
}

double oz_random_uniform(OzRandom *random, double low, double high)
{
    return low + (high - low) * (double)(oz_random_bits(random) >> 11) * 0x1p-53;
}

/* Box and Muller (1958); of their two numbers one. */
double oz_random_normal(OzRandom *random)
{
    const double PI = 3.14159265358979323846;
    double length = sqrt(-2 * log(1 - oz_random_uniform(random, 0, 1)));
    return length * cos(oz_random_uniform(random, 0, 2 * PI));
}

void oz_random_direction(OzRandom *random, double direction[3])
{
    double height = oz_random_uniform(random, -1, 1);
    double angle = oz_random_uniform(random, 0, 2 * 3.14159265358979323846);
    double ring = sqrt(1 - height * height);
    direction[0] = ring * cos(angle);
    direction[1] = ring * sin(angle);
    direction[2] = height;
}
