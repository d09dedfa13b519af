/* The potential of two triangles that overlap, and its gradient: against integrals by quadrature,
 * differences, closed forms, and what the other contact loses in a closed loop. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdbool.h>

#define OZ_HOST
#define OZ_FORCE_POINT 0
#include "kernels/triangle_field.h"

#include "base/random.h"

static OzRandom drawn;

static double uniform(double low, double high)
{
    return oz_random_uniform(&drawn, low, high);
}

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

/* Two triangles, and which edges of theirs are outer ones, as bits. */
typedef struct Pair {
    OzTriangle a, b;
    int outer_a, outer_b, wall;
} Pair;

static OzFieldPair field_of(const Pair *p)
{
    OzFieldPair pair;
    for (int k = 0; k < 3; k++) {
        pair.outer_a[k] = p->outer_a >> k & 1;
        pair.outer_b[k] = p->outer_b >> k & 1;
    }
    oz_field_weigh(&pair, p->wall);
    return pair;
}

static OzOverlap overlap_of(const Pair *p)
{
    OzFieldPair field = field_of(p);
    return oz_field_overlap(&p->a, &p->b, &field);
}

static double energy_of(const Pair *p)
{
    OzFieldPair field = field_of(p);
    return oz_field_energy(&p->a, &p->b, &field);
}

static double energy_at(const Pair *p, double x, double y, double turn)
{
    Pair there = *p;
    there.b = moved(p->b, x, y, turn);
    return energy_of(&there);
}

static Pair some_pair(void)
{
    Pair p = {some_triangle(), some_triangle(), (int)uniform(0, 8), (int)uniform(0, 8),
              uniform(0, 1) < 0.3};
    return p;
}

/* The depth at a point inside a triangle: its distance from the nearest outer edge; without one,
 * the inradius, twice the area over the circumference. */
static double depth_at(const OzTriangle *t, int outer, OzVec2 x)
{
    double least = INFINITY, around = 0;
    for (int k = 0; k < 3; k++) {
        double length = oz_length2(oz_minus2(t->corner[(k + 1) % 3], t->corner[k]));
        around += length;
        least = outer >> k & 1 ? fmin(least, oz_triangle_side(t, k, x) / length) : least;
    }
    return outer ? least : 2 * oz_triangle_area(t) / around;
}

static int is_inside(const OzTriangle *t, OzVec2 x)
{
    return oz_triangle_side(t, 0, x) >= 0 && oz_triangle_side(t, 1, x) >= 0 &&
           oz_triangle_side(t, 2, x) >= 0;
}

/* The potential as a sum over points of a grid, which is fine enough for a thousandth of the
 * largest, 0.1. */
static void test_energy_is_the_integral_of_depth(void **state)
{
    (void)state;
    enum { FINE = 400 };
    double worst = 0, largest = 0;
    drawn = oz_random_stream(2, 1);
    for (int i = 0; i < 60; i++) {
        Pair p = some_pair();
        double sum = 0, cell = 2.0 / FINE, own = p.wall ? 1 : 0.5, other = p.wall ? 0 : 0.5;
        for (int k = 0; k < FINE * FINE; k++) {
            OzVec2 x = oz_vec2(-1 + cell * (k % FINE + 0.5), -1 + cell * (k / FINE + 0.5));
            if (is_inside(&p.a, x) && is_inside(&p.b, x)) {
                sum += own * depth_at(&p.a, p.outer_a, x) + other * depth_at(&p.b, p.outer_b, x);
            }
        }
        double energy = energy_of(&p);
        worst = fmax(worst, fabs(sum * cell * cell - energy));
        largest = fmax(largest, energy);
    }
    print_message("largest energy %.3g, largest error %.1e\n", largest, worst);
    assert_true(largest > 0.05 && worst < 2e-4);
}

typedef struct Load {
    double x, y, turn;
} Load;

/* Minus the central difference of the energy over 2 h. */
static Load slope_of(const Pair *p, double h)
{
    return (Load){(energy_at(p, -h, 0, 0) - energy_at(p, h, 0, 0)) / (2 * h),
                  (energy_at(p, 0, -h, 0) - energy_at(p, 0, h, 0)) / (2 * h),
                  (energy_at(p, 0, 0, -h) - energy_at(p, 0, 0, h)) / (2 * h)};
}

static double gap_of(Load a, Load b)
{
    return fmax(fabs(a.x - b.x), fmax(fabs(a.y - b.y), fabs(a.turn - b.turn)));
}

/* Force and torque are minus the gradient, in every kind. Where a corner goes over an edge within
 * the difference, its second derivative jumps and two differences disagree: such pairs are passed
 * over, and are few. Of others the wider difference is off by at most 1e-8 / (1 - 0.7^2), for its
 * error goes with the square of its step. */
