/* The discrete Fourier transform, one harmonic at a time. */
#include "observe/spectrum.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static double mean_of(const double *values, int64_t count)
{
    double sum = 0;
    for (int64_t i = 0; i < count; i++) {
        sum += values[i];
    }
    return sum / (double)count;
}

/* The unit vector that turns is made anew now and then, before rounding has added up. */
double oz_spectrum_amplitude(const double *values, int64_t count, int64_t periods)
{
    enum { TURNS = 256 };
    double turn = 2 * PI * (double)periods / (double)count, mean = mean_of(values, count);
    double c = cos(turn), s = sin(turn), x = 1, y = 0, real = 0, imaginary = 0;
    for (int64_t i = 0; i < count; i++) {
        if (i % TURNS == 0) {
            x = cos(turn * (double)i);
            y = sin(turn * (double)i);
        }
        real += (values[i] - mean) * x;
        imaginary += (values[i] - mean) * y;
        double next = c * x - s * y;
        y = s * x + c * y;
        x = next;
    }
    double twin = 2 * periods == count ? 1 : 2; /* all others have one of negative frequency */
    return twin * hypot(real, imaginary) / (double)count;
}
