/* Finds where the grains of a block touch meshes: one grain after the other, a block of triangles
 * at a time, from the list of all that may reach the grain's cell. OpenCL C only. */
#pragma once

#include "kernels/enclosure_side.h"
#include "kernels/mesh_touch.h"

#if OZ_MESHES > 0

/* Triangles that are kept at hand of those in a grain's list; where more may be touched, all are
 * looked at each time. */
enum { OZ_MESH_NEAR = 256 };

/* One grain and the triangles before it. */
typedef struct OzMeshView {
    int item, end; /* in mesh_face                                        */
    int corner;    /* the mesh's first triangle                           */
    int two_sided;
    fixed_position_kind place[3];
    scalar shift[3]; /* m, by which the mesh has moved                      */
    scalar half_shaft[3], radius;
} OzMeshView;

/* A block of triangles. */
OZ_INLINE OzMeshFace oz_mesh_find_load(const OzWork *w, const OzMeshView *view, const int *faces)
{
    real a[4], b[4], c[4];
    scalar key[OZ_LANES];
    int at[OZ_LANES];
    OzFixedPosition corner, place;
    OzMeshFace found;
    for (int l = 0; l < OZ_LANES; l++) {
        at[l] = view->corner + faces[l];
        key[l] = OZ_MESH_KEY(faces[l], 0);
    }
    oz_lanes_load4(w->mesh_record, at, OZ_MESH_RECORD, OZ_MESH_R_CORNER, a);
    oz_lanes_load4(w->mesh_record, at, OZ_MESH_RECORD, OZ_MESH_R_ONE, b);
    oz_lanes_load4(w->mesh_record, at, OZ_MESH_RECORD, OZ_MESH_R_OTHER + 1, c);
    corner.x = oz_fixed_position_of_bits(a[0]);
    corner.y = oz_fixed_position_of_bits(a[1]);
    corner.z = oz_fixed_position_of_bits(a[2]);
    place.x = view->place[0];
    place.y = view->place[1];
    place.z = view->place[2];
    found.from = oz_space_minus(place, corner, oz_work_space(w));
    found.from = oz_minus(
        found.from, oz_vec3(REAL(view->shift[0]), REAL(view->shift[1]), REAL(view->shift[2])));
    found.one = oz_vec3(b[0], b[1], b[2]);
    found.other = oz_vec3(b[3], c[0], c[1]);
    found.key = OZ_LANES_LOAD(key);
    return found;
}

/* The best of a block of lanes, where that is better than what was found before. */
OZ_INLINE void oz_mesh_find_reduce(OzMeshBest best, scalar *most, OzMeshTouch *touch)
{
    scalar left[OZ_LANES], words[6][OZ_LANES];
    OZ_LANES_STORE(best.left, left);
    OZ_LANES_STORE(best.key, words[0]);
    OZ_LANES_STORE(best.place, words[1]);
    OZ_LANES_STORE(best.normal.x, words[2]);
    OZ_LANES_STORE(best.normal.y, words[3]);
    OZ_LANES_STORE(best.normal.z, words[4]);
    OZ_LANES_STORE(best.distance, words[5]);
    for (int l = 0; l < OZ_LANES; l++) {
        if (left[l] > *most) {
            *most = left[l];
            touch->key = words[0][l];
            touch->place = words[1][l];
            touch->normal[0] = words[2][l];
            touch->normal[1] = words[3][l];
            touch->normal[2] = words[4][l];
            touch->distance = words[5][l];
        }
    }
}

/* The grain as lanes see it. */
OZ_INLINE OzMeshGrain oz_mesh_find_grain(const OzMeshView *view)
{
    OzMeshGrain grain;
    grain.half_shaft =
        oz_vec3(REAL(view->half_shaft[0]), REAL(view->half_shaft[1]), REAL(view->half_shaft[2]));
    grain.radius = REAL(view->radius);
    grain.two_sided = view->two_sided;
    return grain;
}

/* Numbers of a block of triangles from item on, the last one filled up with copies; of the list, or
 * of `near` where that is given. */
