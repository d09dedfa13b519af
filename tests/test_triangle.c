/* Overlaps of two triangles: areas against a polygon clipping of another kind, the kinds built by
 * hand, push and moment, what is conserved and what is not, and which kinds pass into each other
 * without a jump. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OZ_HOST
static int at_midpoint;
#define OZ_FORCE_POINT at_midpoint
#include "kernels/triangle.h"

#include "base/random.h"

enum { KINDS = 7 };

static OzTriangle triangle(double ax, double ay, double bx, double by, double cx, double cy)
{
    OzTriangle t = {{{ax, ay}, {bx, by}, {cx, cy}}};
    return t;
}

static OzTriangle moved(OzTriangle t, double x, double y, double turn)
{
    OzTriangle out;
    for (int c = 0; c < 3; c++) {
        OzVec2 p = t.corner[c];
        out.corner[c] =
            oz_vec2(x + cos(turn) * p.x - sin(turn) * p.y, y + sin(turn) * p.x + cos(turn) * p.y);
    }
    return out;
}

static OzRandom drawn;

static double uniform(double low, double high)
{
    return oz_random_uniform(&drawn, low, high);
}

/* A counter-clockwise triangle of about unit size, no sliver. */
static OzTriangle some_triangle(void)
{
    OzTriangle t;
    do {
        t = triangle(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1),
                     uniform(-1, 1));
    } while (oz_triangle_area(&t) < 0.05);
    return t;
}

/* Cuts a polygon by the line of one edge, corner by corner (Sutherland and Hodgman 1974). */
static int cut_polygon(const OzVec2 *in, int count, OzVec2 p, OzVec2 q, OzVec2 *out)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        OzVec2 a = in[i], b = in[(i + 1) % count];
        double side_a = (q.x - p.x) * (a.y - p.y) - (q.y - p.y) * (a.x - p.x);
        double side_b = (q.x - p.x) * (b.y - p.y) - (q.y - p.y) * (b.x - p.x);
        if (side_a >= 0) {
            out[kept++] = a;
        }
        if (side_a * side_b < 0) {
            double at = side_a / (side_a - side_b);
            out[kept++] = oz_vec2(a.x + at * (b.x - a.x), a.y + at * (b.y - a.y));
        }
    }
    return kept;
}

static double clipped_area(const OzTriangle *a, const OzTriangle *b, OzVec2 *centroid)
{
    OzVec2 now[16], next[16];
    int count = 3;
    double area = 0;
    memcpy(now, a->corner, sizeof a->corner);
    for (int k = 0; k < 3; k++) {
        count = cut_polygon(now, count, b->corner[k], b->corner[(k + 1) % 3], next);
        memcpy(now, next, (size_t)count * sizeof *now);
    }
    *centroid = oz_vec2(0, 0);
    for (int i = 1; i + 1 < count; i++) {
        double part = 0.5 * oz_cross2(oz_minus2(now[i], now[0]), oz_minus2(now[i + 1], now[0]));
        area += part;
        centroid->x += part * (now[0].x + now[i].x + now[i + 1].x) / 3;
        centroid->y += part * (now[0].y + now[i].y + now[i + 1].y) / 3;
    }
    *centroid = oz_scale2(*centroid, area > 0 ? 1 / area : 0);
    return area;
}

static double distance(OzVec2 a, OzVec2 b)
{
    return oz_length2(oz_minus2(a, b));
}

