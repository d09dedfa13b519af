/* Power iteration of each grain's beams about rest. The coordinates are scaled by the roots of mass
 * and inertia, so that stiffness and damping are symmetric. */
#include "model/beam_limits.h"

#include "base/memory.h"
#include "model/contact.h"

#include <math.h>
#include <stdlib.h>

/* The quotient then is within a hundredth of the largest eigenvalue for grains of tens of elements.
 */
enum { ITERATIONS = 200 };

double oz_beam_limits_step(OzIntegrator integrator, double rate, double damping)
{
    double one = 0, square = 0; /* one dt + square dt^2 < 1 */
    double alone = INFINITY;
    switch (integrator) {
    case OZ_INTEGRATOR_GEAR4:
        one = damping / 0.3;
        square = rate * rate;
        alone = 0.55 / rate;
        break;
    case OZ_INTEGRATOR_RK4:
        one = damping / 2.78;
        square = rate * rate / (2.82 * 2.82);
        break;
    default:
        one = damping;
        square = rate * rate / 4;
    }
    /* the positive root, without the cancellation that small squares bring */
    return fmin(2 / (one + sqrt(one * one + 4 * square)), alone);
}

/* How a beam is deformed by displacements of its two ends. */
typedef struct Strain {
    double axis[2], length;
    double elongation, bend_a, bend_b;
} Strain;

static void move_of(const OzElements *elements, int i, const double *scaled, double move[3])
{
    move[0] = scaled[0] / sqrt(elements->mass[i]);
    move[1] = scaled[1] / sqrt(elements->mass[i]);
    move[2] = scaled[2] / sqrt(elements->inertia[i]);
}

static Strain strain_of(const OzElements *elements, int64_t k, int64_t first, const double *q)
{
    int a = elements->beam_a[k], b = elements->beam_b[k];
    const double *x = elements->position;
    double at_a[3], at_b[3], length = elements->beam_length[k];
    Strain s = {
        {(x[2 * b] - x[2 * a]) / length, (x[2 * b + 1] - x[2 * a + 1]) / length}, length, 0, 0, 0};
    move_of(elements, a, q + 3 * (a - first), at_a);
    move_of(elements, b, q + 3 * (b - first), at_b);
    double apart[2] = {at_b[0] - at_a[0], at_b[1] - at_a[1]};
    double turn = (s.axis[0] * apart[1] - s.axis[1] * apart[0]) / length;
    s.elongation = s.axis[0] * apart[0] + s.axis[1] * apart[1];
    s.bend_a = at_a[2] - turn;
    s.bend_b = at_b[2] - turn;
    return s;
}

/* Adds what a pull and two moments that resist the strain give to the ends' scaled coordinates. */
static void add_ends(const OzElements *elements, int64_t k, int64_t first, const Strain *s,
                     double pull, double moment_a, double moment_b, double *out)
{
    int ends[2] = {elements->beam_a[k], elements->beam_b[k]};
    double moments[2] = {moment_a, moment_b}, shear = (moment_a + moment_b) / s->length;
    for (int e = 0; e < 2; e++) {
        double sign = e == 0 ? -1 : 1, *o = out + 3 * (ends[e] - first);
        double root = sqrt(elements->mass[ends[e]]);
        o[0] += sign * (pull * s->axis[0] + shear * s->axis[1]) / root;
        o[1] += sign * (pull * s->axis[1] - shear * s->axis[0]) / root;
        o[2] += moments[e] / sqrt(elements->inertia[ends[e]]);
    }
}

/* A grain's beams: those between its elements. */
typedef struct Network {
    const OzElements *elements;
    const OzBeamValues *beams;
    int64_t first, count;     /* elements                    */
    int64_t beam, beam_count; /* the grain's first, and all */
} Network;

/* Stiffness (or damping) applied to q, scaled. Returns the beam that holds most of q's energy. */
static int64_t apply(const Network *n, int damping, const double *q, double *out)
{
    int64_t most = -1;
    double greatest = -1, gamma = n->beams->damping, stiffness = n->beams->stiffness;
    for (int64_t c = 0; c < 3 * n->count; c++) {
        out[c] = 0;
    }
    for (int64_t k = n->beam; k < n->beam + n->beam_count; k++) {
        Strain s = strain_of(n->elements, k, n->first, q);
        double per_length = n->beams->second_moment / s.length;
        double bend = (damping ? gamma : 4 * stiffness) * per_length;
        double cross = damping ? 0 : 2 * stiffness * per_length;
        double pull = (damping ? gamma : stiffness) * s.elongation;
        double moment_a = bend * s.bend_a + cross * s.bend_b;
        double moment_b = cross * s.bend_a + bend * s.bend_b;
        double energy = pull * s.elongation + moment_a * s.bend_a + moment_b * s.bend_b;
        add_ends(n->elements, k, n->first, &s, pull, moment_a, moment_b, out);
        most = energy > greatest ? k : most;
        greatest = fmax(energy, greatest);
    }
    return most;
}