OZ_INLINE void oz_mesh_find_faces(const OzWork *w, const int *near, int item, int end, int *faces)
{
    for (int l = 0; l < OZ_LANES; l++) {
        int at = min(item + l, end - 1);
        faces[l] = near ? near[at] : w->mesh_face[at];
    }
}

/* Adds triangles to those at hand that may be touched, at ends, or between them alone. The new
 * number; more than OZ_MESH_NEAR: they are too many. */
OZ_INLINE int oz_mesh_find_near(const OzWork *w, const OzMeshView *view,
                                const OzMeshTouches *touches, int between, int *near, int count)
{
    OzMeshGrain grain = oz_mesh_find_grain(view);
    for (int item = view->item; item < view->end && count <= OZ_MESH_NEAR; item += OZ_LANES) {
        int faces[OZ_LANES];
        oz_mesh_find_faces(w, 0, item, view->end, faces);
        OzMeshFace face = oz_mesh_find_load(w, view, faces);
        mask may = between ? oz_mesh_may_between(touches, face, grain)
                           : oz_mesh_may(face, grain, OZ_ROUND ? 1 : 2);
        may = may & oz_lanes_mask_of(OZ_LANES_IOTA + item < view->end);
        count += oz_lanes_compact(near + count, OZ_LANES_LOAD(faces), may);
    }
    return count;
}

/* Looks at all triangles once; 0: none offers anything more. */
OZ_INLINE int oz_mesh_find_next(const OzWork *w, const OzMeshView *view, const int *near,
                                const OzMeshTouches *touches, int between, OzMeshTouch *touch)
{
    scalar most = 0;
    OzMeshGrain grain = oz_mesh_find_grain(view);
    for (int item = view->item; item < view->end; item += OZ_LANES) {
        int faces[OZ_LANES];
        oz_mesh_find_faces(w, near, item, view->end, faces);
        OzMeshFace face = oz_mesh_find_load(w, view, faces);
        OzMeshBest best = oz_mesh_look(touches, face, grain, OZ_ROUND ? 1 : 2, between);
        if (OZ_ANY(best.left > REAL(0.0))) {
            oz_mesh_find_reduce(best, &most, touch);
        }
    }
    touch->push = 0;
    return most > 0;
}

/* All touches of a grain; 0: there are more than slots. */
OZ_INLINE int oz_mesh_find_touches(const OzWork *w, const OzMeshView *view, OzMeshTouches *touches)
{
    int is_long = 0, fits = 1, rounds = OZ_MESH_ROUNDS, count = 0;
    int near[OZ_MESH_NEAR + 2 * OZ_LANES];
    oz_mesh_begin(touches, view->radius);
    for (int c = 0; !OZ_ROUND && c < 3; c++) {
        is_long |= view->half_shaft[c] != 0;
    }
    for (int between = 0; between <= is_long && view->item < view->end; between++) {
        OzMeshTouch touch;
        OzMeshView some = *view;
        count = oz_mesh_find_near(w, view, touches, between, near, count);
        int is_full = count > OZ_MESH_NEAR;
        some.item = is_full ? view->item : 0;
        some.end = is_full ? view->end : count;
        while (fits && rounds-- > 0 &&
               oz_mesh_find_next(w, &some, is_full ? 0 : near, touches, between, &touch)) {
            fits = oz_mesh_add(touches, touch);
        }
        oz_mesh_note_ends(touches);
    }
    return fits;
}

/* Word `word` of a slot of a grain at a mesh, in an array of so many words a slot. */
OZ_INLINE size_t oz_mesh_find_at(int grain, int mesh, int slot, int words, int word)
{
    int place = (mesh * OZ_MESH_SLOTS + slot) * words + word;
    return oz_lanes_at(grain, OZ_MESHES * OZ_MESH_SLOTS * words, place);
}

/* Springs, of one kind, go where their touches go on. first: the mesh's first slot among all ends. */
OZ_INLINE void oz_mesh_find_hand(global scalar *history, int grain, int first, const int *spring_to)
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

OZ_INLINE void oz_mesh_find_hand_over(OzWork *w, int grain, int first, const int *spring_to)
{
#if OZ_HISTORY
    oz_mesh_find_hand((global scalar *)w->wall_history, grain, first, spring_to);
#endif
#if OZ_ROLLING_SPRING
    oz_mesh_find_hand((global scalar *)w->wall_rolling, grain, first, spring_to);
#endif
}

