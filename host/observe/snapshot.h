/* The state at one moment, by grain id: the only bridge from the simulation to everything that looks
 * at it (observables, pictures, files). A snapshot can be written by hand in a test. */
#ifndef OZ_OBSERVE_SNAPSHOT_H
#define OZ_OBSERVE_SNAPSHOT_H

#include "base/status.h"
#include "model/grains.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

/* Sums over all contacts at this moment, grain-grain pairs and walls apart. */
typedef struct OzContactSums {
    int64_t pair_count;  /* touching pairs of grains                      */
    int64_t wall_count;  /* touching ends at walls                        */
    double overlap_max;  /* m, over pairs and walls                       */
    double overlap_sum;  /* m, over pairs and walls                       */
} OzContactSums;

/* Energies since time 0, J. residual = change of (kinetic + rotational + potential + elastic)
 * + dissipated + friction - work_walls. */
typedef struct OzLedger {
    double elastic;    /* stored in springs now                        */
    double dissipated; /* by dashpots, since time 0                    */
    double friction;   /* by sliding, since time 0                     */
    double work_walls; /* put in by moving walls, since time 0         */
} OzLedger;

typedef struct OzSnapshot {
    const OzScene *scene;   /* borrowed                                                     */
    const OzGrains *grains; /* borrowed: geometry, mass, population; not its start state    */
    int64_t step;           /* 0 at the settled bed                                         */
    double time;            /* s                                                            */
    int64_t count;          /* grains->count                                                */
    double *position;       /* 3 x count                                                    */
    double *quaternion;     /* 4 x count, w x y z                                           */
    double *axis;           /* 3 x count, unit                                              */
    double *velocity;       /* 3 x count                                                    */
    double *spin;           /* 3 x count, world frame                                       */
    double *wall_offset;    /* wall_count: displacement along z now, m                      */
    double *wall_velocity;  /* wall_count: m/s                                              */
    bool has_contacts;      /* contacts is filled in                                        */
    OzContactSums contacts;
    bool has_ledger;
    OzLedger ledger;
} OzSnapshot;

/* Allocates the arrays for scene and grains; frees with oz_snapshot_free (zeroed is fine). */
OzStatus oz_snapshot_create(OzSnapshot *snapshot, const OzScene *scene, const OzGrains *grains);
void oz_snapshot_free(OzSnapshot *snapshot);

/* Fills wall_offset and wall_velocity for snapshot->time. */
void oz_snapshot_move_walls(OzSnapshot *snapshot);

/* Fills axis from quaternion. */
void oz_snapshot_turn_axes(OzSnapshot *snapshot);

#endif