static void test_push_is_the_gradient(void **state)
{
    (void)state;
    enum { PAIRS = 20000 };
    int tried[7] = {0}, over = 0;
    double worst = 0, largest = 0;
    drawn = oz_random_stream(1, 3);
    for (int i = 0; i < PAIRS; i++) {
        Pair p = some_pair();
        OzOverlap o = overlap_of(&p);
        Load push = {o.push.x, o.push.y, o.moment}, slope = slope_of(&p, 1e-5);
        if (gap_of(slope, slope_of(&p, 0.7e-5)) > 1e-8) {
            over++;
            continue;
        }
        tried[(int)oz_triangle_overlap(&p.a, &p.b).kind]++;
        worst = fmax(worst, gap_of(push, slope));
        largest = fmax(largest, hypot(push.x, push.y));
    }
    print_message("push against the gradient: %.1e of %.2g, %d pairs passed over\n", worst, largest,
                  over);
    for (int kind = 0; kind < 7; kind++) {
        assert_true(tried[kind] > 20);
    }
    assert_true(over < PAIRS / 100);
    assert_true(worst < 3e-8 && largest > 0.1);
}

/* Exchanged, the two feel the opposite, and the same moment about any origin. */
static void test_opposite(void **state)
{
    (void)state;
    drawn = oz_random_stream(1, 4);
    for (int i = 0; i < 5000; i++) {
        Pair p = some_pair();
        p.wall = 0;
        Pair back = {p.b, p.a, p.outer_b, p.outer_a, 0};
        OzOverlap o = overlap_of(&p), r = overlap_of(&back);
        /* sums of a dozen terms below 1 */
        assert_true(hypot(o.push.x + r.push.x, o.push.y + r.push.y) < 1e-13);
        assert_true(fabs(o.moment + r.moment) < 1e-13);
        assert_true(fabs(o.area - oz_triangle_overlap(&p.a, &p.b).area) < 1e-13);
        p.a = moved(p.a, 2, -1, 0);
        p.b = moved(p.b, 2, -1, 0);
        double moment = overlap_of(&p).moment - oz_cross2(oz_vec2(2, -1), o.push);
        assert_true(fabs(moment - o.moment) < 1e-13);
    }
}

/* The pair with b where the kind of contact changes as b goes 3 along a way, and a little farther
 * or less far; false where it changes nowhere. */
static bool pair_at_change(Pair *p, OzVec2 way, double step)
{
    OzTriangle start = moved(p->b, -1.5 * way.x, -1.5 * way.y, 0);
    double low = 0, high = 3, kind = oz_triangle_overlap(&p->a, &start).kind;
    for (int k = 0; k < 50; k++) {
        double middle = 0.5 * (low + high);
        OzTriangle there = moved(start, middle * way.x, middle * way.y, 0);
        bool same = oz_triangle_overlap(&p->a, &there).kind == kind;
        low = same ? middle : low;
        high = same ? high : middle;
    }
    p->b = moved(start, (low + step) * way.x, (low + step) * way.y, 0);
    return low < 2.9;
}

/* Where kinds change the push is the same on either side, where that of the kinds jumps. 1e-9 from
 * the change it may differ by that times a stiffness: of six edges shorter than 3, and more where
 * edges are nearly parallel, of which pieces grow the faster: 300 at the most. */
static void test_push_is_continuous(void **state)
{
    (void)state;
    int changes = 0;
    double worst = 0, worst_of_kinds = 0;
    drawn = oz_random_stream(1, 5);
    for (int i = 0; i < 4000; i++) {
        Pair before = some_pair(), after = before;
        double turn = uniform(-3, 3);
        OzVec2 way = oz_vec2(cos(turn), sin(turn));
        changes += pair_at_change(&before, way, -1e-9);
        pair_at_change(&after, way, 1e-9);
        OzOverlap o = overlap_of(&before), q = overlap_of(&after);
        worst = fmax(worst, oz_length2(oz_minus2(o.push, q.push)));
        worst = fmax(worst, fabs(o.moment - q.moment));
        o = oz_triangle_overlap(&before.a, &before.b);
        q = oz_triangle_overlap(&after.a, &after.b);
        worst_of_kinds = fmax(worst_of_kinds, oz_length2(oz_minus2(o.push, q.push)));
    }
    print_message("%d changes of kind, largest jump %.1e, of kinds %.2g\n", changes, worst,
                  worst_of_kinds);
    assert_true(changes > 3000 && worst_of_kinds > 0.1);
    assert_true(worst < 1e-6);
}

/* A triangle's bottom of length l, parallel to a wide edge and d below it, its top h above its
 * bottom. Of the width l (1 - y / h) at y above the bottom, either depth's integral and its
 * derivative by d; a kind's push is the area, l (d - d^2 / 2h). */
