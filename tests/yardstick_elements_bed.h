/* The bed of the trigrains yardstick: its elements and beams, 400 grains of four to six triangles
 * above a hopper. */
#ifndef OZ_TESTS_YARDSTICK_ELEMENTS_BED_H
#define OZ_TESTS_YARDSTICK_ELEMENTS_BED_H

#include <math.h>

enum { GRAINS = 400, ELEMENTS = 6 * GRAINS + 16 };

#define PI        3.14159265358979323846
#define STEP      2e-6
#define STIFFNESS 2e6
#define BEAM_E    100.0
#define BEAM_EI   (100.0 * 1e-10)
#define DAMPING   9e-3
#define DAMPING_I (9e-3 * 1e-10)
#define DENSITY   4.0
#define GRAVITY   9.81

typedef struct Vec {
    double x, y;
} Vec;

typedef struct Element {
    Vec body[3], corner[3], at, velocity, noted;
    double q[3][5]; /* x, y, angle: values times step^n / n! */
    double mass, inertia, reach, angle, spin, force[3];
    int grain;
} Element;

typedef struct Beam {
    int a, b;
    double length, rest_a, rest_b;
} Beam;

static Element elements[ELEMENTS];
static Beam beams[ELEMENTS];
static int count, free_count, beam_count;

static Vec minus(Vec a, Vec b)
{
    return (Vec){a.x - b.x, a.y - b.y};
}

static double cross(Vec a, Vec b)
{
    return a.x * b.y - a.y * b.x;
}

static double random_between(double low, double high)
{
    static unsigned long long state = 1;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

static Element *add_triangle(Vec a, Vec b, Vec c, int grain, double density)
{
    Element *p = &elements[count++];
    double area = 0.5 * cross(minus(b, a), minus(c, a)), sum = 0;
    Vec corners[3] = {a, area > 0 ? b : c, area > 0 ? c : b};
    p->at = (Vec){(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
    p->grain = grain;
    for (int k = 0; k < 3; k++) {
        p->corner[k] = corners[k];
        p->body[k] = minus(corners[k], p->at);
        double r2 = p->body[k].x * p->body[k].x + p->body[k].y * p->body[k].y;
        p->reach = fmax(p->reach, sqrt(r2));
        sum += r2;
    }
    p->mass = density * fabs(area);
    p->inertia = p->mass * sum / 12;
    p->q[0][0] = p->at.x;
    p->q[1][0] = p->at.y;
    return p;
}

static void add_beam(int a, int b)
{
    Vec apart = minus(elements[b].at, elements[a].at);
    double direction = atan2(apart.y, apart.x);
    beams[beam_count++] = (Beam){a, b, hypot(apart.x, apart.y), -direction, -direction};
}

static void add_grain(Vec at, int grain)
{
    int corners = 4 + grain % 3, first = count;
    double radius = random_between(1.2e-3, 2e-3), turn = random_between(0, 2 * PI);
    Vec corner[6];
    for (int k = 0; k < corners; k++) {
        double angle = turn + 2 * PI * (k + random_between(-0.1, 0.1)) / corners;
        corner[k] = (Vec){at.x + radius * cos(angle), at.y + radius * sin(angle)};
    }
    for (int k = 0; k < corners; k++) {
        add_triangle(at, corner[k], corner[(k + 1) % corners], grain, DENSITY);
    }
    for (int k = 0; k < corners; k++) {
        int one = first + k, other = first + (k + 1) % corners;
        add_beam(one < other ? one : other, one < other ? other : one);
    }
}

/* A hopper 60 mm wide with slopes of 50 degrees and an outlet of 12 mm, 13 grains to a row above.
 */
static void build(void)
{
    for (int i = 0; i < GRAINS; i++) {
        add_grain((Vec){-26e-3 + 4.3e-3 * (i % 13), 33e-3 + 4.3e-3 * (double)(i / 13)}, i);
    }
    free_count = count;
    for (int side = -1; side <= 1; side += 2) {
        double out = 24e-3 * tan(50 * PI / 180), s = side;
        Vec low = {s * 6e-3, 0}, high = {s * 30e-3, out}, under = {s * 26e-3, -4e-3};
        Vec top = {s * 30e-3, 0.25}, back = {s * 60e-3, out};
        add_triangle(low, high, under, -1, 0);
        add_triangle(high, top, back, -1, 0);
    }
}

#endif
