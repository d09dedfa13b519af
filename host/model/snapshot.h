/* The state at one moment, by grain id: the only bridge from the simulation to everything that
 * looks at it (observables, pictures, files). A snapshot can be written by hand in a test. */
#ifndef OZ_MODEL_SNAPSHOT_H
#define OZ_MODEL_SNAPSHOT_H

#include "base/state.h"
#include "model/grains.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

/* Sums over all contacts at this moment, grain-grain pairs and walls apart. */
typedef struct OzContactSums {
    int64_t pair_count; /* touching pairs of grains                      */
    int64_t wall_count; /* touching ends at walls                        */
    double overlap_max; /* m, over pairs and walls                       */
    double overlap_sum; /* m, over pairs and walls                       */
} OzContactSums;

/* Energies since time 0, J. residual = change of (kinetic + rotational + potential + elastic)
 * + dissipated + friction - work_walls. */
typedef struct OzLedger {
    double elastic;    /* stored in springs now                        */
    double dissipated; /* by dashpots, since time 0                    */
    double friction;   /* by sliding, since time 0                     */
    double work_walls; /* put in by moving walls, since time 0         */
} OzLedger;

/* trigrains: kinds of contact (Poeschel and Buchholtz 1995, section 3, and physics' sixth), discs
 * apart. */
typedef enum OzTouchKind {
    OZ_TOUCH_I,    /* two crossings on one edge of one triangle                     */
    OZ_TOUCH_II,   /* two crossings on different edges of both                      */
    OZ_TOUCH_III,  /* four crossings, two on each of two edges of both              */
    OZ_TOUCH_IV,   /* four crossings, one triangle cut on all three edges           */
    OZ_TOUCH_V,    /* six crossings                                                 */
    OZ_TOUCH_VI,   /* four crossings, both triangles cut on all three edges         */
    OZ_TOUCH_DISC, /* one or two discs                                              */
    OZ_TOUCH_KINDS
} OzTouchKind;

/* trigrains: sums over all elements, contacts and beams at this moment. */
typedef struct OzElementSums {
    int64_t touches[OZ_TOUCH_KINDS]; /* contacts of each kind, walls included            */
    int64_t grain_pairs;             /* pairs of grains that touch                       */
    int64_t wall_touches;            /* contacts with walls                              */
    double overlap_sum, overlap_max; /* m^2; of triangles                                */
    double stretch_min, stretch_max; /* beams' length over their length at rest; 1 without beams */
    double bend_max;                 /* rad, largest bending angle of a beam's end       */
    double contact_energy;           /* J a metre deep: stored in overlaps               */
    double beam_energy;              /* J: stored in beams                               */
} OzElementSums;

/* trigrains: energies since time 0, J. residual = change of (translational + rotational + potential
 * + contact + beam) + beam_axial + beam_bending + disc_damping + disc_friction - work_walls. */
typedef struct OzElementLedger {
    double beam_axial;    /* dissipated by beams along their axes  */
    double beam_bending;  /* dissipated by beams' bending          */
    double disc_damping;  /* dissipated by discs, normal           */
    double disc_friction; /* dissipated by discs, tangential       */
    double work_walls;    /* put in by moving walls                */
} OzElementLedger;

typedef struct OzSnapshot {
    const OzScene *scene;     /* borrowed                                                     */
    const OzGrains *grains;   /* borrowed: geometry, mass, population; not its start state    */
    int64_t step;             /* 0 at the settled bed                                         */
    double time;              /* s                                                            */
    int64_t count;            /* grains->count                                                */
    double *position;         /* 3 x count                                                    */
    double *quaternion;       /* 4 x count, w x y z                                           */
    double *axis;             /* 3 x count, unit                                              */
    double *velocity;         /* 3 x count                                                    */
    double *angular_velocity; /* 3 x count, world frame                                       */
    double *wall_offset;      /* wall_count: displacement along z now, m                      */
    double *wall_velocity;    /* wall_count: m/s                                              */
    int64_t deep_count; /* contacts beyond guards.overlap.warn so far, each counted once a step */
    bool has_contacts;  /* contacts is filled in                                        */
    OzContactSums contacts;
    bool has_ledger;
    OzLedger ledger;
    int64_t element_count;    /* grains->elements->count; 0 and NULL arrays for rods            */
    double *element_position; /* 2 x element_count, walls' elements included, as of what follows  */
    double *element_angle;    /* element_count, rad, not wrapped                                */
    double *element_velocity; /* 2 x element_count                                              */
    double *element_angular_velocity; /* element_count */
    OzElementSums elements; /* with has_contacts                                            */
    OzElementLedger element_ledger; /* with has_ledger                                          */
} OzSnapshot;

/* Allocates the arrays for scene and grains; frees with oz_snapshot_free (zeroed is fine). */
OzStatus oz_snapshot_create(OzSnapshot *snapshot, const OzScene *scene, const OzGrains *grains);
void oz_snapshot_free(OzSnapshot *snapshot);

/* A snapshot of its own with the same state; scene and grains stay borrowed. Frees as above. */
OzStatus oz_snapshot_copy(OzSnapshot *copy, const OzSnapshot *snapshot);

/* Fills wall_offset and wall_velocity for snapshot->time. */
void oz_snapshot_move_walls(OzSnapshot *snapshot);

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

#endif