/* The touches of a grain to its slots, which remember them as the mesh was built; answers which are
 * in use, a bit each. */
OZ_INLINE int oz_mesh_find_keep(OzWork *w, int grain, int mesh, const OzSide *side,
                                const OzMeshTouches *touches)
{
    global scalar *kept = (global scalar *)w->mesh_memory;
    global scalar *found = (global scalar *)w->mesh_touch;
    scalar memory[OZ_MESH_SLOTS * OZ_MESH_MEMORY];
    int slot_of[OZ_MESH_SLOTS], spring_to[OZ_MESH_SLOTS], bits = 0;
    for (int k = 0; k < OZ_MESH_SLOTS * OZ_MESH_MEMORY; k++) {
        memory[k] = kept[oz_mesh_find_at(grain, mesh, 0, OZ_MESH_MEMORY, k)];
    }
    oz_mesh_place(touches, memory, slot_of, spring_to);
    oz_mesh_find_hand_over(w, grain, side->index, spring_to);
    for (int k = 0; k < OZ_MESH_SLOTS * OZ_MESH_MEMORY; k++) {
        kept[oz_mesh_find_at(grain, mesh, 0, OZ_MESH_MEMORY, k)] = memory[k];
    }
    for (int i = 0; i < touches->count; i++) {
        OzMeshTouch touch = touches->at[i];
#if OZ_SWUNG
        oz_wall_swing_turn(side->swing.frame, touch.normal);
#endif
        scalar words[OZ_MESH_TOUCH] = {touch.place,     touch.normal[0], touch.normal[1],
                                       touch.normal[2], touch.distance,  touch.push};
        for (int k = 0; k < OZ_MESH_TOUCH; k++) {
            found[oz_mesh_find_at(grain, mesh, slot_of[i], OZ_MESH_TOUCH, k)] = words[k];
        }
        bits |= 1 << slot_of[i];
    }
    return bits;
}

/* The lists of the cells in which a block of grains is; empty outside of the mesh's reach. */
OZ_INLINE void oz_mesh_find_cells(const OzWork *w, int mesh, OzVec3 from, int *item, int *end)
{
    global const scalar *grid = w->mesh_grid + mesh * OZ_MESH_GRID;
    scalar place[3][OZ_LANES];
    OZ_LANES_STORE(from.x, place[0]);
    OZ_LANES_STORE(from.y, place[1]);
    OZ_LANES_STORE(from.z, place[2]);
    for (int l = 0; l < OZ_LANES; l++) {
        int cell = 0, is_in = 1;
        for (int c = 2; c >= 0; c--) {
            int cells = (int)grid[OZ_G_CELLS + c];
            scalar at = floor((place[c][l] - grid[OZ_G_LOW + c]) * grid[OZ_G_INVERSE]);
            is_in = is_in && at >= 0 && at < (scalar)cells;
            cell = cell * cells + (is_in ? (int)at : 0);
        }
        item[l] = is_in ? w->mesh_first[(int)grid[OZ_G_FIRST] + cell] : 0;
        end[l] = is_in ? w->mesh_first[(int)grid[OZ_G_FIRST] + cell + 1] : 0;
    }
}

/* Where a block of grains is, seen from the mesh's point as its triangles were built. */
OZ_INLINE OzVec3 oz_mesh_find_from(const OzWork *w, const OzSide *side, OzBody body)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzVec3 from = oz_enclosure_side_from(w, body.position, none, side);
#if OZ_SWUNG
    from = oz_wall_swing_back(side->swing.frame, from);
#endif
    return from;
}