static void test_flat_contact(void **state)
{
    (void)state;
    const double l = 0.3, d = 0.02, h = 0.7;
    Pair p = {triangle(-9, 0, 0, -9, 9, 0), triangle(0, -d, l, -d, l / 3, h - d), 4, 1, 0};
    double upper = l * (d * d / 2 - d * d * d / (6 * h)),
           lower = l * (d * d / 2 - d * d * d / (3 * h));
    OzOverlap o = overlap_of(&p);
    /* rounding of sums of 0.1 */
    assert_true(fabs(energy_of(&p) - (upper + lower) / 2) < 1e-16);
    assert_true(fabs(o.push.y - l * (d - 3 * d * d / (4 * h))) < 1e-16);
    assert_true(fabs(o.push.x) < 1e-16 * 10);
    p.wall = 1; /* a's field alone */
    assert_true(fabs(energy_of(&p) - upper) < 1e-16);
    assert_true(fabs(overlap_of(&p).push.y - l * (d - d * d / (2 * h))) < 1e-15);
}

/* A square's right-angled corner, two triangles that part it in the middle, h deep in a wide edge:
 * (1 + sin 45) / 2 of the area h^2. */
static void test_corner(void **state)
{
    (void)state;
    const double h = 0.05;
    Pair right = {triangle(-9, 0, 0, -9, 9, 0), triangle(0, -h, 1, 1 - h, 0, 1 - h), 4, 1, 0};
    Pair left = {right.a, triangle(0, -h, 0, 1 - h, -1, 1 - h), 4, 4, 0};
    OzVec2 push = oz_add2(overlap_of(&right).push, overlap_of(&left).push);
    assert_true(fabs(push.y / (h * h) - (1 + sqrt(0.5)) / 2) < 1e-13);
    assert_true(fabs(push.x) < 1e-16);
}

/* A triangle inside another, to whose outer edge it is 0.2 away: half the area times the slope
 * pushes it out, and nothing the other way, since its own depth holds all of it. */
static void test_swallowed_is_pushed_out(void **state)
{
    (void)state;
    Pair p = {triangle(-9, 0, 0, -9, 9, 0), triangle(-0.1, -0.4, 0.1, -0.4, 0, -0.2), 4, 7, 0};
    OzOverlap o = overlap_of(&p);
    assert_true(fabs(o.push.x) < 1e-15 && fabs(o.push.y - 0.5 * 0.02) < 1e-15);
    assert_true(!o.deep && !o.swallowed && fabs(o.share - 1) < 1e-13);
}

/* A star of four points about a centre at the origin, its outer edges second as fans have them. */
enum { SPOKES = 8 };

static OzTriangle star_part(int part, double x, double y, double turn)
{
    double from = part * M_PI / 4, to = from + M_PI / 4;
    double one = part % 2 ? 0.55 : 1, other = part % 2 ? 1 : 0.55;
    return moved(triangle(0, 0, one * cos(from), one * sin(from), other * cos(to), other * sin(to)),
                 x, y, turn);
}

/* What a star does to another in place, and the energy; seen: the kinds of contact met, as bits. */
static Load meet_stars(double x, double y, double turn, bool kinds, double *energy, int *seen)
{
    Load sum = {0, 0, 0};
    *energy = 0;
    for (int i = 0; i < SPOKES * SPOKES; i++) {
        Pair p = {star_part(i / SPOKES, 0, 0, 0), star_part(i % SPOKES, x, y, turn), 2, 2, 0};
        OzOverlap o = oz_triangle_overlap(&p.a, &p.b);
        *seen |= 1 << (int)o.kind;
        *energy += energy_of(&p);
        o = kinds ? o : overlap_of(&p);
        sum.x += o.push.x;
        sum.y += o.push.y;
        sum.turn += o.moment - oz_cross2(oz_vec2(x, y), o.push);
    }
    return sum;
}

/* Net work around a closed path of press, turn and release, over the energy's maximum, by the
 * trapezoidal rule. */
static double loop_work(bool kinds, int steps, int *seen)
{
    double work = 0, stored = 0;
    for (int i = 0; i < steps; i++) {
        double s = 2 * M_PI * i / steps, energy;
        Load push = meet_stars(1.5 + 0.2 * cos(s), 0.35 + 0.1 * sin(s), 0.5 + 0.25 * sin(s), kinds,
                               &energy, seen);
        work += (-0.2 * sin(s) * push.x + 0.1 * cos(s) * push.y + 0.25 * cos(s) * push.turn) * 2 *
                M_PI / steps;
        stored = fmax(stored, energy);
    }
    return work / stored;
}

/* The rule's error goes with the square of its step where the force has kinks. */
static void test_loop(void **state)
{
    (void)state;
    int seen = 0;
    double field = loop_work(false, 4000, &seen), kinds = loop_work(true, 1000, &seen);
    print_message("net work of a closed loop over the stored energy: %.1e, by kinds %.1e\n", field,
                  kinds);
    assert_true((seen >> 1 & 7) == 7); /* kinds i to iii */
    assert_true(fabs(field) < 1e-8 && fabs(kinds) > 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_energy_is_the_integral_of_depth),
        cmocka_unit_test(test_push_is_the_gradient),
        cmocka_unit_test(test_opposite),
        cmocka_unit_test(test_push_is_continuous),
        cmocka_unit_test(test_flat_contact),
        cmocka_unit_test(test_corner),
        cmocka_unit_test(test_swallowed_is_pushed_out),
        cmocka_unit_test(test_loop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
