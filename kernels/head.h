/* What the shared structs of every model begin with, so that one driver serves them all. A device
 * kernel writes the sizes of the whole structs at start and the host compares them with its own. */
#pragma once

#include "kernels/units.h"

/* A step or an index that was never met. */
enum { OZ_NEVER = 0x7fffffff };

/* One work-item does a member: it adds a pair's force to both bodies at once. So does one that does
 * a tile of a large scene (OZ_TILES, member.h). Otherwise forces of pairs are kept, and each body
 * gathers its own. */
#define OZ_SCATTER ((OZ_GROUP) == 1 && !(OZ_RESORT))
#define OZ_GATHER  (!(OZ_SCATTER) && !(OZ_TILES))

/* Where a contact is deep, as bits; depths are counted in parts of one such share of their unit. */
enum { OZ_DEEP_PAIR = 1, OZ_DEEP_WALL = 2, OZ_DEEP_SHARE = 1000000 };

/* Where the tangential springs of touching pairs are kept. A rebuild moves them inner -> outer ->
 * saved -> outer -> inner and can be stopped and repeated with larger lists after any of these. A
 * model without them goes the same way with nothing to carry. */
enum { OZ_SPRINGS_AT_NONE, OZ_SPRINGS_AT_SAVED, OZ_SPRINGS_AT_OUTER, OZ_SPRINGS_AT_INNER };

/* Of the parameters: units, for the host alone; the step, s; the drag, 1/s, only while settling. */
#define OZ_PARAMETERS_HEAD                                                                         \
    OzUnits units;                                                                                 \
    scalar dt;                                                                                     \
    scalar drag;

/* Of the parameters too, for the lists. outer_least, outer_most: m, bounds of one body's skin in
 * the outer list; it grows with its speed, to last for outer_time, s; skin_...: the same for the
 * inner list; inverse_cell: 1/m, cells of the hashed grid; reach_max: m, from a body's centre, of
 * the farthest that is in the grid. */
#define OZ_PARAMETERS_LISTS                                                                        \
    scalar outer_least, outer_most, outer_time;                                                    \
    scalar skin_least, skin_most, skin_time;                                                       \
    scalar inverse_cell, reach_max;

/* Of the sizes. slots: bodies rounded up to whole blocks of lanes; blocks: slots / lanes; regions:
 * runs of slots that one work-item looks after, each of region_slots; capacities: pairs of a
 * region's outer and inner list, whole blocks, and pairs of the inner list in which a body is the
 * second, and triangles of a mesh near one; motion_steps: steps of one launch for which walls'
 * motion is given; members: scenes side by side in this launch; axis: of space, in the grid's
 * order: cells along the first follow each other; cells_along: these axes, powers of two: cell
 * coordinates wrap around. */
#define OZ_SIZES_HEAD                                                                              \
    int slots, blocks;                                                                             \
    int regions, region_slots;                                                                     \
    int outer_capacity, inner_capacity, back_capacity, face_capacity;                              \
    int motion_steps;                                                                              \
    int members;                                                                                   \
    int axis[3], cells_along[3], cells;

/* Of the device's own words. Steps count from the start of the launch; an index is a grain's id, of
 * trigrains a element's slot. step: next step to make; moved: its places are moved already (a list
 * was full); full: a list was too small, to be made again with larger ones; needed: the largest
 * that were asked for; stop_bits: the model's reasons to stop, stop_step: first step that stopped
 * (OZ_NEVER), stop_index: the lowest in that step (OZ_NEVER); refreshes, rebuilds: since the start
 * of the run; crossed: contacts without a normal (shafts crossing) met so far; deep_count: deep
 * contacts of this launch, each counted once a step, deep_step: first step with one (OZ_NEVER),
 * deep_index: the lowest in it, a pair's first (OZ_NEVER), deep_depth: the greatest depth in it, in
 * OZ_DEEP_SHARE of its unit, deep_kinds: OZ_DEEP_... in it, 0 where the model does not tell;
 * stale_step: the step after which lists no longer hold; stale_positions: the step whose places,
 * moved before its forces, the lists do not hold, in large scenes alone: others renew them in time
 * (both OZ_NEVER: lists hold); front: with tiles, the half of the records that holds step 0
 * (work.h); truth: where the tangential springs are now, and so how far the lists are made,
 * OZ_SPRINGS_AT_...; outer_stale: the outer list no longer covers the inner skin. */
#define OZ_CONTROL_HEAD                                                                            \
    int step, moved, full;                                                                         \
    int outer_needed, inner_needed, back_needed, faces_needed;                                     \
    int stop_bits, stop_step, stop_index;                                                          \
    int refreshes, rebuilds, crossed;                                                              \
    int deep_count, deep_step, deep_index, deep_depth, deep_kinds;                                 \
    int stale_step, stale_positions, front, truth, outer_stale;

#ifdef OZ_HOST
/* The driver's view of them. */
typedef struct __attribute__((may_alias)) OzParametersHead {
    OZ_PARAMETERS_HEAD
} OzParametersHead;

typedef struct __attribute__((may_alias)) OzSizesHead {
    OZ_SIZES_HEAD
} OzSizesHead;

typedef struct __attribute__((may_alias)) OzControlHead {
    OZ_CONTROL_HEAD
} OzControlHead;
#endif
