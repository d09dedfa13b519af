/* The triangles of meshes near each grain: all that it may touch until it has moved by its skin, as
 * the mesh sees it, which may move too. A grain that has makes its list anew, on the spot, from
 * that of its cell in the mesh's grid; so do all where slots or meshes have changed
 * (oz_mesh_list_forget). Whatever the skins, a grain's triangles come in the order of their
 * numbers. A list too small is not used: the cell's is walked instead, and the host is asked for
 * larger ones when grains' lists are renewed next (oz_mesh_list_ask). OpenCL C only. */
#pragma once

#include "kernels/grains.h"
#include "kernels/mesh_touch.h"

#if OZ_MESHES > 0

/* The most triangles that lists are made for; a grain with more of them, of which it touches few,
 * would have all grains' lists take that room. */
enum { OZ_MESH_LIST_MOST = 256 };

/* Grains of a block as a mesh sees them. */
typedef struct OzMeshSight {
    int mesh, corner;      /* the mesh, and its first triangle                           */
    OzFixedPosition place; /* from which a corner's is taken, then ...                   */
    OzVec3 shift;          /* ... this, m: the grain's centre, seen from there, is left  */
    OzVec3 from;           /* m, centre from the mesh's point, on the mesh as built      */
    real speed;            /* m/s, of any point of the grain to the mesh there, at most  */
    OzMeshGrain grain;
} OzMeshSight;

/* Triangles before grains, one a lane. */
OZ_INLINE OzMeshFace oz_mesh_list_load(const OzWork *w, const OzMeshSight *sight, const int *faces)
{
    real a[4], b[4], c[4];
    scalar key[OZ_LANES];
    int at[OZ_LANES];
    OzFixedPosition corner;
    OzMeshFace found;
    for (int l = 0; l < OZ_LANES; l++) {
        at[l] = sight->corner + faces[l];
        key[l] = OZ_MESH_KEY(faces[l], 0);
    }
    oz_lanes_load4(w->mesh_record, at, OZ_MESH_RECORD, OZ_MESH_R_CORNER, a);
    oz_lanes_load4(w->mesh_record, at, OZ_MESH_RECORD, OZ_MESH_R_ONE, b);
    oz_lanes_load4(w->mesh_record, at, OZ_MESH_RECORD, OZ_MESH_R_OTHER + 1, c);
    corner.x = oz_fixed_position_of_bits(a[0]);
    corner.y = oz_fixed_position_of_bits(a[1]);
    corner.z = oz_fixed_position_of_bits(a[2]);
    found.from = oz_minus(oz_space_minus(sight->place, corner, oz_work_space(w)), sight->shift);
    found.one = oz_vec3(b[0], b[1], b[2]);
    found.other = oz_vec3(b[3], c[0], c[1]);
    found.key = OZ_LANES_LOAD(key);
    return found;
}

/* The list of the cell in which a place is, m from the mesh's point; empty outside of the mesh's
 * reach. */
OZ_INLINE void oz_mesh_list_cell(const OzWork *w, int mesh, const scalar *place, int *item,
                                 int *end)
{
    global const scalar *grid = w->mesh_grid + mesh * OZ_MESH_GRID;
    int cell = 0, is_in = 1;
    for (int c = 2; c >= 0; c--) {
        int cells = (int)grid[OZ_G_CELLS + c];
        scalar at = floor((place[c] - grid[OZ_G_LOW + c]) * grid[OZ_G_INVERSE]);
        is_in = is_in && at >= 0 && at < (scalar)cells;
        cell = cell * cells + (is_in ? (int)at : 0);
    }
    *item = is_in ? w->mesh_first[(int)grid[OZ_G_FIRST] + cell] : 0;
    *end = is_in ? w->mesh_first[(int)grid[OZ_G_FIRST] + cell + 1] : 0;
}

/* That of one grain of a block. */
OZ_INLINE void oz_mesh_list_cell_of(const OzWork *w, const OzMeshSight *sight, int lane, int *item,
                                    int *end)
{
    scalar words[3][OZ_LANES];
    OZ_LANES_STORE(sight->from.x, words[0]);
    OZ_LANES_STORE(sight->from.y, words[1]);
    OZ_LANES_STORE(sight->from.z, words[2]);
    scalar place[3] = {words[0][lane], words[1][lane], words[2][lane]};
    oz_mesh_list_cell(w, sight->mesh, place, item, end);
}

OZ_INLINE global real *oz_mesh_list_words(const OzWork *w, int mesh, int block)
{
    return w->mesh_list + ((size_t)block * OZ_MESHES + mesh) * OZ_MESH_LIST;
}

/* Where a block's triangles begin: those that come first, one a lane, then those that come second
 * ... */
OZ_INLINE size_t oz_mesh_list_first(const OzWork *w, int mesh, int block)
{
    return ((size_t)block * OZ_MESHES + mesh) * w->z.face_capacity * OZ_LANES;
}

/* A block's lists do not hold any more. */
OZ_INLINE void oz_mesh_list_forget(OzWork *w, int block)
{
    for (int mesh = 0; mesh < OZ_MESHES; mesh++) {
        oz_mesh_list_words(w, mesh, block)[OZ_MESH_L_SKIN] = REAL(0.0);
    }
}

/* Asks for larger lists where some were too small; a block's are made anew then. */
OZ_INLINE void oz_mesh_list_ask(OzWork *w, int block)
{
    if (w->control->faces_needed > w->z.face_capacity) {
        atomic_or(&w->control->full, 1);
        oz_mesh_list_forget(w, block);
    }
}

/* How far points of shafts can have moved since their lists were made, at most, m: the larger of
 * |dx
 * + da| and |dx - da|. */