/* Rounding alone separates two ways to clip. */
static void test_areas(void **state)
{
    (void)state;
    int seen[KINDS] = {0};
    OzVec2 centroid;
    at_midpoint = 0;
    drawn = oz_random_stream(1, 1);
    for (int i = 0; i < 200000; i++) {
        OzTriangle a = some_triangle(), b = some_triangle();
        OzOverlap o = oz_triangle_overlap(&a, &b), back = oz_triangle_overlap(&b, &a);
        double area = clipped_area(&a, &b, &centroid);
        /* last digits of numbers of order one; of the push, of chords of 1e-4 and longer */
        assert_true(fabs(o.area - area) < 1e-14);
        assert_true(fabs(o.moment - oz_cross2(centroid, o.push)) < 1e-14);
        assert_true(distance(o.push, oz_scale2(back.push, -1)) < 1e-12);
        /* a third moment: a sum of some tens of products; a push is no longer than the area */
        assert_true(fabs(o.energy - back.energy) < 1e-13);
        assert_true(o.kind == back.kind && o.deep == back.deep);
        assert_true(oz_length2(o.push) <= o.area * (1 + 1e-12));
        assert_true(o.energy >= 0);
        assert_true(o.kind > 0 || o.swallowed || area == 0);
        seen[(int)o.kind]++;
    }
    for (int k = 0; k < KINDS; k++) {
        assert_true(seen[k] > 0);
    }
}

/* The moment about another origin differs by the push's own there, wherever the force acts. */
static void test_moment_moves_with_the_origin(void **state)
{
    (void)state;
    int seen[KINDS] = {0};
    drawn = oz_random_stream(1, 5);
    for (int i = 0; i < 40000; i++) {
        OzTriangle a = some_triangle(), b = some_triangle();
        at_midpoint = i % 2;
        OzOverlap here = oz_triangle_overlap(&a, &b);
        a = moved(a, 0.7, -0.4, 0);
        b = moved(b, 0.7, -0.4, 0);
        OzOverlap there = oz_triangle_overlap(&a, &b);
        double expected = here.moment + oz_cross2(oz_vec2(0.7, -0.4), here.push);
        /* short chords have fewer digits of their direction, as above */
        assert_true(here.kind != there.kind || fabs(there.moment - expected) < 1e-9);
        seen[(int)here.kind]++;
    }
    for (int k = 0; k < KINDS; k++) {
        assert_true(seen[k] > 0);
    }
    at_midpoint = 0;
}

/* Pairs that the cheap test throws out are farther apart than its margin. */
static void test_near(void **state)
{
    (void)state;
    int far = 0;
    drawn = oz_random_stream(1, 2);
    for (int i = 0; i < 20000; i++) {
        OzTriangle a = some_triangle(), b = some_triangle();
        double angle = uniform(0, 6.3), margin = uniform(0, 0.3);
        b = moved(b, uniform(-2, 2), uniform(-2, 2), angle);
        if (!oz_triangle_near(&a, &b, margin)) {
            OzTriangle closer = moved(b, margin * cos(7 * angle), margin * sin(7 * angle), 0);
            assert_true(oz_triangle_overlap(&a, &closer).area == 0);
            far++;
        }
    }
    assert_in_range(far, 2000, 18000);
}

static const OzTriangle wide = {{{-2, -2}, {2, -2}, {0, 2}}};

static double kind_of(OzTriangle a, OzTriangle b)
{
    OzOverlap o = oz_triangle_overlap(&a, &b);
    return o.kind;
}

static void test_kinds(void **state)
{
    (void)state;
    OzTriangle tip = triangle(0, -1.9, -0.3, -3, 0.3, -3);
    assert_true(kind_of(wide, tip) == 1);
    assert_true(kind_of(tip, wide) == 1);
    /* near the corner (2, -2), each corner inside the other */
    assert_true(kind_of(wide, triangle(1.5, -1.9, 3, -3, 3, -1)) == 2);
    /* a needle across the upper corner, its tip beyond */
    assert_true(kind_of(wide, triangle(2, 1, -2, 1.1, -2, 0.9)) == 3);
    /* two corners in through the floor, one of them out of the right side */
    assert_true(kind_of(wide, triangle(0, -3, 1.7, -1, 0, -1)) == 4);
    assert_true(kind_of(wide, triangle(-2, 0.7, 0, -3.3, 2, 0.7)) == 5);
    /* each cut on all three edges: a blade along the side, tip beyond it, the corner (2, -2) out */
    assert_true(kind_of(wide, triangle(-1.16, 1.4, 1.21, -1.7, 2.52, -2.2)) == 6);
    assert_true(kind_of(wide, triangle(0, -3, 0, -4, 1, -4)) == 0);
}

