/* Finds where the grains of a block touch meshes. Each lane is a grain with a triangle of its list
 * before it at a time; the places that are offered are gathered grain by grain, and those that push
 * are chosen among them. OpenCL C only. */
#pragma once

#include "kernels/enclosure_side.h"
#include "kernels/mesh_keep.h"
#include "kernels/mesh_list.h"

#if OZ_MESHES > 0

#define OZ_MESH_ENDS (OZ_ROUND ? 1 : 2)

/* Triangles of each grain that are looked at together, and places at hand that these offer; where
 * there are more, triangles are looked at again for each touch. */
enum { OZ_MESH_NEAR = 8, OZ_MESH_OFFERS = (OZ_ROUND ? 4 : 8) * OZ_MESH_NEAR };

/* A block, the triangles near it and what they offer. */
typedef struct OzMeshBlock {
    OzMeshSight sight;
    OzMeshEnds ends;            /* when touches between them are looked for                     */
    int number[OZ_LANES], most; /* of triangles near each grain                                 */
    global const int *faces;    /* they, one lane a grain ...                                   */
    global const scalar *slack; /* ... and how far each must move before it may touch           */
    real moved;                 /* how far it has                                               */
    int walks;                  /* a bit each: the cell's list is taken, all of it, ...         */
    int item[OZ_LANES];         /* ... from here on in mesh_face                                */
    int next, pass;             /* to be looked at; between ends, all are looked at twice       */
    int listed[OZ_MESH_NEAR][OZ_LANES], listed_count[OZ_LANES]; /* being looked at              */
    int near[OZ_MESH_NEAR][OZ_LANES], near_count[OZ_LANES];     /* of these, what may be touched */
    OzMeshTouch offer[OZ_LANES][OZ_MESH_OFFERS];
    int offer_count[OZ_LANES];
    int rounds[OZ_LANES]; /* left to look for touches                                           */
    OzMeshTouches touches[OZ_LANES];
} OzMeshBlock;

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

/* How a mesh sees a block. */
OZ_INLINE OzMeshSight oz_mesh_find_sight(const OzWork *w, int mesh, const OzSide *side, OzBody body,
                                         OzShape shape)
{
    OzMeshSight sight;
    global const scalar *grid = w->mesh_grid + mesh * OZ_MESH_GRID;
    OzWallDrive drive = oz_enclosure_side_drive(w, side);
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), axis = oz_quaternion_axis(body.turn);
    OzVec3 rate = oz_body_rate(body.spin, axis, shape);
    OzVec3 passing =
        oz_minus(body.velocity, oz_enclosure_side_velocity(w, body.position, none, side));
    OzVec3 turning = oz_minus(rate, oz_enclosure_side_turning(w, side));
    sight.mesh = mesh;
    sight.corner = (int)grid[OZ_G_CORNER];
    sight.from = oz_mesh_find_from(w, side, body);
    sight.speed = sqrt(oz_dot(passing, passing));
    sight.grain.half_shaft = OZ_ROUND ? none : oz_scale(axis, shape.half_length);
    sight.grain.radius = shape.radius;
    sight.grain.two_sided = grid[OZ_G_TWO_SIDED] != 0;
    sight.place = body.position;
    sight.shift = oz_scale(drive.direction, drive.offset);
    if (!OZ_ROUND) {
        sight.speed += shape.half_length * sqrt(oz_dot(turning, turning));
    }
#if OZ_SWUNG
    sight.grain.half_shaft = oz_wall_swing_back(side->swing.frame, sight.grain.half_shaft);
    sight.place.x = (fixed_position)(side->point[0]);
    sight.place.y = (fixed_position)(side->point[1]);
    sight.place.z = (fixed_position)(side->point[2]);
    sight.shift = oz_scale(sight.from, REAL(-1.0)); /* of the mesh's point */
#endif
    return sight;
}

