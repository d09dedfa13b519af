/* What a scene of trigrains needs of its kernels: THE list of switches. Each becomes -D
 * OZ_<NAME>=<value>; those that are off are what `orzo check` says was left out. */
#pragma once

#include "compute/device.h"
#include "model/grains.h"
#include "scene/scene.h"

/* Begins as sim/model.h says: name, what the kernels do with it, what is saved without it
 * (NULL: not a feature that can be missing) */
#define OZ_ELEMENT_SWITCHES(X)                                                                     \
    X(LANES, lanes, NULL)                                                                          \
    X(GROUP, group, NULL)                                                                          \
    X(LEDGER, ledger, "energy ledger")                                                             \
    X(RESORT, resort, NULL)                                                                        \
    X(HOST_LISTS, host_lists, NULL)                                                                \
    X(ORDER, order, NULL)                                                                          \
    X(MOVING, moving, "moving walls")                                                              \
    X(DISCS, discs, "discs")                                                                       \
    X(BEAMS, beams, "beams")                                                                       \
    X(STRENGTH, strength, "beams that break")                                                      \
    X(YIELD, yield, "beams that yield")                                                            \
    X(SUBSTEPS, substeps, NULL)                                                                    \
    X(TRIANGLE_FIELD, triangle_field, NULL)                                                        \
    X(FORCE_POINT, force_point, NULL)                                                              \
    X(DAMPING_SHEAR, damping_shear, NULL)                                                          \
    X(IMPULSES, impulses, "mean forces on walls")

typedef struct OzElementSwitches {
    int is_double; /* -D OZ_DOUBLE when set */
#define OZ_ELEMENT_SWITCHES_MEMBER(name, member, left_out) int member;
    OZ_ELEMENT_SWITCHES(OZ_ELEMENT_SWITCHES_MEMBER)
#undef OZ_ELEMENT_SWITCHES_MEMBER
} OzElementSwitches;

/* The switches of a scene on a device. order is the number of words that a coordinate takes: 5 for
 * gear4, 3 for velocity-verlet. Work-groups of several work-items compute with one lane. resort: a
 * large scene, each phase of a step spread over all work-items (elements stay where they are);
 * substeps have too many phases for that. */
OzElementSwitches oz_element_switches_derive(const OzScene *scene, const OzGrains *grains,
                                             const OzDevice *device);
