/* The touches of one grain with one mesh: their pushes, and the slots in which their tangential
 * springs are kept. What a slot remembers of its last touch says which one goes on with its spring:
 * that of the same triangle, or the one into which it has gone over where triangles join. All is
 * scalar. */
#ifndef OZ_KERNELS_MESH_TOUCH_H
#define OZ_KERNELS_MESH_TOUCH_H

#include "kernels/mesh.h"

/* A touch goes on in another one with at least this cosine between both normals, at most so far
 * along the shaft, in half shafts: a step turns no grain further around an edge. */
#define OZ_MESH_ALIKE 0.5
#define OZ_MESH_ASIDE 0.5

/* Rounds until the touches are found: one each, and some for those that are left again. */
enum { OZ_MESH_ROUNDS = 4 * OZ_MESH_SLOTS };

OZ_INLINE void oz_mesh_begin(OzMeshTouches *touches, scalar radius)
{
    touches->count = 0;
    touches->radius = radius;
    touches->tip = touches->tail = 0;
}

/* How much of the one's push takes away of the other's overlap. */
OZ_INLINE scalar oz_mesh_touch_reach(const OzMeshTouch *a, const OzMeshTouch *b)
{
    scalar apart = a->place - b->place, both = 0;
    for (int k = 0; k < 3; k++) {
        both += a->normal[k] * b->normal[k];
    }
    apart = apart < 0 ? -apart : apart;
    return both > 0 ? both * (1 - apart / 2) : 0;
}

/* What all pushes leave of the overlap of a place that a triangle offers, m; 0: nothing that
 * counts.
 */
OZ_INLINE scalar oz_mesh_left(const OzMeshTouches *touches, const OzMeshTouch *offer)
{
    scalar overlap = touches->radius - offer->distance, left = overlap;
    for (int k = 0; k < touches->count; k++) {
        left -= touches->at[k].push * oz_mesh_touch_reach(offer, &touches->at[k]);
    }
    return left > (scalar)OZ_MESH_SHARE * overlap ? left : 0;
}

/* The pushes with which every overlap is taken away: Gauss's elimination; K has ones along its
 * diagonal and is positive definite, touches that another one does for not being in it. */
OZ_INLINE void oz_mesh_solve(OzMeshTouches *touches)
{
    scalar rows[OZ_MESH_SLOTS][OZ_MESH_SLOTS + 1];
    int count = touches->count;
    if (count == 1) {
        OzMeshTouch *only = &touches->at[0];
        only->push = (touches->radius - only->distance) / oz_mesh_touch_reach(only, only);
        return;
    }
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            rows[i][j] = oz_mesh_touch_reach(&touches->at[i], &touches->at[j]);
        }
        rows[i][count] = touches->radius - touches->at[i].distance;
    }
    for (int k = 0; k < count; k++) {
        for (int i = k + 1; i < count; i++) {
            scalar share = rows[i][k] / rows[k][k];
            for (int j = k; j <= count; j++) {
                rows[i][j] -= share * rows[k][j];
            }
        }
    }
    for (int k = count - 1; k >= 0; k--) {
        scalar push = rows[k][count];
        for (int j = k + 1; j < count; j++) {
            push -= rows[k][j] * touches->at[j].push;
        }
        touches->at[k].push = push / rows[k][k];
    }
}

/* Adds a touch and fits all pushes; leaves out those that would pull. 0: there was no room. */
OZ_INLINE int oz_mesh_add(OzMeshTouches *touches, OzMeshTouch touch)
{
    if (touches->count == OZ_MESH_SLOTS) {
        return 0;
    }
    touches->at[touches->count++] = touch;
    for (;;) {
        int worst = 0;
        oz_mesh_solve(touches);
        for (int k = 1; k < touches->count; k++) {
            worst = touches->at[k].push < touches->at[worst].push ? k : worst;
        }
        if (touches->count < 2 || touches->at[worst].push > 0) {
            return 1;
        }
        touches->at[worst] = touches->at[--touches->count];
    }
}

/* Notes the ends' largest overlaps, when the ends have been looked at. */
OZ_INLINE void oz_mesh_note_ends(OzMeshTouches *touches)
{
    for (int k = 0; k < touches->count; k++) {
        scalar overlap = touches->radius - touches->at[k].distance;
        scalar *most = touches->at[k].place > 0 ? &touches->tip : &touches->tail;
        *most = overlap > *most ? overlap : *most;
    }
}

/* How alike a slot's last touch and one of now are: the cosine of their normals; 0: they are not.
 */