/* A block's lists, made anew where they do not hold; none of a mesh that is not there. */
OZ_INLINE void oz_mesh_find_lists(OzWork *w, const OzSide *side, int block, OzMeshBlock *b)
{
    global const real *words = oz_mesh_list_words(w, b->sight.mesh, block);
    int bits = side->shape.gone == 0 ? oz_lanes_bits(oz_grains_present(w, block)) : 0;
    real moved = oz_mesh_list_moved(&b->sight, words);
    int stale = bits & ~oz_lanes_bits(moved < words[OZ_MESH_L_SKIN]);
    scalar numbers[OZ_LANES];
    if (stale != 0) {
        oz_mesh_list_make(w, &b->sight, block, stale);
        moved = oz_mesh_list_moved(&b->sight, words);
    }
    OZ_LANES_STORE(words[OZ_MESH_L_NUMBER], numbers);
    b->moved = moved;
    b->faces = w->mesh_near + oz_mesh_list_first(w, b->sight.mesh, block);
    b->slack = w->mesh_slack + oz_mesh_list_first(w, b->sight.mesh, block);
    b->walks = b->most = 0;
    for (int l = 0; l < OZ_LANES; l++) {
        int number = bits >> l & 1 ? (int)numbers[l] : 0, end;
        if (number > w->z.face_capacity) {
            oz_mesh_list_cell_of(w, &b->sight, l, &b->item[l], &end);
            number = end - b->item[l];
            b->walks |= 1 << l;
        }
        b->number[l] = number;
        b->most = max(b->most, number);
    }
}

/* The i-th triangle of each grain's list, whose cell's list is taken: in bits. */
OZ_INLINE int oz_mesh_find_walk(const OzWork *w, const OzMeshBlock *b, int i, int *faces)
{
    int bits = 0;
    for (int l = 0; b->walks >> l != 0; l++) {
        if ((b->walks >> l & 1) && i < b->number[l]) {
            faces[l] = w->mesh_face[b->item[l] + i];
            bits |= 1 << l;
        }
    }
    return bits;
}

/* The next triangles of the lists that grains, a bit each, have moved far enough for, as many as
 * there is room for. Answers the most of any grain, 0: there are none. */
OZ_INLINE int oz_mesh_find_listed(const OzWork *w, OzMeshBlock *b, int grains)
{
    int most = 0;
    index numbers = OZ_LANES_LOAD(b->number);
    for (int l = 0; l < OZ_LANES; l++) {
        b->listed_count[l] = 0;
    }
    for (; b->next < b->most && most < OZ_MESH_NEAR; b->next++) {
        int faces[OZ_LANES], i = min(b->next, w->z.face_capacity - 1);
        real slack = OZ_LANES_LOAD(b->slack + (size_t)i * OZ_LANES);
        mask takes = (slack < b->moved) & oz_lanes_mask_of(numbers > b->next);
        int bits = oz_lanes_bits(takes) & ~b->walks;
        OZ_LANES_STORE(OZ_LANES_LOAD(b->faces + (size_t)i * OZ_LANES), faces);
        bits = (bits | oz_mesh_find_walk(w, b, b->next, faces)) & grains;
        for (int l = 0; bits >> l != 0; l++) {
            if (bits >> l & 1) {
                b->listed[b->listed_count[l]++][l] = faces[l];
                most = max(most, b->listed_count[l]);
            }
        }
    }
    return most;
}

/* The i-th of rows of triangles, where grains have so many each; the bits of those that have one.
 * Others see any. */
OZ_INLINE int oz_mesh_find_row(const int rows[OZ_MESH_NEAR][OZ_LANES], const int *counts, int i,
                               int *faces)
{
    int have = 0;
    for (int l = 0; l < OZ_LANES; l++) {
        faces[l] = i < counts[l] ? rows[i][l] : 0;
        have |= (i < counts[l]) << l;
    }
    return have;
}

/* Adds places of grains, a bit each, to those at hand; the largest number of these. */
OZ_INLINE int oz_mesh_find_take(OzMeshBlock *b, OzMeshOffer offer, int bits)
{
    int most = 0;
    bits &= oz_lanes_bits(offer.counts);
    if (bits != 0) {
        scalar words[6][OZ_LANES];
        OZ_LANES_STORE(offer.key, words[0]);
        OZ_LANES_STORE(offer.place, words[1]);
        OZ_LANES_STORE(offer.at.normal.x, words[2]);
        OZ_LANES_STORE(offer.at.normal.y, words[3]);
        OZ_LANES_STORE(offer.at.normal.z, words[4]);
        OZ_LANES_STORE(offer.at.distance, words[5]);
        for (int l = 0; bits >> l != 0; l++) {
            if (bits >> l & 1) {
                OzMeshTouch *to = &b->offer[l][b->offer_count[l]++];
                to->key = words[0][l];
                to->place = words[1][l];
                to->normal[0] = words[2][l];
                to->normal[1] = words[3][l];
                to->normal[2] = words[4][l];
                to->distance = words[5][l];
                to->push = 0;
                most = max(most, b->offer_count[l]);
            }
        }
    }
    return most;
}

