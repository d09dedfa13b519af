/* THE list of device arrays: kind of element, name, number of elements a member, class. Kernel
 * arguments, the kernels' view of memory, the host's buffers and `orzo check`'s memory table are
 * all made of it. A count of 0 means that the scene does not need the array: it is not allocated. z
 * is the OzSizes. Kinds: parameters, control, scalar, real (one scalar per lane), spot (one
 * coordinate of a place), integer, ledger (double, a sum of what has happened), wide (double).
 * Classes: STATE, what the next step depends on; SPRING, the tangential memory of contacts; LIST,
 * neighbour lists that are made again from these two, ROWS those of each region's pairs, which
 * outlive larger capacities; SCRATCH, written before it is read by the host at each launch or by
 * each step. Springs of pairs outlive the lists in the saved_ arrays alone, where oz_save_springs
 * puts them (springs.h); others are LIST. */
#pragma once

#include "kernels/ledger_entries.h"

/* What of a grain may touch walls: its ends, points of its shaft at walls with edges, and slots for
 * touches of meshes. */
#define OZ_WALL_ENDS                                                                               \
    ((OZ_ROUND ? 1 : 2) * OZ_WALL_COUNT + (OZ_ROUND ? 0 : 2 * OZ_WALL_EDGED) +                     \
     OZ_MESH_SLOTS * OZ_MESHES)

/* What is remembered of a grain's touches of meshes. */
#define OZ_MESH_WORDS (OZ_MESHES * OZ_MESH_SLOTS * OZ_MESH_MEMORY)

/* The ledger has a grain's sums of energy, J, by id, of contacts in which it is the first; this is
 * a contact's words for them (see ledger.h). */
enum { OZ_CONTACT_LEDGER = 16 };

/* Grains, by id, whose pushes on a servo wall are added up in one run. */
enum { OZ_SERVO_RUN = 64 };

/* What it has beside that of couples: the dashpots', the rotation, with OZ_ROLLING the springs'. */
#define OZ_COUPLE_LEDGER (OZ_ROLLING ? 9 : 6)

/* A slot's words in the spare array, where a re-sort puts grains in their new order. */
#define OZ_SPARE                                                                                   \
    (OZ_STATE + OZ_SHAPE + (OZ_ROLLING_SPRING ? 6 : 3) * OZ_WALL_ENDS + OZ_MESH_WORDS + 1)

