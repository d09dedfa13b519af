/* What a scene needs of its kernels: THE list of switches. Each becomes -D OZ_<NAME>=<value>; those
 * that are off are what `orzo check` says was left out. */
#pragma once

#include "compute/device.h"
#include "model/grains.h"
#include "scene/scene.h"

/* Begins as sim/model.h says: name, what the kernels do with it, what is saved without it
 * (NULL: not a feature that can be missing) */
#define OZ_SWITCHES(X)                                                                             \
    X(LANES, lanes, NULL)                                                                          \
    X(GROUP, group, NULL)                                                                          \
    X(LEDGER, ledger, "energy ledger")                                                             \
    X(RESORT, resort, "spatial re-sort of grains")                                                 \
    X(HOST_LISTS, host_lists, NULL)                                                                \
    X(INTEGRATOR_ID, integrator, NULL)                                                             \
    X(MOVES_BEFORE, moves_before, NULL)                                                            \
    X(ROUND, round, NULL)                                                                          \
    X(EQUAL, equal, NULL)                                                                          \
    X(FRICTION, friction, "friction")                                                              \
    X(HISTORY, history, "tangential springs and their history")                                    \
    X(ROLLING, rolling, "resistance against rolling")                                              \
    X(ROLLING_SPRING, rolling_spring, NULL)                                                        \
    X(SLIP_SCALE, slip_scale, NULL)                                                                \
    X(ATTRACTION_CLAMP, attraction_clamp, NULL)                                                    \
    X(SURFACES, surfaces, NULL)                                                                    \
    X(LAW_ID, law, NULL)                                                                           \
    X(MATERIALS, materials, NULL)                                                                  \
    X(LINE, line, "two-point contacts of parallel shafts")                                         \
    X(SMOOTH, smooth, NULL)                                                                        \
    X(AT_CONTACT, at_contact, NULL)                                                                \
    X(FINE, fine, NULL)                                                                            \
    X(ADHESION, adhesion, "adhesion")                                                              \
    X(DRAG, drag, "drag of a fluid")                                                               \
    X(GYROSCOPIC, gyroscopic, "gyroscopic term")                                                   \
    X(WALL_COUNT, walls, "walls")                                                                  \
    X(MESHES, meshes, NULL)                                                                        \
    X(WALL_EDGED, edged, NULL)                                                                     \
    X(WALL_KINDS, wall_kinds, NULL)                                                                \
    X(WALL_KINDS_MORE, wall_kinds_more, NULL)                                                      \
    X(MOVING, moving, "moving walls")                                                              \
    X(FREE_MOTION, free_motion, "walls that turn or move otherwise than up and down")              \
    X(SWUNG, swung, "walls that change their place as they turn")                                  \
    X(GATED, gated, "walls that come or go")                                                       \
    X(IMPULSES, impulses, "mean forces on walls")                                                  \
    X(SERVOS, servos, "walls that hold a pressure")                                                \
    X(PUSHED, pushed, NULL)                                                                        \
    X(PERIODIC, periodic, "periodic boundaries")                                                   \
    X(SHEAR, shear, "shear of the cell")                                                           \
    X(ALL_PAIRS, all_pairs, NULL)

typedef struct OzSwitches {
    int is_double; /* -D OZ_DOUBLE when set */
#define OZ_SWITCHES_MEMBER(name, member, left_out) int member;
    OZ_SWITCHES(OZ_SWITCHES_MEMBER)
#undef OZ_SWITCHES_MEMBER
} OzSwitches;

/* The switches of a scene on a device. */
OzSwitches oz_switches_derive(const OzScene *scene, const OzGrains *grains, const OzDevice *device);
