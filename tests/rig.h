/* A scene written in a test and stepped by the host reference. */
#ifndef OZ_TESTS_RIG_H
#define OZ_TESTS_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "model/insert.h"
#include "sim/reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INTEGRATORS = 3 };
static const char *const integrator_names[INTEGRATORS] = {"euler", "symplectic-euler",
                                                          "velocity-verlet"};

typedef struct Rig {
    OzScene scene;
    OzGrains grains; /* the start: change it before rig_start */
    OzReference *reference;
    OzSnapshot now;
} Rig;

static inline void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

/* Reads the scene (printf style) and places its grains. */
static inline void rig_open(Rig *rig, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    memset(rig, 0, sizeof *rig);
    must(oz_scene_parse(&rig->scene, "rig.yaml", text, NULL, 0));
    must(oz_insert_grains(&rig->grains, &rig->scene));
}

/* Starts from the grains' state, or starts again. */
static inline void rig_start(Rig *rig)
{
    oz_reference_free(rig->reference);
    oz_snapshot_free(&rig->now);
    must(oz_reference_create(&rig->reference, &rig->scene, &rig->grains));
    must(oz_snapshot_create(&rig->now, &rig->scene, &rig->grains));
    must(oz_reference_snapshot(rig->reference, &rig->now));
}

static inline void rig_advance(Rig *rig, int64_t step)
{
    must(oz_reference_advance(rig->reference, step));
    must(oz_reference_snapshot(rig->reference, &rig->now));
}

static inline void rig_close(Rig *rig)
{
    oz_reference_free(rig->reference);
    oz_snapshot_free(&rig->now);
    oz_grains_free(&rig->grains);
    oz_scene_free(&rig->scene);
}

static inline double dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross3(const double *a, const double *b, double *to)
{
    to[0] = a[1] * b[2] - a[2] * b[1];
    to[1] = a[2] * b[0] - a[0] * b[2];
    to[2] = a[0] * b[1] - a[1] * b[0];
}

/* Angular momentum of grain i about its own centre. */
static inline void own_momentum(const OzSnapshot *s, int64_t i, double momentum[3])
{
    const double *u = &s->axis[3 * i], *w = &s->angular_velocity[3 * i];
    double across = s->grains->inertia[i], about = s->grains->inertia_axis[i];
    for (int c = 0; c < 3; c++) {
        momentum[c] = across * w[c] + (about - across) * dot3(w, u) * u[c];
    }
}

/* Kinetic, rotational and potential energy of all grains. */
static inline double mechanical_energy(const OzSnapshot *s)
{
    double energy = 0, momentum[3];
    for (int64_t i = 0; i < s->count; i++) {
        const double *v = &s->velocity[3 * i], m = s->grains->mass[i];
        own_momentum(s, i, momentum);
        energy += 0.5 * m * dot3(v, v) + 0.5 * dot3(momentum, &s->angular_velocity[3 * i]) -
                  m * dot3(s->scene->gravity, &s->position[3 * i]);
    }
    return energy;
}

/* A scene of rods with these lines is refused by these words. */
static inline void rig_refuses(const char *lines, const char *words)
{
    char text[1024];
    OzScene scene;
    snprintf(text, sizeof text,
             "model: rods\ntime: {step: 1e-5, duration: 1}\n"
             "contact: {contact_time: 1e-3, restitution: 0.5}\n%s",
             lines);
    assert_int_equal(oz_scene_parse(&scene, "rig.yaml", text, NULL, 0), OZ_ERR_INPUT);
    if (!strstr(oz_status_text(), words)) {
        fail_msg("%s\nsays nothing of: %s", oz_status_text(), words);
    }
    oz_scene_free(&scene);
}

#endif
