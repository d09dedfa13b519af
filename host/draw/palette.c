/* Colour maps and the colour of one grain. Knows no GL. */
#include "draw/palette.h"

#include "draw/long_axis.h"
#include "scene/mixing.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
static const float GREY[3] = {0.68f, 0.70f, 0.72f};

static void mix(const float from[3], const float to[3], double share, float rgb[3])
{
    for (int i = 0; i < 3; i++) {
        rgb[i] = (float)(from[i] + (to[i] - from[i]) * share);
    }
}

void oz_palette_viridis(double x, float rgb[3])
{
    /* Nine knots lie close enough that straight lines between them cannot be told from the curve.
     */
    static const float knots[9][3] = {
        {0.267f, 0.005f, 0.329f}, {0.278f, 0.176f, 0.482f}, {0.230f, 0.322f, 0.545f},
        {0.173f, 0.449f, 0.558f}, {0.128f, 0.567f, 0.551f}, {0.158f, 0.683f, 0.502f},
        {0.369f, 0.789f, 0.383f}, {0.678f, 0.864f, 0.190f}, {0.993f, 0.906f, 0.144f}};
    double place = 8 * fmin(fmax(x, 0), 1);
    int knot = place < 8 ? (int)place : 7;
    mix(knots[knot], knots[knot + 1], place - knot, rgb);
}

static float srgb_curve(double linear)
{
    double x = fmin(fmax(linear, 0), 1);
    return (float)(x < 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

/* A circle of equal lightness and chroma in Oklab (Ottosson 2020), as wide as sRGB holds. */
void oz_palette_cyclic(double x, float rgb[3])
{
    const double lightness = 0.72, chroma = 0.125;
    double a = chroma * cos(2 * PI * x), b = chroma * sin(2 * PI * x);
    double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    rgb[0] = srgb_curve(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s);
    rgb[1] = srgb_curve(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s);
    rgb[2] = srgb_curve(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}

void oz_palette_type(int row, float rgb[3])
{
    static const float colours[8][3] = {
        {0.20f, 0.52f, 0.70f}, {0.94f, 0.58f, 0.20f}, {0.40f, 0.66f, 0.36f}, {0.80f, 0.34f, 0.38f},
        {0.56f, 0.44f, 0.72f}, {0.88f, 0.78f, 0.30f}, {0.36f, 0.74f, 0.74f}, {0.84f, 0.56f, 0.70f}};
    mix(colours[row & 7], colours[row & 7], 0, rgb);
}

/* How far a flat grain has turned since the start, 0..1 for a whole turn. */
static double turn_share(const OzSnapshot *snapshot, int64_t i)
{
    const double *q = &snapshot->quaternion[4 * i];
    return atan2(q[3], q[0]) / PI;
}

static void angle_colour(const double axis[3], float rgb[3])
{
    double up = fmin(fabs(axis[2]), 1);
    oz_palette_viridis(asin(up) / (0.5 * PI), rgb);
}

/* A rod has no head, so the colour turns twice as fast as the rod; upright, it fades to grey. */
static void azimuth_colour(const double axis[3], float rgb[3])
{
    double lying = hypot(axis[0], axis[1]);
    float hue[3];
    oz_palette_cyclic(atan2(axis[1], axis[0]) / PI, hue);
    mix(GREY, hue, fmin(4 * lying, 1), rgb);
}

/* A long axis has no head either; a grain without one is grey. */
static void long_axis_colour(const OzSnapshot *snapshot, int64_t i, float rgb[3])
{
    const double clear = 0.05; /* of a grain a twentieth longer than wide: full colour from here */
    double strength = 0, angle = oz_long_axis_find(snapshot, i, &strength);
    float hue[3];
    oz_palette_cyclic(angle / PI, hue);
    mix(GREY, hue, fmin(strength / clear, 1), rgb);
}

void oz_palette_grey(double x, float rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = (float)(0.15 + 0.75 * fmin(fmax(x, 0), 1));
}

bool oz_palette_is_by_type(const OzLook *look)
{
    return look->colour == OZ_COLOUR_TYPE || look->colour == OZ_COLOUR_MATERIAL;
}

void oz_palette_grain(const OzSnapshot *snapshot, const OzLook *look, const double *share,
                      int64_t i, float rgb[3])
{
    const double *axis = &snapshot->axis[3 * i], *v = &snapshot->velocity[3 * i];
    bool sphere = !(snapshot->grains->length[i] > 0);
    double speed = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / fmax(look->speed_high, 1e-300);
    switch (look->colour) {
    case OZ_COLOUR_SPEED:
        oz_palette_viridis(speed, rgb);
        return;
    case OZ_COLOUR_GREY:
        oz_palette_grey(speed, rgb);
        return;
    case OZ_COLOUR_TYPE:
        oz_palette_type(snapshot->grains->population[i], rgb);
        return;
    case OZ_COLOUR_MATERIAL:
        oz_palette_type(oz_mixing_kind(snapshot->scene, snapshot->grains->population[i]), rgb);
        return;
    case OZ_COLOUR_TURNED:
        oz_palette_cyclic(turn_share(snapshot, i), rgb);
        return;
    case OZ_COLOUR_FORCE:
    case OZ_COLOUR_COORDINATION:
        oz_palette_viridis(share[i], rgb);
        return;
    case OZ_COLOUR_ANGLE:
    case OZ_COLOUR_AZIMUTH:
    case OZ_COLOUR_ORDER:
        break;
    }
    if (look->flat) {
        long_axis_colour(snapshot, i, rgb);
    } else if (sphere) {
        mix(GREY, GREY, 0, rgb);
    } else if (look->colour == OZ_COLOUR_ORDER) {
        oz_palette_viridis(share[i], rgb);
    } else if (look->colour == OZ_COLOUR_ANGLE) {
        angle_colour(axis, rgb);
    } else {
        azimuth_colour(axis, rgb);
    }
}

double oz_palette_round_up(double x)
{
    double power = pow(10, floor(log10(x)));
    double steps[] = {1, 2, 5, 10};
    for (int i = 0; i < 3; i++) {
        if (x <= steps[i] * power * (1 + 1e-9)) {
            return steps[i] * power;
        }
    }
    return 10 * power;
}