/* The tip stands h deep in the floor; its width there is w: area h w / 2, push down on the tip. */
static void test_push(void **state)
{
    (void)state;
    double h = 0.1, w = 0.1 * 2 * 0.3 / 1.1, area = h * w / 2;
    OzTriangle tip = triangle(0, -1.9, -0.3, -3, 0.3, -3);
    OzTriangle aside = moved(tip, 0.5, 0, 0);
    for (at_midpoint = 0; at_midpoint < 2; at_midpoint++) {
        /* coordinates of 3 have 4e-16 as last digit, the chord is 0.05 wide: 2e-17 */
        OzOverlap o = oz_triangle_overlap(&wide, &aside);
        assert_true(fabs(o.area - area) < 1e-16);
        assert_true(fabs(o.push.x) < 1e-16 && fabs(o.push.y + area) < 1e-16);
        assert_true(fabs(o.moment + 0.5 * area) < 1e-16); /* all of them */
        assert_true(fabs(o.energy - area * h / 3) < 1e-16);
        /* lying slanted, the middle of the chord is not above the centroid */
        OzTriangle slanted = triangle(0, -1.9, 0, -3, 1, -3);
        o = oz_triangle_overlap(&wide, &slanted);
        double width = 0.1 / 1.1, along = at_midpoint ? width / 2 : width / 3;
        assert_true(fabs(o.moment + along * width * h / 2) < 1e-16); /* 2e-17 again */
    }
    at_midpoint = 0;
}

/* Energy of b at a place and turn against a resting a. */
static double energy_at(const OzTriangle *a, const OzTriangle *b, double x, double y, double turn)
{
    OzTriangle there = moved(*b, x, y, turn);
    return oz_triangle_overlap(a, &there).energy;
}

/* Central differences of a function that is smooth within a kind: with a step of 1e-5 the third
 * derivative leaves 1e-10, rounding 1e-11. */
static void test_gradient(void **state)
{
    (void)state;
    const double h = 1e-5;
    int tried = 0;
    drawn = oz_random_stream(1, 3);
    at_midpoint = 0;
    while (tried < 2000) {
        OzTriangle a = some_triangle(), b = some_triangle();
        OzOverlap o = oz_triangle_overlap(&a, &b);
        double far = 0;
        for (int i = 0; i < 8; i++) {
            OzTriangle near =
                moved(b, i & 1 ? 3 * h : -3 * h, i & 2 ? 3 * h : -3 * h, i & 4 ? 3 * h : -3 * h);
            far += kind_of(a, near) != 1;
        }
        if (o.kind != 1 || far > 0) {
            continue;
        }
        double x = (energy_at(&a, &b, h, 0, 0) - energy_at(&a, &b, -h, 0, 0)) / (2 * h);
        double y = (energy_at(&a, &b, 0, h, 0) - energy_at(&a, &b, 0, -h, 0)) / (2 * h);
        double turn = (energy_at(&a, &b, 0, 0, h) - energy_at(&a, &b, 0, 0, -h)) / (2 * h);
        /* third derivatives grow as edges become parallel: 7e-10 at the worst */
        assert_true(fabs(o.push.x + x) < 2e-9);
        assert_true(fabs(o.push.y + y) < 2e-9);
        assert_true(fabs(o.moment + turn) < 2e-9);
        tried++;
    }
}

/* Net work on a triangle pressed in, turned, drawn out and turned back, over the stored energy; by
 * Simpson's rule. */
