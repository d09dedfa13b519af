/* Grains of triangles built by hand, stepped by the host reference. */
#ifndef OZ_TESTS_ELEMENT_RIG_H
#define OZ_TESTS_ELEMENT_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sim/element_reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct ElementRig {
    OzScene scene;
    OzGrains grains;
    OzElementReference *reference;
    OzSnapshot now;
} ElementRig;

static inline void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

/* Reads the scene's first lines (printf style); its grains are built by hand afterwards. */
static inline void rig_read(ElementRig *rig, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    strncat(text,
            "\nmodel: trigrains\ngrains:\n"
            "  - {kind: single, shape: square, edge: 2e-3, position: [0, 0]}\n",
            sizeof text - strlen(text) - 1);
    memset(rig, 0, sizeof *rig);
    must(oz_scene_parse(&rig->scene, "rig.yaml", text, NULL, 0));
}

/* Room for grains of equal numbers of elements and beams, and for the scene's walls of one element
 * each; what the elements are is set next. */
static inline OzElements *rig_grains(ElementRig *rig, int64_t grains, int64_t each, int64_t beams)
{
    int walls = rig->scene.wall_count;
    OzElementCounts counts = {.grains = grains,
                              .walls = walls,
                              .free_elements = grains * each,
                              .wall_elements = walls,
                              .beams = grains * beams};
    must(oz_grains_create(&rig->grains, grains));
    must(oz_elements_create(&rig->grains.elements, &counts));
    OzElements *elements = rig->grains.elements;
    for (int64_t i = 0; i < elements->count; i++) {
        bool wall = i >= elements->free_count;
        elements->body[i] = (int)(wall ? grains + i - elements->free_count : i / each);
    }
    for (int64_t g = 0; g <= grains + walls; g++) {
        elements->first[g] = g <= grains ? g * each : elements->free_count + g - grains;
    }
    return elements;
}

/* Grain g as a square about a centre, turned, in uniform motion: a triangle on each edge, and beams
 * between neighbours. */
static inline void rig_square(ElementRig *rig, int g, double edge, const double centre[2],
                              double turn, const double velocity[2], double density)
{
    OzElements *elements = rig->grains.elements;
    double reach = edge / sqrt(2), quarter = 2 * atan(1);
    for (int k = 0; k < 4; k++) {
        double from = turn + quarter * (k + 0.5), to = from + quarter;
        double corners[6] = {centre[0],
                             centre[1],
                             centre[0] + reach * cos(from),
                             centre[1] + reach * sin(from),
                             centre[0] + reach * cos(to),
                             centre[1] + reach * sin(to)};
        must(oz_elements_set_triangle(elements, 4 * g + k, corners, density));
        memcpy(&elements->velocity[2 * (4 * g + k)], velocity, 2 * sizeof(double));
    }
    const int ends[4][2] = {{0, 1}, {0, 3}, {1, 2}, {2, 3}};
    for (int k = 0; k < 4; k++) {
        elements->beam_a[4 * g + k] = 4 * g + ends[k][0];
        elements->beam_b[4 * g + k] = 4 * g + ends[k][1];
        oz_elements_rest_beam(elements, 4 * g + k);
    }
}

static inline void rig_start(ElementRig *rig)
{
    oz_element_reference_free(rig->reference);
    oz_snapshot_free(&rig->now);
    must(oz_element_reference_create(&rig->reference, &rig->scene, &rig->grains));
    must(oz_snapshot_create(&rig->now, &rig->scene, &rig->grains));
    must(oz_element_reference_snapshot(rig->reference, &rig->now));
}

/* One grain of two triangles alike, mirrored about the y axis, and a beam along x. */
static inline OzElements *rig_pair(ElementRig *rig)
{
    const double corners[2][6] = {{-2e-3, 0, -0.4e-3, -1e-3, -0.4e-3, 1e-3},
                                  {2e-3, 0, 0.4e-3, -1e-3, 0.4e-3, 1e-3}};
    OzElements *elements = rig_grains(rig, 1, 2, 1);
    for (int i = 0; i < 2; i++) {
        must(oz_elements_set_triangle(elements, i, corners[i], 4));
    }
    elements->beam_a[0] = 0;
    elements->beam_b[0] = 1;
    oz_elements_rest_beam(elements, 0);
    return elements;
}

/* One square whose triangles move wildly, and turn at up to `spin` (rad/s). */
static inline void rig_wild_square(ElementRig *rig, double spin)
{
    const double still[2] = {0, 0};
    OzElements *elements = rig_grains(rig, 1, 4, 4);
    rig_square(rig, 0, 2e-3, still, 0.3, still, 4);
    for (int i = 0; i < 4; i++) {
        elements->velocity[2 * i] = 0.3 * cos(3 * i);
        elements->velocity[2 * i + 1] = 0.5 * sin(2 * i + 1);
        elements->angular_velocity[i] = spin * cos(5 * i + 1);
    }
}

static inline void rig_advance(ElementRig *rig, int64_t step)
{
    must(oz_element_reference_advance(rig->reference, step));
    must(oz_element_reference_snapshot(rig->reference, &rig->now));
}

static inline void rig_close(ElementRig *rig)
{
    oz_element_reference_free(rig->reference);
    oz_snapshot_free(&rig->now);
    oz_grains_free(&rig->grains);
    oz_scene_free(&rig->scene);
}

/* Momentum, and angular momentum about the origin. */
static inline void rig_momentum(const OzSnapshot *s, double momentum[3])
{
    const OzElements *elements = s->grains->elements;
    memset(momentum, 0, 3 * sizeof *momentum);
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *x = &s->element_position[2 * i], *v = &s->element_velocity[2 * i];
        momentum[0] += elements->mass[i] * v[0];
        momentum[1] += elements->mass[i] * v[1];
        momentum[2] += elements->mass[i] * (x[0] * v[1] - x[1] * v[0]) +
                       elements->inertia[i] * s->element_angular_velocity[i];
    }
}

/* Kinetic energy of all elements, without and with what contacts and beams hold. */
static inline double rig_kinetic(const OzSnapshot *s)
{
    const OzElements *elements = s->grains->elements;
    double energy = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *v = &s->element_velocity[2 * i], w = s->element_angular_velocity[i];
        energy += 0.5 * elements->mass[i] * (v[0] * v[0] + v[1] * v[1]) +
                  0.5 * elements->inertia[i] * w * w;
    }
    return energy;
}

static inline double rig_energy(const OzSnapshot *s)
{
    return rig_kinetic(s) + oz_contact_list_sum(&s->contacts).energy + s->beams.energy;
}

#endif
