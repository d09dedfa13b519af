/* The yardstick for trigrains' speed: a hopper of 400 grains of triangles and beams (Poeschel and
 * Buchholtz 1995) in plain C, double precision, for one core, as a good C programmer would write
 * it: cells and a neighbour list with skin, circles and separating edges that reject early, Gear's
 * predictor-corrector of fourth order, forces at the overlap's centroid. It uses nothing of orzo,
 * so that nothing can slow both. Overlaps of all kinds are pushed across the way of one outline
 * through the other: right for two crossings, cheaper than the real thing for more. Nothing guards
 * it: after 55000 steps a grain that has fallen through breaks, so it is timed before. SI units.
 *
 * yardstick_elements [steps before the timed ones [timed steps]]     prints one line of key=value
 */
#include "yardstick_elements_bed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { PAIRS = 64 * ELEMENTS, CELLS = 64 };

#define SKIN 0.3e-3 /* 0.2 and 0.4 mm were alike, 0.8 mm slower */
#define CELL 5e-3

static int pairs[PAIRS][2], pair_count, next[ELEMENTS], head[CELLS][CELLS];
static long contacts, rebuilds;

static void predict(Element *p)
{
    for (int c = 0; c < 3; c++) {
        double *q = p->q[c];
        q[0] += q[1] + q[2] + q[3] + q[4];
        q[1] += 2 * q[2] + 3 * q[3] + 4 * q[4];
        q[2] += 3 * q[3] + 6 * q[4];
        q[3] += 4 * q[4];
        p->force[c] = 0;
    }
    p->at = (Vec){p->q[0][0], p->q[1][0]};
    p->velocity = (Vec){p->q[0][1] / STEP, p->q[1][1] / STEP};
    p->angle = p->q[2][0];
    p->spin = p->q[2][1] / STEP;
    double co = cos(p->angle), si = sin(p->angle);
    for (int k = 0; k < 3; k++) {
        p->corner[k].x = p->at.x + co * p->body[k].x - si * p->body[k].y;
        p->corner[k].y = p->at.y + si * p->body[k].x + co * p->body[k].y;
    }
}

static void correct(Element *p)
{
    double acceleration[3] = {p->force[0] / p->mass, p->force[1] / p->mass - GRAVITY,
                              p->force[2] / p->inertia};
    for (int c = 0; c < 3; c++) {
        double *q = p->q[c], error = 0.5 * STEP * STEP * acceleration[c] - q[2];
        q[0] += 19.0 / 90 * error;
        q[1] += 0.75 * error;
        q[2] += error;
        q[3] += 0.5 * error;
        q[4] += error / 12;
    }
}

static void apply(Element *a, Element *b, Vec force, Vec at)
{
    a->force[0] -= force.x;
    a->force[1] -= force.y;
    a->force[2] -= cross(minus(at, a->at), force);
    b->force[0] += force.x;
    b->force[1] += force.y;
    b->force[2] += cross(minus(at, b->at), force);
}

/* side[k][c]: where corner c of b stands against edge k of a. 0 when an edge parts them. */
static int sides(const Element *a, const Element *b, double side[3][3])
{
    for (int k = 0; k < 3; k++) {
        Vec edge = minus(a->corner[(k + 1) % 3], a->corner[k]);
        int inside = 0;
        for (int c = 0; c < 3; c++) {
            side[k][c] = cross(edge, minus(b->corner[c], a->corner[k]));
            inside |= side[k][c] > 0;
        }
        if (!inside) {
            return 0;
        }
    }
    return 1;
}

/* Adds the polygon of a's corners inside b and the crossings, about origin: area and first moments.
 */
static void sweep(Vec from, Vec to, double *area, Vec *moment)
{
    double part = 0.5 * cross(from, to);
    *area += part;
    moment->x += part * (from.x + to.x) / 3;
    moment->y += part * (from.y + to.y) / 3;
}

/* One triangle's outline inside the other, edge by edge, about an origin; gives its way from end to
 * end. */
static Vec outline(const Element *t, double side[3][3], Vec origin, double *area, Vec *moment)
{
    Vec way = {0, 0};
    for (int k = 0; k < 3; k++) {
        double low = 0, high = 1;
        for (int j = 0; j < 3; j++) {
            double d0 = side[j][k], d1 = side[j][(k + 1) % 3];
            if (d0 < 0 && d1 < 0) {
                high = -1;
            } else if (d0 < 0) {
                low = fmax(low, d0 / (d0 - d1));
            } else if (d1 < 0) {
                high = fmin(high, d0 / (d0 - d1));
            }
        }
        if (high > low) {
            Vec start = minus(t->corner[k], origin);
            Vec edge = minus(t->corner[(k + 1) % 3], t->corner[k]);
            sweep((Vec){start.x + low * edge.x, start.y + low * edge.y},
                  (Vec){start.x + high * edge.x, start.y + high * edge.y}, area, moment);
            way.x += (high - low) * edge.x;
            way.y += (high - low) * edge.y;
        }
    }
    return way;
}

