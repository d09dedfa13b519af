/* The state at one moment, by grain id: the only bridge from the simulation to everything that
 * looks at it (observables, pictures, files). A snapshot can be written by hand in a test. */
#pragma once

#include "base/state.h"
#include "kernels/ledger_entries.h"
#include "model/contact_list.h"
#include "model/pieces.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

#define OZ_LEDGER_MEMBER(NAME, member, column, meaning) double member;

/* Energies since time 0, J. residual = change of (kinetic + rotational + potential + elastic)
 * + dissipated + friction - work_walls. */
typedef struct OzLedger {
    double elastic; /* stored in springs now */
    OZ_LEDGER_LOSSES(OZ_LEDGER_MEMBER)
    OZ_LEDGER_WORK(OZ_LEDGER_MEMBER)
} OzLedger;

/* trigrains: of all beams at this moment. */
typedef struct OzBeamSums {
    double stretch_min, stretch_max; /* length over length at rest; 1 without beams */
    double bend_max;                 /* rad, largest bending angle of an end         */
    double energy;                   /* J a metre deep: stored                       */
} OzBeamSums;

/* trigrains: energies since time 0, J. residual = change of (translational + rotational + potential
 * + contact + beam) + all losses - work_walls. */
typedef struct OzElementLedger {
    OZ_ELEMENT_LEDGER_LOSSES(OZ_LEDGER_MEMBER)
    OZ_LEDGER_WORK(OZ_LEDGER_MEMBER)
    double beam_broken;  /* stored in beams that broke, which kernels keep by beam */
    double beam_yielded; /* lost in beams that yielded, likewise                 */
} OzElementLedger;

typedef struct OzSnapshot {
    const OzScene *scene;     /* borrowed                                                     */
    const OzGrains *grains;   /* borrowed: geometry, mass, population; not its start state    */
    int64_t step;             /* 0 at the settled bed                                         */
    double time;              /* s                                                            */
    bool settling;            /* walls are as at time 0: none has been taken away             */
    int64_t count;            /* grains->count                                                */
    const OzGrains *whole;    /* borrowed: grains as they were made. Where some have broken, grains
                                 are what is left of them (model/pieces.h), made and owned here     */
    OzGrains *pieces;         /* or NULL                                                      */
    OzWear wear;              /* zeroed where beams hold                                      */
    double *position;         /* 3 x count                                                    */
    double *quaternion;       /* 4 x count, w x y z                                           */
    double *axis;             /* 3 x count, unit                                              */
    double *velocity;         /* 3 x count; in a sheared cell about its flow                   */
    double *angular_velocity; /* 3 x count, world frame                                       */
    double *wall_offset;      /* wall_count: displacement along its motion, or normal, m      */
    double *wall_velocity;    /* wall_count: m/s                                              */
    double *wall_push; /* wall_count: N, of grains on a servo wall in the last step, along its
                          normal: pushed back, below 0; 0 of other walls               */
    bool has_wall_impulse;
    double (*wall_impulse)[6]; /* wall_count: what all grains have pushed each wall with so far,
                                  force times time, N s, and turned it about its point, N m s;
                                  differences alone tell something: where they begin is left open */
    int64_t deep_count; /* contacts beyond guards.overlap.warn so far, each counted once a step */
    bool has_contacts;  /* contacts and beams are filled in                                 */
    OzContactList contacts; /* in the order of ids */
    bool has_ledger;
    OzLedger ledger;
    int64_t element_count;    /* grains->elements->count; 0 and NULL arrays for rods            */
    double *element_position; /* 2 x element_count, walls' elements included, as of what follows  */
    double *element_angle;    /* element_count, rad, not wrapped                                */
    double *element_velocity; /* 2 x element_count                                              */
    double *element_angular_velocity; /* element_count */
    OzBeamSums beams; /* with has_contacts                                                  */
    OzElementLedger element_ledger; /* with has_ledger                                          */
} OzSnapshot;

/* Allocates the arrays for scene and grains; frees with oz_snapshot_free (zeroed is fine). */
OzStatus oz_snapshot_create(OzSnapshot *snapshot, const OzScene *scene, const OzGrains *grains);
void oz_snapshot_free(OzSnapshot *snapshot);

/* A snapshot of its own with the same state, for pictures: without contacts where the scene's
 * pictures show nothing of them. scene and grains stay borrowed. Frees as above. */
OzStatus oz_snapshot_copy(OzSnapshot *copy, const OzSnapshot *snapshot);

/* Where a grain is shown: its position, of a periodic boundary within the cell, while positions are
 * paths that go on. */
void oz_snapshot_place(const OzSnapshot *snapshot, int64_t grain, double place[3]);

/* The scene's periodic cell as it stands now (scene/boundary.h). */
OzBoundary oz_snapshot_cell(const OzSnapshot *snapshot);

/* Makes true places of those in a sheared cell's lattice. */
void oz_snapshot_tilt(OzSnapshot *snapshot);

/* The angle by which a wall has turned, rad; 0 while grains settle. */
double oz_snapshot_turn(const OzSnapshot *snapshot, int wall);

/* Fills wall_offset and wall_velocity for snapshot->time; walls stand still while grains settle. */
void oz_snapshot_move_walls(OzSnapshot *snapshot);

/* Whether a wall is there at the snapshot's time. */
bool oz_snapshot_has_wall(const OzSnapshot *snapshot, int64_t wall);

/* The grains as they were made, also of a snapshot written by hand. */
const OzGrains *oz_snapshot_whole(const OzSnapshot *snapshot);

/* Makes grains those that wear and the elements' positions now say; count follows. What is by grain
 * is to be filled again. */
OzStatus oz_snapshot_split(OzSnapshot *snapshot);

/* Fills position, velocity, spin, quaternion and axis of grains from their elements: centre of
 * mass, its velocity, angular momentum about it over moment of inertia, and the mean turn of the
 * elements.
 */
void oz_snapshot_join_elements(OzSnapshot *snapshot);

/* Fills axis from quaternion. */
void oz_snapshot_turn_axes(OzSnapshot *snapshot);

/* Saves or loads (base/state.h) all but scene, grains and what was found about contacts. The
 * snapshot has been made for scene and grains. */
OzStatus oz_snapshot_state(OzSnapshot *snapshot, OzStateVisit *visit);