/* What listed triangles, at most so many of each grain, offer to ends; the most that grains have at
 * hand then. */
OZ_INLINE int oz_mesh_find_ends(const OzWork *w, OzMeshBlock *b, int listed)
{
    int most = 0, faces[OZ_LANES];
    for (int i = 0; i < listed; i++) {
        int have = oz_mesh_find_row(b->listed, b->listed_count, i, faces);
        OzMeshFace face = oz_mesh_list_load(w, &b->sight, faces);
        for (int end = 0; end < OZ_MESH_ENDS; end++) {
            most =
                max(most, oz_mesh_find_take(b, oz_mesh_offer_end(face, b->sight.grain, end), have));
        }
    }
    return most;
}

/* Those listed triangles that ends touch, or in the second pass that may be touched between ends;
 * the most of any grain. */
OZ_INLINE int oz_mesh_find_near(const OzWork *w, OzMeshBlock *b, int listed)
{
    int most = 0, faces[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        b->near_count[l] = 0;
    }
    for (int i = 0; i < listed; i++) {
        int have = oz_mesh_find_row(b->listed, b->listed_count, i, faces);
        OzMeshFace face = oz_mesh_list_load(w, &b->sight, faces);
        mask takes = b->pass ? oz_mesh_may_between(b->ends, face, b->sight.grain)
                             : oz_mesh_offer_end(face, b->sight.grain, 0).counts |
                                   oz_mesh_offer_end(face, b->sight.grain, 1).counts;
        have &= oz_lanes_bits(takes);
        for (int l = 0; have >> l != 0; l++) {
            if (have >> l & 1) {
                b->near[b->near_count[l]++][l] = faces[l];
                most = max(most, b->near_count[l]);
            }
        }
    }
    return most;
}

/* What these offer, at ends and between them. */
OZ_INLINE int oz_mesh_find_shafts(const OzWork *w, OzMeshBlock *b, int listed)
{
    int most = 0, near = oz_mesh_find_near(w, b, listed), faces[OZ_LANES];
    for (int i = 0; i < near; i++) {
        int have = oz_mesh_find_row(b->near, b->near_count, i, faces);
        OzMeshFace face = oz_mesh_list_load(w, &b->sight, faces);
        for (int end = 0; end < OZ_MESH_ENDS; end++) {
            most =
                max(most, oz_mesh_find_take(b, oz_mesh_offer_end(face, b->sight.grain, end), have));
        }
        have &= oz_lanes_bits(oz_mesh_may_between(b->ends, face, b->sight.grain));
        for (int part = 0; have != 0 && part < OZ_WALL_SHAFT_PARTS; part++) {
            OzMeshOffer offer = oz_mesh_offer_shaft(b->ends, face, b->sight.grain, part);
            most = max(most, oz_mesh_find_take(b, offer, have));
        }
    }
    return most;
}

/* Puts at hand what is offered to grains, a bit each, from the beginning or from where there was no
 * room. Answers whether there may be more. */
OZ_INLINE int oz_mesh_find_offers(const OzWork *w, OzMeshBlock *b, int grains, int between,
                                  int begins)
{
    int passes = between ? 2 : 1, of_each = between ? 4 : OZ_MESH_ENDS, most = 0;
    for (int l = 0; l < OZ_LANES; l++) {
        b->offer_count[l] = 0;
    }
    b->next = begins ? 0 : b->next;
    b->pass = begins ? 0 : b->pass;
    while (b->pass < passes && most + of_each * OZ_MESH_NEAR <= OZ_MESH_OFFERS) {
        int listed = oz_mesh_find_listed(w, b, grains);
        if (listed == 0) {
            b->pass++;
            b->next = 0;
        } else {
            most = max(most, between ? oz_mesh_find_shafts(w, b, listed)
                                     : oz_mesh_find_ends(w, b, listed));
        }
    }
    return b->pass < passes;
}

/* Of what is at hand, that of which most is left, if that is more than most. */
OZ_INLINE void oz_mesh_find_best(const OzMeshBlock *b, int lane, scalar *most, OzMeshTouch *best)
{
    for (int i = 0; i < b->offer_count[lane]; i++) {
        scalar left = oz_mesh_left(&b->touches[lane], &b->offer[lane][i]);
        if (left > *most) {
            *most = left;
            *best = b->offer[lane][i];
        }
    }
}

/* One more touch of each grain, a bit each; the bits of those that may have another one. *crowded
 * receives those that have more than slots. */
