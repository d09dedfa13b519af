/* The exponent by search, constant and factor by linear regression at each. The sum of squares may
 * have several valleys: a grid finds the deepest, golden sections its bottom. */
#include "observe/power_fit.h"

#include "base/student.h"

#include <math.h>

enum { GRID = 400, SECTIONS = 60 };

typedef struct Points {
    const double *x, *y;
    double scale; /* the greatest x: powers stay within 0 to 1 */
    int count;
} Points;

/* Sum of squares at an exponent; fills constant and factor (of x over scale) of fit. */
static double regress(const Points *points, double exponent, OzPowerFit *fit)
{
    double mean_u = 0, mean_y = 0, uu = 0, uy = 0, sum = 0;
    int n = points->count;
    for (int i = 0; i < n; i++) {
        mean_u += pow(points->x[i] / points->scale, exponent) / n;
        mean_y += points->y[i] / n;
    }
    for (int i = 0; i < n; i++) {
        double u = pow(points->x[i] / points->scale, exponent) - mean_u;
        uu += u * u;
        uy += u * (points->y[i] - mean_y);
    }
    fit->exponent = exponent;
    fit->factor = uy / uu;
    fit->constant = mean_y - fit->factor * mean_u;
    for (int i = 0; i < n; i++) {
        double u = pow(points->x[i] / points->scale, exponent);
        double distance = points->y[i] - fit->constant - fit->factor * u;
        sum += distance * distance;
    }
    return sum;
}

static double grid_exponent(int k)
{
    return OZ_POWER_FIT_LOW * pow(OZ_POWER_FIT_HIGH / OZ_POWER_FIT_LOW, (double)k / GRID);
}

/* Least sum of squares between two exponents, by golden sections. */
static double descend(const Points *points, double low, double high, OzPowerFit *fit)
{
    const double golden = 0.5 * (sqrt(5) - 1);
    for (int i = 0; i < SECTIONS; i++) {
        double left = high - golden * (high - low), right = low + golden * (high - low);
        if (regress(points, left, fit) < regress(points, right, fit)) {
            high = right;
        } else {
            low = left;
        }
    }
    return regress(points, 0.5 * (low + high), fit);
}

/* The outermost exponents of the grid whose sum of squares is within limit, in between the best. */
static void find_range(const Points *points, double limit, OzPowerFit *fit)
{
    OzPowerFit other;
    fit->exponent_low = fit->exponent_high = fit->exponent;
    for (int k = 0; k <= GRID; k++) {
        double exponent = grid_exponent(k);
        if (regress(points, exponent, &other) <= limit) {
            fit->exponent_low = fmin(fit->exponent_low, exponent);
            fit->exponent_high = fmax(fit->exponent_high, exponent);
            fit->open |= k == 0 || k == GRID;
        }
    }
}

static int count_different(const double *x, int count)
{
    int different = 0;
    for (int i = 0; i < count; i++) {
        bool again = false;
        for (int k = 0; k < i; k++) {
            again |= x[k] == x[i];
        }
        different += !again;
    }
    return different;
}

bool oz_power_fit_find(OzPowerFit *fit, const double *x, const double *y, int count)
{
    Points points = {x, y, 0, count};
    OzPowerFit found = {0};
    double least = INFINITY;
    int best = 0;
    if (count_different(x, count) < OZ_POWER_FIT_POINTS) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        points.scale = fmax(points.scale, x[i]);
    }
    for (int k = 0; k <= GRID; k++) {
        double sum = regress(&points, grid_exponent(k), &found);
        best = sum < least ? k : best;
        least = fmin(least, sum);
    }
    least = descend(&points, grid_exponent(best > 0 ? best - 1 : 0),
                    grid_exponent(best < GRID ? best + 1 : GRID), &found);
    double t = oz_student_limit(count - 3);
    find_range(&points, least * (1 + t * t / (count - 3)), &found);
    found.factor /= pow(points.scale, found.exponent);
    found.residual = sqrt(least / count);
    *fit = found;
    return true;
}