static double loop_work(int steps, double *stored)
{
    const double path[5][2] = {{-2.2, -0.2}, {-1.9, -0.2}, {-1.9, 0.6}, {-2.2, 0.6}, {-2.2, -0.2}};
    OzTriangle tip = triangle(0, 0, -0.5, -1, 0.3, -1.2);
    double work = 0;
    *stored = 0;
    for (int leg = 0; leg < 4; leg++) {
        double rise = path[leg + 1][0] - path[leg][0], turn = path[leg + 1][1] - path[leg][1];
        for (int i = 0; i <= 2 * steps; i++) {
            double s = (double)i / (2 * steps);
            double y = path[leg][0] + s * rise, angle = path[leg][1] + s * turn;
            OzTriangle b = moved(tip, 0.3, y, angle);
            OzOverlap o = oz_triangle_overlap(&wide, &b);
            double torque = o.moment - oz_cross2(oz_vec2(0.3, y), o.push);
            double weight = (i == 0 || i == 2 * steps ? 1 : (i % 2 ? 4 : 2)) / (6.0 * steps);
            work += weight * (o.push.y * rise + torque * turn);
            *stored = fmax(*stored, o.energy);
            assert_true(o.kind <= 1);
        }
    }
    return work / *stored;
}

/* Simpson's error at first touch, where the force's second derivative jumps: 1e-11. */
static void test_loop(void **state)
{
    (void)state;
    double stored;
    at_midpoint = 0;
    double centroid = loop_work(2000, &stored);
    at_midpoint = 1;
    double midpoint = loop_work(2000, &stored);
    at_midpoint = 0;
    print_message("net work of a closed loop over the stored energy: centroid %.1e, midpoint "
                  "%.3f\n",
                  centroid, midpoint);
    assert_true(fabs(centroid) < 1e-10);
    assert_true(fabs(midpoint) > 0.05); /* the paper's point loses some hundredths */
}

static void test_deep_and_swallowed(void **state)
{
    (void)state;
    OzTriangle small = triangle(-0.2, -0.2, 0.2, -0.2, 0, 0.2);
    OzOverlap o = oz_triangle_overlap(&wide, &small);
    assert_true(o.swallowed && !o.deep && o.kind == 0);
    assert_true(o.push.x == 0 && o.push.y == 0 && o.energy == 0);
    o = oz_triangle_overlap(&small, &wide);
    assert_true(o.swallowed);
    for (double y = -2.19; y < -1.81; y += 0.01) {
        /* of its height of 0.4 the upper part is in: a tip of the same shape */
        OzTriangle b = moved(small, 0, y, 0);
        int expected = pow((y + 2.2) / 0.4, 2) > 0.5;
        o = oz_triangle_overlap(&wide, &b);
        assert_int_equal(o.deep, expected);
        assert_false(o.swallowed);
    }
}

/* Just touching: edges that coincide wholly or in part, a corner on an edge or a corner. */
static void test_touching(void **state)
{
    (void)state;
    const OzTriangle others[] = {
        {{{-2, -2}, {0, -5}, {2, -2}}},  {{{-1, -2}, {0, -5}, {1, -2}}},
        {{{0, -2}, {1, -5}, {3, -2}}},   {{{0.3, -2}, {-1, -5}, {2, -4}}},
        {{{2, -2}, {2.5, -4}, {3, -1}}},
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        for (int k = -4; k <= 4; k++) {
            OzTriangle a = moved(wide, 0.1, 0.7, 0.3 * k), b = moved(others[i], 0.1, 0.7, 0.3 * k);
            OzOverlap o = oz_triangle_overlap(&a, &b);
            /* coordinates up to 5 are turned: 1e-15 in height, over edges up to 4 long */
            assert_true(o.area < 1e-14 && oz_length2(o.push) < 1e-14 && fabs(o.energy) < 1e-14);
            assert_false(o.swallowed || o.deep);
        }
    }
}

