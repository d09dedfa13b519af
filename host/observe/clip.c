/* A spherocylinder cut by a level plane: a tilted cylinder and two tilted hemispheres, each
 * integrated once by hand. Knows one grain at a time and nothing of beds. Inside the functions: r
 * the radius, c and s cosine and sine of the angle between the axis and the vertical, z heights
 * from the centre of the part at hand; c >= 0 because a spherocylinder looks the same from both
 * ends. */
#include "observe/clip.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* Area of the unit disc's part below the line y = t. */
static double segment(double t)
{
    t = clamp(t, -1, 1);
    return PI - acos(t) + t * sqrt(1 - t * t);
}

/* Integral of segment() from -infinity to t. */
static double segment_integral(double t)
{
    if (t <= -1) {
        return 0;
    }
    if (t >= 1) {
        return PI * t;
    }
    double w = sqrt(1 - t * t);
    return PI * t - t * acos(t) + w - w * w * w / 3;
}

/* Each slice across the axis is a disc cut at t = (z - position c) / (r s); t is linear along the
 * axis, so the volume is a difference of integrals over t. */
static double cylinder_below(double r, double length, double c, double s, double z)
{
    double span = length * c / (r * s);
    double middle = z / (r * s);
    /* A shorter span loses more to cancellation than its middle value is wrong (both about 1e-11).
     */
    if (span < 1e-5) {
        return length * r * r * segment(middle);
    }
    double difference = segment_integral(middle + span / 2) - segment_integral(middle - span / 2);
    return length * r * r * difference / span;
}

static double ball_below(double r, double z)
{
    z = clamp(z, -r, r);
    return PI * (r * r * z - z * z * z / 3 + 2 * r * r * r / 3);
}

/* The hemisphere whose flat side faces downwards along the axis. Its level slices are segments of
 * discs; w is half the chord's length. The antiderivative vanishes at the lowest point. Both atan2
 * take the same branch when w = 0, which keeps upright and flat axes exact. */
static double upper_hemisphere_below(double r, double c, double s, double z)
{
    z = clamp(z, -r, r);
    double square = r * r - z * z / (s * s);
    double w = square > 0 ? sqrt(square) : 0;
    double disc = (r * r * z - z * z * z / 3) * atan2(s * w, -z * c);
    return disc + c * s * w * (r * r - w * w) / 3 + 2 * r * r * r / 3 * atan2(s * w, r * c);
}

double oz_clip_below(double diameter, double length, double axis_z, double height)
{
    double r = diameter / 2;
    if (length == 0) {
        return ball_below(r, height);
    }
    double c = clamp(fabs(axis_z), 0, 1);
    double s = fmax(sqrt((1 - c) * (1 + c)), 1e-12); /* never 0: an upright rod divides by it */
    double rise = length / 2 * c;
    double lower = height + rise; /* the plane seen from the lower cap's centre */
    if (lower <= -r || height - rise >= r) {
        return lower <= -r ? 0 : PI * r * r * length + ball_below(r, r);
    }
    return cylinder_below(r, length, c, s, height) +
           upper_hemisphere_below(r, c, s, height - rise) + ball_below(r, lower) -
           upper_hemisphere_below(r, c, s, lower);
}
