/* A shaken box of grains and walls of four materials, under any law. */
#ifndef OZ_TESTS_MIXTURE_RIG_H
#define OZ_TESTS_MIXTURE_RIG_H

#include "device_rig.h"

#define SHAKEN                                                                                     \
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"   \
    "observe: {ledger: true}\n%s"                                                                  \
    "walls:\n"                                                                                     \
    "  - {kind: plane, motion: {frequency: 300, amplitude: 1e-4}%s}\n"                             \
    "  - {kind: cylinder, diameter: 6e-3%s}\n"                                                     \
    "  - {kind: plane, point: [0, 0, 0.011], normal: [0.1, 0, -1]%s}\n"

#define GRAINS(a, b, c)                                                                            \
    "grains:\n"                                                                                    \
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2" a "}\n"                            \
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3, fill: 0.2" b "}\n"                 \
    "  - {kind: random, count: 21, diameter: [0.4e-3, 0.8e-3], aspect: [0.5, 3], fill: 0.2" c      \
    "}\n"

#define MIXTURE                                                                                    \
    "contact: {%s, rolling_friction: 0.1}\nmaterials:\n"                                           \
    "  - {name: one, density: 2000, restitution: 0.9, friction: 0.2, %s: %s}\n"                    \
    "  - {name: two, density: 3000, restitution: 0.3, friction: 0.8, surface_energy: 1e-4}\n"      \
    "  - {name: three, density: 1500, friction: 0.5, rolling_friction: 0.3}\n"                     \
    "  - {name: four, friction: 0.1}\n"                                                            \
    "pairs: [{between: [two, three], restitution: 0.8}, {between: [four, one], friction: 0.6}]\n"

static inline void open_mixture(Rig *rig, const char *precision, const char *contact,
                                const char *key, const char *value)
{
    char text[3000];
    snprintf(text, sizeof text,
             MIXTURE GRAINS(", material: one", ", material: two", ", material: three"), contact,
             key, value);
    rig_open(rig, SHAKEN, precision, text, ", material: four", ", contact: {friction: 0.05}",
             ", material: two");
    throw_grains(&rig->grains, 0.4, 20);
}

static const char hooke[] = "contact_time: 3e-4, restitution: 0.5";

#endif