/* One change of kind of b's contact with a. */
typedef struct Change {
    int low, high; /* kinds, the lower first; low < 0: between a swallowed triangle and another */
    double jump;   /* length of the jump of the push, over the area                            */
} Change;

/* The first change of kind between two places of b on its way. */
static Change find_change(const OzTriangle *a, const OzTriangle *b, OzVec2 way, double low,
                          double high)
{
    OzTriangle before = moved(*b, low * way.x, low * way.y, 0);
    double first = kind_of(*a, before);
    for (int i = 0; i < 45; i++) {
        double middle = 0.5 * (low + high);
        double kind = kind_of(*a, moved(*b, middle * way.x, middle * way.y, 0));
        low = kind == first ? middle : low;
        high = kind == first ? high : middle;
    }
    before = moved(*b, low * way.x, low * way.y, 0);
    OzTriangle after = moved(*b, high * way.x, high * way.y, 0);
    OzOverlap o = oz_triangle_overlap(a, &before), p = oz_triangle_overlap(a, &after);
    Change change = {(int)fmin(o.kind, p.kind), (int)fmax(o.kind, p.kind),
                     distance(o.push, p.push) / fmax(fmax(o.area, p.area), 1e-9)};
    if (o.swallowed || p.swallowed) {
        change.low = -1;
    }
    return change;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* None but rounding's for the changes that a resting or sliding grain meets; others are said. */
static void check_jumps(int low, int high, int count, double *jumps)
{
    qsort(jumps, (size_t)count, sizeof(double), ascending);
    print_message("kinds %d-%d: %d changes, jump over area: median %.2g, 90%% %.2g\n", low, high,
                  count, jumps[count / 2], jumps[count * 9 / 10]);
    if (low == 0 || (low == 1 && high != 3)) {
        /* the bisection ends 1e-16 from the change; chords and areas are small there: 2e-13 */
        assert_true(jumps[count * 99 / 100] < 1e-10);
    } else if (high < 5 && low < 3) {
        /* medians of some thousands: 0.43 and 0.46, a few hundredths for the sample */
        assert_true(jumps[count / 2] > 0.38 && jumps[count / 2] < 0.5);
    }
}

enum { JUMPS = 4000 };

static double jumps[KINDS][KINDS][JUMPS];
static int counts[KINDS][KINDS];

static void note_change(const Change *change)
{
    int low = change->low, high = change->high;
    if (low >= 0 && counts[low][high] < JUMPS) {
        jumps[low][high][counts[low][high]++] = change->jump;
    }
}

/* The jumps at each change of kind, over random pairs and ways. */
static void test_continuity(void **state)
{
    (void)state;
    drawn = oz_random_stream(1, 4);
    for (int i = 0; i < 60000; i++) {
        OzTriangle a = some_triangle(), b = some_triangle();
        double angle = uniform(0, 6.3), last = 0, step = 0.005;
        OzVec2 way = {cos(angle), sin(angle)};
        b = moved(b, -1.2 * way.x, -1.2 * way.y, 0);
        last = kind_of(a, b);
        for (double s = step; s < 0.3; s += step) {
            double kind = kind_of(a, moved(b, s * way.x, s * way.y, 0));
            if (kind != last) {
                Change change = find_change(&a, &b, way, s - step, s);
                note_change(&change);
            }
            last = kind;
        }
    }
    for (int low = 0; low < KINDS; low++) {
        for (int high = low + 1; high < KINDS; high++) {
            int count = counts[low][high];
            if (count > 20) {
                check_jumps(low, high, count, jumps[low][high]);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_areas),    cmocka_unit_test(test_moment_moves_with_the_origin),
        cmocka_unit_test(test_near),     cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_push),     cmocka_unit_test(test_gradient),
        cmocka_unit_test(test_loop),     cmocka_unit_test(test_deep_and_swallowed),
        cmocka_unit_test(test_touching), cmocka_unit_test(test_continuity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