OZ_INLINE int oz_mesh_find_next(const OzWork *w, OzMeshBlock *b, int bits, int between, int more,
                                int *crowded)
{
    scalar most[OZ_LANES];
    OzMeshTouch best[OZ_LANES];
    int next = 0;
    for (int l = 0; l < OZ_LANES; l++) {
        most[l] = 0;
    }
    for (int looks = 1; looks; looks = more) {
        for (int l = 0; bits >> l != 0; l++) {
            if (bits >> l & 1) {
                oz_mesh_find_best(b, l, &most[l], &best[l]);
            }
        }
        more = more && oz_mesh_find_offers(w, b, bits, between, 0);
    }
    for (int l = 0; bits >> l != 0; l++) {
        if (bits >> l & 1) {
            b->rounds[l]--;
            int fits = most[l] > 0 && oz_mesh_add(&b->touches[l], best[l]);
            *crowded |= (most[l] > 0 && !fits) << l;
            next |= (fits && b->rounds[l] > 0) << l;
        }
    }
    return next;
}

/* Touches of grains, a bit each, at their ends, or between them too. */
OZ_INLINE void oz_mesh_find_part(const OzWork *w, OzMeshBlock *b, int bits, int between,
                                 int *crowded)
{
    while (bits != 0) {
        int more = oz_mesh_find_offers(w, b, bits, between, 1), is_whole = !more;
        do {
            bits = oz_mesh_find_next(w, b, bits, between, more, crowded);
        } while (is_whole && bits != 0);
    }
}

/* All touches of a block's grains; the bits of those that have more than slots. */
OZ_INLINE int oz_mesh_find_touches(const OzWork *w, OzMeshBlock *b)
{
    scalar radius[OZ_LANES], tips[OZ_LANES], tails[OZ_LANES];
    int crowded = 0, bits = 0;
    OZ_LANES_STORE(b->sight.grain.radius, radius);
    for (int l = 0; l < OZ_LANES; l++) {
        b->rounds[l] = OZ_MESH_ROUNDS;
        oz_mesh_begin(&b->touches[l], radius[l]);
        bits |= (b->number[l] > 0) << l;
    }
    oz_mesh_find_part(w, b, bits, 0, &crowded);
    if (!OZ_ROUND) {
        OzVec3 shaft = b->sight.grain.half_shaft;
        bits &= oz_lanes_bits(oz_dot(shaft, shaft) > REAL(0.0)) & ~crowded;
        for (int l = 0; l < OZ_LANES; l++) {
            oz_mesh_note_ends(&b->touches[l]);
            tips[l] = b->touches[l].tip;
            tails[l] = b->touches[l].tail;
            bits &= ~((b->rounds[l] <= 0) << l);
        }
        b->ends.tip = OZ_LANES_LOAD(tips);
        b->ends.tail = OZ_LANES_LOAD(tails);
        oz_mesh_find_part(w, b, bits, 1, &crowded);
    }
    return crowded;
}

/* One block of grains at one mesh, whose slots begin with `side`; picked receives a word of bits
 * for each slot, one bit a lane. */
OZ_INLINE void oz_mesh_find_block(OzWork *w, const OzSide *side, int mesh, int block, int step,
                                  int *picked)
{
    OzBody body = oz_grains_load(w, block);
    OzShape shape = oz_grains_shape(w, block);
    OzMeshBlock b;
    int active[OZ_MESH_SLOTS], before = 0;
    b.sight = oz_mesh_find_sight(w, mesh, side, body, shape);
    oz_mesh_find_lists(w, side, block, &b);
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        active[k] = w->wall_active[(size_t)block * OZ_WALL_ENDS + side->index + k];
        before |= active[k];
        picked[k] = 0;
    }
    if (b.most == 0 && before == 0) {
        return;
    }
    int crowded = oz_mesh_find_touches(w, &b);
    for (int l = 0; l < OZ_LANES; l++) {
        int grain = block * OZ_LANES + l;
        if (grain < w->z.count && (b.touches[l].count > 0 || (before >> l & 1))) {
            int held = 0;
            for (int k = 0; k < OZ_MESH_SLOTS; k++) {
                held |= (active[k] >> l & 1) << k;
            }
            int bits = oz_mesh_keep(w, grain, mesh, side, &b.touches[l], held);
            for (int k = 0; k < OZ_MESH_SLOTS; k++) {
                picked[k] |= (bits >> k & 1) << l;
            }
            if (crowded >> l & 1) {
                oz_work_stop(w, OZ_STOP_CROWDED, step, w->id[grain]);
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