/* The largest eigenvalue; *beam receives the beam that matters most to it. q and out: scratch. */
static double largest(const Network *n, int damping, double *q, double *out, int64_t *beam)
{
    double value = 0;
    for (int64_t c = 0; c < 3 * n->count; c++) {
        q[c] = cos(1.7 * (double)c * (double)c + 0.3); /* in no symmetry of any grain */
    }
    for (int i = 0; i < ITERATIONS; i++) {
        double size = 0;
        *beam = apply(n, damping, q, out);
        for (int64_t c = 0; c < 3 * n->count; c++) {
            size += out[c] * out[c];
        }
        value = sqrt(size);
        for (int64_t c = 0; c < 3 * n->count && value > 0; c++) {
            q[c] = out[c] / value;
        }
    }
    return value;
}

static double longest_edge(const double corner[6])
{
    double longest = 0;
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3;
        longest = fmax(longest,
                       hypot(corner[2 * d] - corner[2 * c], corner[2 * d + 1] - corner[2 * c + 1]));
    }
    return longest;
}

/* Squared angular frequency of an element pressed to another alike, and *damping. A triangle whose
 * edge l lies in the other moves against Y l and turns against Y l^3 / 12. */
static double contact_rate2(const OzScene *scene, const OzElements *elements, int64_t i,
                            double *damping)
{
    double mass = elements->mass[i], radius = elements->radius[i];
    *damping = 0;
    if (radius <= 0) {
        double edge = longest_edge(elements->corner + 6 * i);
        return 2 * scene->triangles.stiffness *
               fmax(edge / mass, edge * edge * edge / (12 * elements->inertia[i]));
    }
    OzContactConstants constants = oz_contact_constants_of(&scene->contact, &scene->contact);
    *damping = constants.damping;
    return scene->contact.law == OZ_LAW_HERTZ
               ? 1.5 * constants.stiffness * sqrt(0.1 * radius) / (0.5 * mass)
               : constants.stiffness;
}

/* The largest step of one grain whose network is given. */
static OzBeamLimit limit_of(const OzScene *scene, const Network *n, int64_t grain, double *scratch)
{
    OzBeamLimit limit = {.grain = grain, .beam = -1};
    double touch = 0, touch_damping = 0, one;
    int64_t unused;
    for (int64_t i = n->first; i < n->first + n->count; i++) {
        touch = fmax(touch, contact_rate2(scene, n->elements, i, &one));
        touch_damping = fmax(touch_damping, one);
    }
    double hold = largest(n, 0, scratch, scratch + 3 * n->count, &limit.beam);
    double loss = largest(n, 1, scratch, scratch + 3 * n->count, &unused);
    int64_t substeps = scene->beams.substeps > 1 ? scene->beams.substeps : 1;
    if (substeps > 1) {
        double inner = (double)substeps * oz_beam_limits_step(scene->integrator, sqrt(hold), loss);
        double outer = oz_beam_limits_step(scene->integrator, sqrt(touch), touch_damping);
        limit.largest_step = fmin(inner, outer);
    } else {
        limit.largest_step =
            oz_beam_limits_step(scene->integrator, sqrt(hold + touch), loss + touch_damping);
    }
    limit.rate = sqrt(hold + touch);
    limit.damping = loss + touch_damping;
    limit.beam = touch > hold ? -1 : limit.beam;
    return limit;
}

OzStatus oz_beam_limits_find(OzBeamLimit *limit, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    const OzElements *elements = grains->elements;
    double *scratch = NULL;
    int64_t most = 1, beam = 0;
    *limit = (OzBeamLimit){.grain = -1, .beam = -1, .largest_step = INFINITY};
    for (int64_t g = 0; g < elements->grain_count; g++) {
        int64_t count = elements->first[g + 1] - elements->first[g];
        most = count > most ? count : most;
    }
    OZ_TRY(OZ_NEW(&scratch, 6 * most));
    for (int64_t g = 0; g < elements->grain_count; g++) {
        Network n = {elements,
                     &scene->beams,
                     elements->first[g],
                     elements->first[g + 1] - elements->first[g],
                     beam,
                     0};
        while (beam < elements->beam_count && elements->body[elements->beam_a[beam]] == g) {
            beam++;
        }
        n.beam_count = beam - n.beam;
        OzBeamLimit found = limit_of(scene, &n, g, scratch);
        if (found.largest_step < limit->largest_step) {
            *limit = found;
        }
    }
done:
    free(scratch);
    return status;
}
