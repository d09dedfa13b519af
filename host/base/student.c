/* Student's t by its finite series: Abramowitz and Stegun 1964, 26.7.3 and 26.7.4, solved by
 * halving. */
#include "base/student.h"

#include <math.h>

/* Probability that |t| < sqrt(degrees) tan(angle). */
static double inside(double angle, int degrees)
{
    const double half_pi = 1.57079632679489661923;
    double cosine = cos(angle), square = cosine * cosine;
    double term = degrees % 2 ? cosine : 1, sum = degrees > 1 ? term : 0;
    for (int k = degrees % 2 ? 3 : 2; k <= degrees - 2; k += 2) {
        term *= square * (k - 1) / k;
        sum += term;
    }
    return degrees % 2 ? (angle + sin(angle) * sum) / half_pi : sin(angle) * sum;
}

double oz_student_limit(int degrees)
{
    double low = 0, high = 1.57079632679489661923;
    if (degrees < 1) {
        return INFINITY;
    }
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (inside(middle, degrees) < 0.95) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return sqrt(degrees) * tan(low);
}

OzMoments oz_student_moments(const double *values, int count)
{
    double n = count, squares = 0;
    OzMoments m = {n > 0 ? 0 : NAN, NAN, INFINITY};
    for (int i = 0; i < count; i++) {
        m.mean += values[i] / n;
    }
    for (int i = 0; i < count; i++) {
        squares += (values[i] - m.mean) * (values[i] - m.mean);
    }
    if (n > 1) {
        m.spread = sqrt(squares / (n - 1));
        m.interval = oz_student_limit(count - 1) * m.spread / sqrt(n);
    }
    return m;
}