OZ_INLINE real oz_mesh_list_moved(const OzMeshSight *sight, global const real *words)
{
    OzVec3 dx = oz_minus(sight->from, oz_work_load3(words + OZ_MESH_L_FROM));
    real moved2 = oz_dot(dx, dx);
    if (!OZ_ROUND) {
        OzVec3 da = oz_minus(sight->grain.half_shaft, oz_work_load3(words + OZ_MESH_L_SHAFT));
        moved2 = moved2 + oz_dot(da, da) + REAL(2.0) * oz_magnitude(oz_dot(dx, da));
    }
    return sqrt(moved2);
}

/* How far grains must move at least before they may touch triangles, on any side, m. */
OZ_INLINE real oz_mesh_list_slack(OzMeshFace face, OzMeshGrain grain)
{
    real near = grain.radius * REAL(1 + OZ_PAIRS_MARGIN);
    real gap = oz_mesh_distance(face.from, face, 1).distance - near;
    if (OZ_ROUND) {
        return gap;
    }
    gap -= sqrt(oz_dot(grain.half_shaft, grain.half_shaft));
    return oz_larger(gap, sqrt(oz_mesh_aside2(face, grain)) - oz_mesh_size(face) - near);
}

OZ_INLINE real oz_mesh_list_same(real value, int lane)
{
    scalar words[OZ_LANES];
    OZ_LANES_STORE(value, words);
    return REAL(words[lane]);
}

OZ_INLINE OzVec3 oz_mesh_list_same3(OzVec3 v, int lane)
{
    return oz_vec3(oz_mesh_list_same(v.x, lane), oz_mesh_list_same(v.y, lane),
                   oz_mesh_list_same(v.z, lane));
}

OZ_INLINE fixed_position oz_mesh_list_same_place(fixed_position value, int lane)
{
    fixed_position_kind words[OZ_LANES];
    OZ_LANES_STORE(value, words);
    return (fixed_position)(words[lane]);
}

/* One grain of a block, in every lane. */
OZ_INLINE OzMeshSight oz_mesh_list_one(const OzMeshSight *sight, int lane)
{
    OzMeshSight one = *sight;
    one.place.x = oz_mesh_list_same_place(sight->place.x, lane);
    one.place.y = oz_mesh_list_same_place(sight->place.y, lane);
    one.place.z = oz_mesh_list_same_place(sight->place.z, lane);
    one.shift = oz_mesh_list_same3(sight->shift, lane);
    one.grain.half_shaft = oz_mesh_list_same3(sight->grain.half_shaft, lane);
    one.grain.radius = oz_mesh_list_same(sight->grain.radius, lane);
    return one;
}

/* The triangles near one grain, a block of them at a time; their number, stored or not. */
OZ_INLINE int oz_mesh_list_fill(OzWork *w, const OzMeshSight *sight, real skins, int block,
                                int lane)
{
    OzMeshSight one = oz_mesh_list_one(sight, lane);
    size_t first = oz_mesh_list_first(w, sight->mesh, block) + lane;
    real skin = oz_mesh_list_same(skins, lane);
    int item, end, count = 0;
    oz_mesh_list_cell_of(w, sight, lane, &item, &end);
    for (; item < end; item += OZ_LANES) {
        int faces[OZ_LANES], near[OZ_LANES];
        scalar gaps[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            faces[l] = w->mesh_face[min(item + l, end - 1)];
        }
        real slack = oz_mesh_list_slack(oz_mesh_list_load(w, &one, faces), one.grain);
        int bits = oz_lanes_bits((slack < skin) & oz_lanes_mask_of(OZ_LANES_IOTA + item < end));
        oz_lanes_close_up(near, OZ_LANES_LOAD(faces), bits);
        oz_lanes_close_up_real(gaps, slack, bits);
        for (int l = 0; l < popcount(bits); l++, count++) {
            if (count < w->z.face_capacity) {
                w->mesh_near[first + count * OZ_LANES] = near[l];
                w->mesh_slack[first + count * OZ_LANES] = gaps[l];
            }
        }
    }
    return count;
}

/* Makes the lists of some grains of a block anew, a bit each. */
OZ_INLINE void oz_mesh_list_make(OzWork *w, const OzMeshSight *sight, int block, int bits)
{
    global const OzParameters *p = w->parameters;
    global real *words = oz_mesh_list_words(w, sight->mesh, block);
    real most = REAL(w->mesh_grid[sight->mesh * OZ_MESH_GRID + OZ_G_SKIN]);
    real skin = oz_smaller(most, REAL(p->skin_least) + sight->speed * REAL(p->skin_time));
    real fresh[OZ_MESH_LIST] = {sight->from.x,
                                sight->from.y,
                                sight->from.z,
                                sight->grain.half_shaft.x,
                                sight->grain.half_shaft.y,
                                sight->grain.half_shaft.z,
                                skin,
                                skin};
    scalar numbers[OZ_LANES], made[OZ_LANES];
    OZ_LANES_STORE(words[OZ_MESH_L_NUMBER], numbers);
    for (int l = 0; l < OZ_LANES; l++) {
        int is_made = bits >> l & 1;
        if (is_made) {
            int count = oz_mesh_list_fill(w, sight, skin, block, l);
            numbers[l] = count;
            if (count > w->z.face_capacity) {
                atomic_max(&w->control->faces_needed, min(count, OZ_MESH_LIST_MOST));
            }
        }
        made[l] = is_made;
    }
    mask takes = OZ_LANES_LOAD(made) > REAL(0.0);
    fresh[OZ_MESH_L_NUMBER] = OZ_LANES_LOAD(numbers);
    for (int k = 0; k < OZ_MESH_LIST; k++) {
        words[k] = takes ? fresh[k] : words[k];
    }
}

#endif
