/* Second moments of a grain's triangles. Knows no colours. */
#include "draw/long_axis.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Adds the integrals of x^2 - y^2, of 2 x y and of x^2 + y^2 over a triangle: of a product of
 * coordinates it is a twelfth of the area times the sum of the corners' products and of the product
 * of their sums. */
static void add_triangle(double sums[3], const double corners[6], const double centre[2])
{
    double x[3], y[3], sum[2] = {0, 0}, xx = 0, yy = 0, xy = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = corners[2 * i] - centre[0];
        y[i] = corners[2 * i + 1] - centre[1];
        sum[0] += x[i];
        sum[1] += y[i];
        xx += x[i] * x[i];
        yy += y[i] * y[i];
        xy += x[i] * y[i];
    }
    double area = 0.5 * fabs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
    xx += sum[0] * sum[0];
    yy += sum[1] * sum[1];
    xy += sum[0] * sum[1];
    sums[0] += area / 12 * (xx - yy);
    sums[1] += area / 12 * 2 * xy;
    sums[2] += area / 12 * (xx + yy);
}

double oz_long_axis_find(const OzSnapshot *snapshot, int64_t grain, double *strength)
{
    const OzElements *elements = snapshot->grains->elements;
    double sums[3] = {0, 0, 0};
    for (int64_t k = elements->first[grain]; k < elements->first[grain + 1]; k++) {
        int64_t i = oz_elements_at(elements, k);
        double corners[6];
        if (elements->radius[i] > 0) {
            continue;
        }
        oz_elements_corners(elements, i, snapshot->element_position + 2 * i,
                            snapshot->element_angle[i], corners);
        add_triangle(sums, corners, snapshot->position + 3 * grain);
    }
    *strength = sums[2] > 0 ? hypot(sums[0], sums[1]) / sums[2] : 0;
    double angle = 0.5 * atan2(sums[1], sums[0]);
    return angle < 0 ? angle + PI : angle;
}
