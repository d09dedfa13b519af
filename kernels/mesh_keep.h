/* What grains' slots at meshes keep of their touches from step to step. OpenCL C only. */
#pragma once

#include "kernels/enclosure_side.h"
#include "kernels/mesh_touch.h"

#if OZ_MESHES > 0

/* Word `word` of a slot of a grain at a mesh, in an array of so many words a slot. */
OZ_INLINE size_t oz_mesh_keep_at(int grain, int mesh, int slot, int words, int word)
{
    int place = (mesh * OZ_MESH_SLOTS + slot) * words + word;
    return oz_lanes_at(grain, OZ_MESHES * OZ_MESH_SLOTS * words, place);
}

/* Springs, of one kind, go where their touches go on; those of slots not in use become 0. first:
 * the mesh's first slot among all ends.
 */
OZ_INLINE void oz_mesh_keep_hand(global scalar *history, int grain, int first, const int *spring_to)
{
    for (int c = 0; c < 3; c++) {
        scalar kept[OZ_MESH_SLOTS];
        for (int k = 0; k < OZ_MESH_SLOTS; k++) {
            kept[k] = 0;
        }
        for (int k = 0; k < OZ_MESH_SLOTS; k++) {
            size_t at = oz_lanes_at(grain, 3 * OZ_WALL_ENDS, 3 * (first + k) + c);
            if (spring_to[k] >= 0) {
                kept[spring_to[k]] += history[at];
            }
        }
        for (int k = 0; k < OZ_MESH_SLOTS; k++) {
            history[oz_lanes_at(grain, 3 * OZ_WALL_ENDS, 3 * (first + k) + c)] = kept[k];
        }
    }
}

OZ_INLINE void oz_mesh_keep_hand_over(OzWork *w, int grain, int first, const int *spring_to)
{
#if OZ_HISTORY
    oz_mesh_keep_hand((global scalar *)w->wall_history, grain, first, spring_to);
#endif
#if OZ_ROLLING_SPRING
    oz_mesh_keep_hand((global scalar *)w->wall_rolling, grain, first, spring_to);
#endif
}

/* Words from `word` on of what a grain's slots remember, of those of `held`, a bit each. */
OZ_INLINE void oz_mesh_keep_load(const OzWork *w, int grain, int mesh, int held, int word, int end,
                                 scalar *memory)
{
    global const scalar *kept = (global const scalar *)w->mesh_memory;
    for (int k = 0; held >> k != 0; k++) {
        for (int c = word; (held >> k & 1) && c < end; c++) {
            memory[OZ_MESH_MEMORY * k + c] =
                kept[oz_mesh_keep_at(grain, mesh, k, OZ_MESH_MEMORY, c)];
        }
    }
}

/* held, used: slots in use before and now, a bit each; those that are free now forget their keys
 * alone. */
OZ_INLINE void oz_mesh_keep_store(OzWork *w, int grain, int mesh, const scalar *memory, int held,
                                  int used)
{
    global scalar *kept = (global scalar *)w->mesh_memory;
    for (int k = 0; (held | used) >> k != 0; k++) {
        int words = used >> k & 1 ? OZ_MESH_MEMORY : held >> k & 1 ? OZ_MESH_M_KEY + 1 : 0;
        for (int c = 0; c < words; c++) {
            kept[oz_mesh_keep_at(grain, mesh, k, OZ_MESH_MEMORY, c)] =
                memory[OZ_MESH_MEMORY * k + c];
        }
    }
}

/* Where the grain touches in a slot, with the mesh as it is now. */
OZ_INLINE void oz_mesh_keep_touch(OzWork *w, int grain, int mesh, int slot, const OzSide *side,
                                  OzMeshTouch touch)
{
    global scalar *found = (global scalar *)w->mesh_touch;
#if OZ_SWUNG
    oz_wall_swing_turn(side->swing.frame, touch.normal);
#endif
    scalar words[OZ_MESH_TOUCH] = {touch.place,     touch.normal[0], touch.normal[1],
                                   touch.normal[2], touch.distance,  touch.push};
    for (int k = 0; k < OZ_MESH_TOUCH; k++) {
        found[oz_mesh_keep_at(grain, mesh, slot, OZ_MESH_TOUCH, k)] = words[k];
    }
}

/* The touches of a grain to its slots, which remember them as the mesh was built; answers which are
 * in use, a bit each. held: those that may have been before. */
OZ_INLINE int oz_mesh_keep(OzWork *w, int grain, int mesh, const OzSide *side,
                           const OzMeshTouches *touches, int held)
{
    scalar memory[OZ_MESH_SLOTS * OZ_MESH_MEMORY];
    int slot_of[OZ_MESH_SLOTS], spring_to[OZ_MESH_SLOTS], used = 0;
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        memory[OZ_MESH_MEMORY * k + OZ_MESH_M_KEY] = 0;
    }
    oz_mesh_keep_load(w, grain, mesh, held, OZ_MESH_M_KEY, OZ_MESH_M_KEY + 1, memory);
    int stay = oz_mesh_stay(touches, memory, slot_of, spring_to);
    if (!stay) {
        oz_mesh_keep_load(w, grain, mesh, held, OZ_MESH_M_KEY + 1, OZ_MESH_MEMORY, memory);
        oz_mesh_go_over(touches, memory, slot_of, spring_to);
    }
    oz_mesh_settle(touches, memory, slot_of);
    for (int i = 0; i < touches->count; i++) {
        oz_mesh_keep_touch(w, grain, mesh, slot_of[i], side, touches->at[i]);
        stay = stay && spring_to[slot_of[i]] == slot_of[i];
        used |= 1 << slot_of[i];
    }
    oz_mesh_keep_store(w, grain, mesh, memory, held, used);
    if (!stay) {
        oz_mesh_keep_hand_over(w, grain, side->index, spring_to);
    }
    return used;
}

#endif
