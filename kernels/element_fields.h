/* THE list of trigrains' device arrays: kind of element, name, number of elements a member, class.
 * Kernel arguments, the kernels' view of memory, the host's buffers and `orzo check`'s memory table
 * are all made of it. A count of 0 means that the scene does not need the array: it is not
 * allocated. z is the OzElementSizes. Kinds: parameters, control, scalar, real (one scalar per
 * lane), integer, ledger (double). Classes: STATE, what the next step depends on; SPRING, the
 * tangential memory of contacts; LIST, neighbour lists that are made again from these two, ROWS
 * those of each region's pairs, which outlive larger capacities; SCRATCH, written before it is read
 * by the host at each launch or by each step. Loads are zero between steps. */
#pragma once

/* Words of a block's state: x, y and angle, each with its scaled derivatives. */
#define OZ_ELEMENT_STATE (3 * OZ_ORDER)

#define OZ_ELEMENT_FIELDS(X)                                                                       \
    X(parameters, parameters, 1, SCRATCH)                                                          \
    X(control, control, 1, STATE)                                                                  \
    X(scalar, motion, OZ_MOVING ? (z.motion_steps + 1) * z.walls *OZ_ELEMENT_MOTION : 0, SCRATCH)  \
    X(real, state, z.blocks *OZ_ELEMENT_STATE, STATE)                                              \
    X(real, shape, z.blocks *OZ_ELEMENT_SHAPE, STATE)                                              \
    X(scalar, record, z.slots *OZ_ELEMENT_RECORD, STATE)                                           \
    X(scalar, load, z.slots *OZ_ELEMENT_LOAD, SCRATCH)                                             \
    X(scalar, slow_load, OZ_SUBSTEPS > 1 ? z.slots * OZ_ELEMENT_LOAD : 0, STATE)                   \
    X(real, reference_inner, z.blocks *OZ_ELEMENT_REFERENCE, LIST)                                 \
    X(real, reference_outer, z.blocks *OZ_ELEMENT_REFERENCE, LIST)                                 \
    X(integer, body, z.slots, STATE)                                                               \
    X(integer, wall, z.slots, STATE)                                                               \
    X(integer, outer_edges, OZ_TRIANGLE_FIELD ? z.slots : 0, LIST)                                 \
    X(integer, cell_of, z.slots, LIST)                                                             \
    X(integer, cell_first, z.cells + 2, LIST)                                                      \
    X(scalar, sorted_x, z.slots + OZ_LANES, LIST)                                                  \
    X(scalar, sorted_y, z.slots + OZ_LANES, LIST)                                                  \
    X(scalar, sorted_far, z.slots + OZ_LANES, LIST)                                                \
    X(integer, sorted_slot, z.slots + OZ_LANES, LIST)                                              \
    X(integer, sorted_body, z.slots + OZ_LANES, LIST)                                              \
    X(integer, outer_a, z.regions *z.outer_capacity, ROWS)                                         \
    X(integer, outer_b, z.regions *z.outer_capacity, ROWS)                                         \
    X(integer, outer_count, z.regions, LIST)                                                       \
    X(integer, pair_a, z.regions *z.inner_capacity, LIST)                                          \
    X(integer, pair_b, z.regions *z.inner_capacity, LIST)                                          \
    X(integer, pair_count, z.regions, LIST)                                                        \
    X(scalar, pair_force, z.regions *z.inner_capacity *OZ_ELEMENT_LOAD, SCRATCH)                   \
    X(integer, touch, z.regions *z.inner_capacity, SCRATCH)                                        \
    X(integer, touch_count, z.regions, SCRATCH)                                                    \
    X(integer, disc_touch, OZ_DISCS ? z.regions *z.inner_capacity : 0, SCRATCH)                    \
    X(integer, pair_hit, OZ_SCATTER ? 0 : z.regions *z.inner_capacity, SCRATCH)                    \
    X(integer, pair_first, OZ_SCATTER ? 0 : z.free_slots, LIST)                                    \
    X(integer, pair_number, OZ_SCATTER ? 0 : z.free_slots, LIST)                                   \
    X(integer, back_number, OZ_SCATTER ? 0 : z.free_slots, LIST)                                   \
    X(integer, back, OZ_SCATTER ? 0 : z.free_slots *z.back_capacity, LIST)                         \
    X(integer, beam_a, z.beam_blocks *OZ_LANES, STATE)                                             \
    X(integer, beam_b, z.beam_blocks *OZ_LANES, STATE)                                             \
    X(real, beam_rest, z.beam_blocks *OZ_BEAM_REST, STATE)                                         \
    X(real, beam_wear, OZ_STRENGTH ? z.beam_blocks *OZ_BEAM_WEAR : 0, STATE)                       \
    X(integer, scar_first, OZ_STRENGTH ? z.free_slots : 0, LIST)                                   \
    X(integer, scar_end, OZ_STRENGTH ? z.free_slots : 0, LIST)                                     \
    X(scalar, scar, OZ_STRENGTH ? z.scars : 0, STATE)                                              \
    X(scalar, beam_force, z.beam_blocks *OZ_LANES *OZ_ELEMENT_LOAD, SCRATCH)                       \
    X(integer, beam_first, OZ_SCATTER ? 0 : z.free_slots + 1, STATE)                               \
    X(integer, beam_of, OZ_SCATTER ? 0 : 2 * z.beam_blocks * OZ_LANES, STATE)                      \
    X(ledger, ledger, OZ_LEDGER ? z.regions *OZ_ELEMENT_LEDGER_WORDS : 0, STATE)                   \
    X(ledger, wall_impulse, OZ_IMPULSES ? z.free_slots *z.walls *OZ_ELEMENT_IMPULSE_WORDS : 0,     \
      STATE)

/* A beam's words: length at rest, and at either end the angle at rest. */
enum { OZ_BEAM_REST = 3 };

/* What strength has made of a beam: 1 while it holds, 0 once broken; the energy lost by that, and
 * by yielding. */
enum { OZ_BW_WHOLE, OZ_BW_LOST, OZ_BW_YIELDED, OZ_BEAM_WEAR };