#define OZ_FIELDS(X)                                                                               \
    X(parameters, parameters, 1, SCRATCH)                                                          \
    X(control, control, 1, STATE)                                                                  \
    X(scalar, motion, OZ_MOVING ? (z.motion_steps + 1) * OZ_MOTION *OZ_WALL_COUNT : 0, SCRATCH)    \
    X(scalar, swing, OZ_SWUNG ? (z.motion_steps + 1) * OZ_SWING *OZ_WALL_COUNT : 0, SCRATCH)       \
    X(scalar, law_table,                                                                           \
      OZ_MATERIALS > 1 ? OZ_MATERIALS * (OZ_MATERIALS + OZ_WALL_COUNT) * OZ_LAW_ROW : 0, SCRATCH)  \
    X(integer, material, OZ_MATERIALS > 1 ? z.slots : 0, SCRATCH)                                  \
    X(scalar, shear, OZ_SHEAR ? (z.motion_steps + 1) * OZ_SHEAR_WORDS : 0, SCRATCH)                \
    X(real, state, z.blocks *OZ_STATE, STATE)                                                      \
    X(real, shape, OZ_EQUAL ? 0 : z.blocks *OZ_SHAPE, STATE)                                       \
    X(real, wall_history, OZ_HISTORY ? z.blocks *OZ_WALL_ENDS * 3 : 0, SPRING)                     \
    X(real, wall_rolling, OZ_ROLLING_SPRING ? z.blocks *OZ_WALL_ENDS * 3 : 0, SPRING)              \
    X(integer, wall_active, z.blocks *OZ_WALL_ENDS, SPRING)                                        \
    X(real, wall_relief, OZ_ROUND || OZ_WALL_EDGED == 0 ? 0 : z.blocks * 2, SCRATCH)               \
    X(scalar, mesh_grid, OZ_MESHES *OZ_MESH_GRID, SCRATCH)                                         \
    X(scalar, mesh_record, OZ_MESH_RECORD *z.mesh_faces, SCRATCH)                                  \
    X(integer, mesh_first, z.mesh_cells, SCRATCH)                                                  \
    X(integer, mesh_face, z.mesh_items, SCRATCH)                                                   \
    X(real, mesh_list, OZ_MESHES *OZ_MESH_LIST *z.blocks, LIST)                                    \
    X(scalar, mesh_slack, OZ_MESHES *z.face_capacity *z.slots, LIST)                               \
    X(integer, mesh_near, OZ_MESHES *z.face_capacity *z.slots, LIST)                               \
    X(real, mesh_touch, OZ_MESHES *OZ_MESH_SLOTS *OZ_MESH_TOUCH *z.blocks, SCRATCH)                \
    X(real, mesh_memory, OZ_MESH_WORDS *z.blocks, SPRING)                                          \
    X(scalar, record, (z.slots + 1) * OZ_RECORD * (OZ_TILES ? 2 : 1), STATE)                       \
    X(scalar, fine, OZ_FINE ? (z.slots + 1) * OZ_FINE_RECORD *(OZ_TILES ? 2 : 1) : 0, STATE)       \
    X(real, reference_inner, z.blocks *OZ_REFERENCE, LIST)                                         \
    X(real, reference_outer, z.blocks *OZ_REFERENCE, LIST)                                         \
    X(integer, id, z.slots, STATE)                                                                 \
    X(integer, image, OZ_PERIODIC ? 3 * z.slots : 0, STATE)                                        \
    X(integer, slot_of, z.slots, STATE)                                                            \
    X(integer, cell_of, z.slots, LIST)                                                             \
    X(integer, cell_first, z.cells + 2, LIST)                                                      \
    X(integer, cell_slot, OZ_TILES ? z.cells : 0, LIST)                                            \
    X(fixed_position, sorted_x, z.slots + OZ_LANES, LIST)                                          \
    X(fixed_position, sorted_y, z.slots + OZ_LANES, LIST)                                          \
    X(fixed_position, sorted_z, z.slots + OZ_LANES, LIST)                                          \
    X(scalar, sorted_reach, OZ_EQUAL ? 0 : z.slots + OZ_LANES, LIST)                               \
    X(integer, sorted_slot, z.slots + OZ_LANES, LIST)                                              \
    X(integer, sorted_id, z.slots + OZ_LANES, LIST)                                                \
    X(scalar, sorted_far, z.slots + OZ_LANES, LIST)                                                \
    X(integer, outer_a, z.regions *z.outer_capacity, ROWS)                                         \
    X(integer, outer_b, z.regions *z.outer_capacity, ROWS)                                         \
    X(scalar, outer_history, OZ_HISTORY ? z.regions *z.outer_capacity * 3 : 0, ROWS)               \
    X(scalar, outer_rolling, OZ_ROLLING_SPRING ? z.regions *z.outer_capacity * 3 : 0, ROWS)        \
    X(integer, outer_count, z.regions, LIST)                                                       \
    X(integer, outer_first, OZ_HISTORY && !OZ_TILES ? z.slots : 0, LIST)                           \
    X(integer, outer_number, OZ_HISTORY && !OZ_TILES ? z.slots : 0, LIST)                          \
    X(integer, pair_a, z.regions *z.inner_capacity, LIST)                                          \
    X(integer, pair_b, z.regions *z.inner_capacity, LIST)                                          \
    X(integer, pair_outer, OZ_HISTORY ? z.regions *z.inner_capacity : 0, LIST)                     \
    X(scalar, pair_history, OZ_HISTORY ? z.regions *z.inner_capacity *OZ_SPRING : 0, LIST)         \
    X(scalar, pair_rolling, OZ_ROLLING_SPRING ? z.regions *z.inner_capacity *OZ_SPRING : 0, LIST)  \
    X(scalar, load, (z.slots + (OZ_TILES ? 2 * z.regions : 0)) * OZ_LOAD, SCRATCH)                 \
    X(scalar, pair_force, OZ_GATHER ? (z.regions * z.inner_capacity + 1) * OZ_PAIR_FORCE : 0,      \
      SCRATCH)                                                                                     \
    X(scalar, pair_torque, OZ_GATHER ? (z.regions * z.inner_capacity + 1) * OZ_PAIR_TORQUE : 0,    \
      SCRATCH)                                                                                     \
    X(integer, pair_active, z.regions *z.inner_capacity / OZ_LANES, LIST)                          \
    X(integer, pair_kept, OZ_GATHER ? z.regions *z.inner_capacity / OZ_LANES : 0, SCRATCH)         \
    X(integer, pair_count, z.regions, LIST)                                                        \
    X(integer, pair_first, OZ_GATHER ? z.slots : 0, LIST)                                          \
    X(integer, pair_number, OZ_GATHER ? z.slots : 0, LIST)                                         \
    X(integer, back_number, OZ_GATHER ? z.slots : 0, LIST)                                         \
    X(integer, back_before, OZ_GATHER && !OZ_EQUAL ? z.slots : 0, LIST)                            \
    X(integer, back, OZ_GATHER ? z.slots *z.back_capacity : 0, LIST)                               \
    X(integer, saved_a, OZ_HISTORY ? z.regions *z.inner_capacity : 0, SPRING)                      \
    X(integer, saved_b, OZ_HISTORY ? z.regions *z.inner_capacity : 0, SPRING)                      \
    X(scalar, saved_history, OZ_HISTORY ? z.regions *z.inner_capacity * 3 : 0, SPRING)             \
    X(scalar, saved_rolling, OZ_ROLLING_SPRING ? z.regions *z.inner_capacity * 3 : 0, SPRING)      \
    X(integer, saved_count, OZ_HISTORY ? z.regions : 0, SPRING)                                    \
    X(ledger, ledger, OZ_LEDGER ? z.slots *OZ_LEDGER_WORDS : 0, STATE)                             \
    X(real, pair_ledger,                                                                           \
      OZ_LEDGER ? z.regions *z.inner_capacity / OZ_LANES *OZ_CONTACT_LEDGER : 0, SCRATCH)          \
    X(real, pair_couple,                                                                           \
      OZ_LEDGER &(OZ_LINE | OZ_ROLLING) ? z.regions *z.inner_capacity / OZ_LANES *OZ_COUPLE_LEDGER \
                                        : 0,                                                       \
      SCRATCH)                                                                                     \
    X(real, wall_couple, OZ_LEDGER &OZ_ROLLING ? z.blocks *OZ_WALL_ENDS *OZ_COUPLE_LEDGER : 0,     \
      SCRATCH)                                                                                     \
    X(real, wall_ledger, OZ_LEDGER ? z.blocks *OZ_WALL_ENDS *OZ_CONTACT_LEDGER : 0, SCRATCH)       \
    X(ledger, wall_impulse, OZ_IMPULSES ? z.slots *OZ_WALL_COUNT *OZ_IMPULSE_WORDS : 0, STATE)     \
    X(wide, servo, OZ_SERVOS *OZ_SERVO, STATE)                                                     \
    X(wide, servo_push, OZ_SERVOS *z.slots, SCRATCH)                                               \
    X(wide, servo_run, OZ_SERVOS *(z.slots / OZ_SERVO_RUN + 1), SCRATCH)                           \
    X(integer, servo_held, OZ_SERVOS > 0, SCRATCH)                                                 \
    X(scalar, push, OZ_PUSHED ? z.slots *OZ_LOAD : 0, STATE)                                       \
    X(scalar, spare, OZ_RESORT ? z.slots *OZ_SPARE : 0, SCRATCH)