OZ_INLINE scalar oz_mesh_alike(const scalar *slot, const OzMeshTouch *touch)
{
    scalar aside = slot[OZ_MESH_M_PLACE] - touch->place, both = 0;
    for (int k = 0; k < 3; k++) {
        both += slot[OZ_MESH_M_NORMAL + k] * touch->normal[k];
    }
    aside = aside < 0 ? -aside : aside;
    return both > (scalar)OZ_MESH_ALIKE && aside < (scalar)OZ_MESH_ASIDE ? both : 0;
}

/* The touch of a list that is most alike to a slot's last one; -1: none. placed: among those that
 * have a slot, else among the others. */
OZ_INLINE int oz_mesh_heir(const OzMeshTouches *touches, const scalar *slot, const int *slot_of,
                           int placed)
{
    int best = -1;
    scalar most = 0;
    for (int i = 0; i < touches->count; i++) {
        scalar alike = oz_mesh_alike(slot, &touches->at[i]);
        if ((slot_of[i] >= 0) == placed && alike > most) {
            most = alike;
            best = i;
        }
    }
    return best;
}

/* Touches of the same triangles as before stay in their slots, whose keys alone are looked at.
 * Answers whether none held another touch that has ended or gone over. */
OZ_INLINE int oz_mesh_stay(const OzMeshTouches *touches, const scalar *memory, int *slot_of,
                           int *spring_to)
{
    int stay = 1;
    for (int i = 0; i < touches->count; i++) {
        slot_of[i] = -1;
    }
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        scalar key = memory[OZ_MESH_MEMORY * k + OZ_MESH_M_KEY];
        spring_to[k] = -1;
        for (int i = 0; key > 0 && i < touches->count; i++) {
            if (touches->at[i].key == key) {
                slot_of[i] = spring_to[k] = k;
            }
        }
        stay = stay && (spring_to[k] == k || !(key > 0));
    }
    return stay;
}

/* What others held goes over to touches that have no slot, then to those that have one. */
OZ_INLINE void oz_mesh_go_over(const OzMeshTouches *touches, const scalar *memory, int *slot_of,
                               int *spring_to)
{
    for (int placed = 0; placed < 2; placed++) {
        for (int k = 0; k < OZ_MESH_SLOTS; k++) {
            const scalar *slot = memory + OZ_MESH_MEMORY * k;
            int seeks = spring_to[k] < 0 && slot[OZ_MESH_M_KEY] > 0;
            int heir = seeks ? oz_mesh_heir(touches, slot, slot_of, placed) : -1;
            if (heir >= 0) {
                slot_of[heir] = placed ? slot_of[heir] : k;
                spring_to[k] = slot_of[heir];
            }
        }
    }
}

/* The first slot that no touch has. */
OZ_INLINE int oz_mesh_empty(const int *slot_of, int count)
{
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        int is_taken = 0;
        for (int i = 0; i < count; i++) {
            is_taken = is_taken || slot_of[i] == k;
        }
        if (!is_taken) {
            return k;
        }
    }
    return 0;
}

/* Gives slots to touches that have none, and notes all in memory: OZ_MESH_MEMORY words a slot. */
OZ_INLINE void oz_mesh_settle(const OzMeshTouches *touches, scalar *memory, int *slot_of)
{
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        memory[OZ_MESH_MEMORY * k + OZ_MESH_M_KEY] = 0;
    }
    for (int i = 0; i < touches->count; i++) {
        slot_of[i] = slot_of[i] < 0 ? oz_mesh_empty(slot_of, touches->count) : slot_of[i];
        scalar *slot = memory + OZ_MESH_MEMORY * slot_of[i];
        slot[OZ_MESH_M_KEY] = touches->at[i].key;
        slot[OZ_MESH_M_PLACE] = touches->at[i].place;
        for (int k = 0; k < 3; k++) {
            slot[OZ_MESH_M_NORMAL + k] = touches->at[i].normal[k];
        }
    }
}

/* The slot of each touch, and of each slot where its spring goes: itself while its touch goes on;
 * the slot of a touch that takes over what it held, besides its own; -1: its touch has ended.
 * memory becomes that of now. */
OZ_INLINE void oz_mesh_place(const OzMeshTouches *touches, scalar *memory, int *slot_of,
                             int *spring_to)
{
    if (!oz_mesh_stay(touches, memory, slot_of, spring_to)) {
        oz_mesh_go_over(touches, memory, slot_of, spring_to);
    }
    oz_mesh_settle(touches, memory, slot_of);
}

#endif