/* The grain of one lane of a block. */
OZ_INLINE OzMeshView oz_mesh_find_view(const OzWork *w, int mesh, const OzSide *side, OzBody body,
                                       OzVec3 half_shaft, real radius, int lane)
{
    OzMeshView view;
    global const scalar *grid = w->mesh_grid + mesh * OZ_MESH_GRID;
    fixed_position_kind place[3][OZ_LANES];
    scalar words[4][OZ_LANES];
    OzWallDrive drive = oz_enclosure_side_drive(w, side);
    OzVec3 shift = oz_scale(drive.direction, drive.offset);
#if OZ_SWUNG
    half_shaft = oz_wall_swing_back(side->swing.frame, half_shaft);
    shift = oz_scale(oz_mesh_find_from(w, side, body), REAL(-1.0)); /* of the mesh's point */
#endif
    OZ_LANES_STORE(body.position.x, place[0]);
    OZ_LANES_STORE(body.position.y, place[1]);
    OZ_LANES_STORE(body.position.z, place[2]);
    OZ_LANES_STORE(half_shaft.x, words[0]);
    OZ_LANES_STORE(half_shaft.y, words[1]);
    OZ_LANES_STORE(half_shaft.z, words[2]);
    OZ_LANES_STORE(radius, words[3]);
    for (int c = 0; c < 3; c++) {
        view.place[c] = OZ_SWUNG ? side->point[c] : place[c][lane];
        view.half_shaft[c] = OZ_ROUND ? 0 : words[c][lane];
    }
    view.radius = words[3][lane];
    OZ_LANES_STORE(shift.x, words[0]);
    OZ_LANES_STORE(shift.y, words[1]);
    OZ_LANES_STORE(shift.z, words[2]);
    for (int c = 0; c < 3; c++) {
        view.shift[c] = words[c][lane];
    }
    view.corner = (int)grid[OZ_G_CORNER];
    view.two_sided = grid[OZ_G_TWO_SIDED] != 0;
    return view;
}

/* One block of grains at one mesh, whose slots begin with `side`; picked receives a word of bits
 * for each slot, one bit a lane. */
OZ_INLINE void oz_mesh_find_block(OzWork *w, const OzSide *side, int mesh, int block, int step,
                                  int *picked)
{
    OzBody body = oz_grains_load(w, block);
    OzShape shape = oz_grains_shape(w, block);
    OzVec3 half_shaft = oz_scale(oz_quaternion_axis(body.turn), shape.half_length);
    int item[OZ_LANES], end[OZ_LANES], before = 0;
    oz_mesh_find_cells(w, mesh, oz_mesh_find_from(w, side, body), item, end);
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        before |= w->wall_active[(size_t)block * OZ_WALL_ENDS + side->index + k];
        picked[k] = 0;
    }
    for (int l = 0; l < OZ_LANES; l++) {
        int grain = block * OZ_LANES + l, is_near = item[l] < end[l] && side->shape.gone == 0;
        if (grain < w->z.count && (is_near || (before >> l & 1))) {
            OzMeshTouches touches;
            OzMeshView view = oz_mesh_find_view(w, mesh, side, body, half_shaft, shape.radius, l);
            view.item = is_near ? item[l] : 0;
            view.end = is_near ? end[l] : 0;
            if (!oz_mesh_find_touches(w, &view, &touches)) {
                oz_work_stop(w, OZ_STOP_CROWDED, step, w->id[grain]);
            }
            int bits = oz_mesh_find_keep(w, grain, mesh, side, &touches);
            for (int k = 0; k < OZ_MESH_SLOTS; k++) {
                picked[k] |= (bits >> k & 1) << l;
            }
        }
    }
}

/* Where one block of picked grains touches in a slot. */
OZ_INLINE OzWallEnd oz_mesh_find_end(const OzWork *w, OzGrain grain, int mesh, int slot,
                                     const int *slots)
{
    OzWallEnd where;
    int words = OZ_MESHES * OZ_MESH_SLOTS * OZ_MESH_TOUCH;
    int word = (mesh * OZ_MESH_SLOTS + slot) * OZ_MESH_TOUCH;
    where.end = oz_scale(grain.half_shaft, oz_lanes_fetch(w->mesh_touch, slots, words, word));
    where.wall.normal = oz_work_fetch3(w->mesh_touch, slots, words, word + 1);
    where.wall.distance = oz_lanes_fetch(w->mesh_touch, slots, words, word + 4);
    where.share = oz_lanes_fetch(w->mesh_touch, slots, words, word + 5) /
                  (grain.radius - where.wall.distance);
    where.present = where.share > REAL(0.0);
    return where;
}

#endif
