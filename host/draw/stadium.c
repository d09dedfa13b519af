/* A line's surroundings cut into rows. */
#include "draw/stadium.h"

#include <math.h>

static double least(double a, double b)
{
    return a < b ? a : b;
}

static double most(double a, double b)
{
    return a > b ? a : b;
}

int oz_stadium_first(double place)
{
    return (int)most(least(place, 1e6), 0); /* rounded down: not negative */
}

int oz_stadium_end(double place, int count)
{
    return (int)least(most(place, -1) + 1, count); /* likewise */
}

typedef struct Span {
    double low, high;
} Span;

/* Where inverse-slope * (x - start) lies within the bounds. */
static void narrow(Span *span, double start, double inverse, double low, double high)
{
    double one = start + low * inverse, other = start + high * inverse;
    span->low = most(span->low, least(one, other));
    span->high = least(span->high, most(one, other));
}

OzStadium oz_stadium_make(const double a[2], const double b[2], double radius)
{
    OzStadium s = {{{a[0], a[1]}, {b[0], b[1]}}, radius, 0, {b[0] - a[0], b[1] - a[1]}, {0, 0}};
    s.length = sqrt(s.along[0] * s.along[0] + s.along[1] * s.along[1]);
    for (int k = 0; k < 2; k++) {
        s.along[k] /= most(s.length, 1e-9);
        double steep = fabs(s.along[k]) < 1e-6 ? 1e-6 : s.along[k];
        s.inverse[k] = 1 / steep;
    }
    return s;
}

static Span span_at(const OzStadium *s, double y)
{
    Span whole = {1e9, -1e9}, middle = {-1e9, 1e9};
    for (int e = 0; e < 2; e++) {
        double away = y - s->ends[e][1], square = s->radius * s->radius - away * away;
        if (square >= 0) {
            double half = sqrt(square);
            whole.low = least(whole.low, s->ends[e][0] - half);
            whole.high = most(whole.high, s->ends[e][0] + half);
        }
    }
    double x = s->ends[0][0], rise = y - s->ends[0][1];
    narrow(&middle, x - s->along[1] * rise * s->inverse[0], s->inverse[0], 0, s->length);
    narrow(&middle, x + s->along[0] * rise * s->inverse[1], -s->inverse[1], -s->radius, s->radius);
    if (middle.low <= middle.high) {
        whole.low = least(whole.low, middle.low);
        whole.high = most(whole.high, middle.high);
    }
    return whole;
}

OzStadiumSpan oz_stadium_rows(const OzStadium *stadium, int row_count)
{
    double low = least(stadium->ends[0][1], stadium->ends[1][1]) - stadium->radius;
    double high = most(stadium->ends[0][1], stadium->ends[1][1]) + stadium->radius;
    return (OzStadiumSpan){oz_stadium_first(low + 0.5), oz_stadium_end(high - 0.5, row_count)};
}

OzStadiumSpan oz_stadium_row(const OzStadium *stadium, int row, int column_count)
{
    Span span = span_at(stadium, row + 0.5);
    return (OzStadiumSpan){oz_stadium_first(span.low + 0.5),
                           oz_stadium_end(span.high - 0.5, column_count)};
}