static void touch(Element *a, Element *b)
{
    double of_a[3][3], of_b[3][3], area = 0;
    Vec apart = minus(b->at, a->at), point[6], moment = {0, 0};
    double reach = a->reach + b->reach;
    int crossings = 0;
    if (apart.x * apart.x + apart.y * apart.y > reach * reach || !sides(a, b, of_a) ||
        !sides(b, a, of_b)) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3 && crossings < 6; j++) {
            double c0 = of_a[k][j], c1 = of_a[k][(j + 1) % 3];
            if ((c0 > 0) != (c1 > 0) && (of_b[j][k] > 0) != (of_b[j][(k + 1) % 3] > 0)) {
                double at = c0 / (c0 - c1);
                Vec start = b->corner[j], edge = minus(b->corner[(j + 1) % 3], start);
                point[crossings++] = (Vec){start.x + at * edge.x, start.y + at * edge.y};
            }
        }
    }
    if (crossings < 2) {
        return;
    }
    Vec way = outline(a, of_b, point[0], &area, &moment);
    outline(b, of_a, point[0], &area, &moment);
    Vec normal = {way.y, -way.x};
    double push = STIFFNESS * area / (sqrt(normal.x * normal.x + normal.y * normal.y) + 1e-300);
    Vec at = {point[0].x + moment.x / area, point[0].y + moment.y / area};
    apply(a, b, (Vec){push * normal.x, push * normal.y}, at);
    contacts++;
}

static double wrap(double angle)
{
    return angle > PI ? angle - 2 * PI : angle < -PI ? angle + 2 * PI : angle;
}

static void pull(const Beam *beam)
{
    Element *a = &elements[beam->a], *b = &elements[beam->b];
    Vec apart = minus(b->at, a->at), passing = minus(b->velocity, a->velocity);
    double length = sqrt(apart.x * apart.x + apart.y * apart.y),
           direction = atan2(apart.y, apart.x);
    Vec axis = {apart.x / length, apart.y / length}, across = {-axis.y, axis.x};
    double turning = (passing.x * across.x + passing.y * across.y) / length;
    double bend_a = wrap(a->angle - beam->rest_a - direction);
    double bend_b = wrap(b->angle - beam->rest_b - direction);
    double bending = BEAM_EI / beam->length, damping = DAMPING_I / beam->length;
    double moment_a = -bending * (4 * bend_a + 2 * bend_b);
    double moment_b = -bending * (2 * bend_a + 4 * bend_b);
    double shear = -(moment_a + moment_b) / length;
    double pull =
        -BEAM_E * (length - beam->length) - DAMPING * (passing.x * axis.x + passing.y * axis.y);
    Vec force = {pull * axis.x + shear * across.x, pull * axis.y + shear * across.y};
    a->force[0] -= force.x;
    a->force[1] -= force.y;
    a->force[2] += moment_a - damping * (a->spin - turning);
    b->force[0] += force.x;
    b->force[1] += force.y;
    b->force[2] += moment_b - damping * (b->spin - turning);
}

static int cell_of(double x)
{
    return (int)floor(x / CELL) & (CELLS - 1);
}

static void list_pair(int i, int j)
{
    Vec apart = minus(elements[i].at, elements[j].at);
    double reach = elements[i].reach + elements[j].reach + SKIN;
    if (elements[i].grain != elements[j].grain &&
        apart.x * apart.x + apart.y * apart.y < reach * reach && pair_count < PAIRS) {
        pairs[pair_count][0] = i;
        pairs[pair_count++][1] = j;
    }
}

static void rebuild(void)
{
    memset(head, -1, sizeof head);
    pair_count = 0;
    rebuilds++;
    for (int i = free_count - 1; i >= 0; i--) {
        int *first = &head[cell_of(elements[i].at.y)][cell_of(elements[i].at.x)];
        next[i] = *first;
        *first = i;
        elements[i].noted = elements[i].at;
    }
    for (int i = 0; i < free_count; i++) {
        int x = cell_of(elements[i].at.x), y = cell_of(elements[i].at.y);
        for (int k = 0; k < 9; k++) {
            int j = head[(y + k / 3 - 1) & (CELLS - 1)][(x + k % 3 - 1) & (CELLS - 1)];
            for (; j >= 0; j = next[j]) {
                if (j > i) {
                    list_pair(i, j);
                }
            }
        }
        for (int j = free_count; j < count; j++) {
            list_pair(i, j);
        }
    }
}

static void step(void)
{
    double farthest = 0;
    for (int i = 0; i < free_count; i++) {
        predict(&elements[i]);
        Vec way = minus(elements[i].at, elements[i].noted);
        farthest = fmax(farthest, way.x * way.x + way.y * way.y);
    }
    if (4 * farthest > SKIN * SKIN || rebuilds == 0) {
        rebuild();
    }
    for (int k = 0; k < pair_count; k++) {
        touch(&elements[pairs[k][0]], &elements[pairs[k][1]]);
    }
    for (int k = 0; k < beam_count; k++) {
        pull(&beams[k]);
    }
    for (int i = 0; i < free_count; i++) {
        correct(&elements[i]);
    }
}

int main(int argc, char **argv)
{
    long before = argc > 1 ? atol(argv[1]) : 50000, timed = argc > 2 ? atol(argv[2]) : 5000;
    build();
    for (long k = 0; k < before; k++) {
        step();
    }
    long old_contacts = contacts, old_rebuilds = rebuilds;
    clock_t start = clock();
    for (long k = 0; k < timed; k++) {
        step();
    }
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    printf("elements=%d beams=%d us_per_step=%.2f contacts=%.1f pairs=%d steps_per_rebuild=%.1f\n",
           free_count, beam_count, 1e6 * seconds / (double)timed,
           (double)(contacts - old_contacts) / (double)timed, pair_count,
           (double)timed / fmax(1, (double)(rebuilds - old_rebuilds)));
    return 0;
}
