/* Packing and unpacking of pieces. Trusts no index that it reads. */
#include "observe/frame_pieces.h"

#include <math.h>

enum {
    PIECE_BYTES = 8 * (1 + 6 + 4), /* radius, corner; area, mass, inertia, angle */
    FRAME_PIECE_BYTES = 4 * 5      /* position, angle, velocity                  */
};

OzPieceCounts oz_frame_pieces_count(const OzPieces *pieces)
{
    return (OzPieceCounts){.grains = pieces->grain_count,
                           .walls = pieces->wall_count,
                           .free_pieces = pieces->free_count,
                           .wall_pieces = pieces->count - pieces->free_count,
                           .beams = pieces->beam_count,
                           .outlines = pieces->outline_count};
}

void oz_frame_pieces_pack_head(OzBytes *at, const OzPieceCounts *counts)
{
    const int64_t head[4] = {counts->free_pieces, counts->wall_pieces, counts->beams,
                             counts->outlines};
    oz_bytes_pack(at, head, sizeof head);
}

void oz_frame_pieces_unpack_head(OzBytes *at, OzPieceCounts *counts)
{
    int64_t head[4];
    oz_bytes_unpack(at, head, sizeof head);
    counts->free_pieces = head[0];
    counts->wall_pieces = head[1];
    counts->beams = head[2];
    counts->outlines = head[3];
}

size_t oz_frame_pieces_static_bytes(const OzPieceCounts *counts)
{
    int64_t integers = counts->grains + counts->walls + 1 + 2 * (counts->beams + counts->outlines);
    return 4 * (size_t)integers + (size_t)(counts->free_pieces + counts->wall_pieces) * PIECE_BYTES;
}

size_t oz_frame_pieces_bytes(const OzPieceCounts *counts)
{
    return (size_t)(counts->free_pieces + counts->wall_pieces) * FRAME_PIECE_BYTES;
}

static void pack_integers(OzBytes *at, const int *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        int32_t value = (int32_t)values[i];
        oz_bytes_pack(at, &value, sizeof value);
    }
}

static void unpack_integers(OzBytes *at, int *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        int32_t value;
        oz_bytes_unpack(at, &value, sizeof value);
        values[i] = (int)value;
    }
}

void oz_frame_pieces_pack_static(OzBytes *at, const OzPieces *pieces)
{
    size_t column = (size_t)pieces->count * sizeof(double);
    for (int64_t b = 0; b <= pieces->grain_count + pieces->wall_count; b++) {
        int32_t first = (int32_t)pieces->first[b];
        oz_bytes_pack(at, &first, sizeof first);
    }
    oz_bytes_pack(at, pieces->radius, column);
    oz_bytes_pack(at, pieces->corner, 6 * column);
    oz_bytes_pack(at, pieces->area, column);
    oz_bytes_pack(at, pieces->mass, column);
    oz_bytes_pack(at, pieces->inertia, column);
    oz_bytes_pack(at, pieces->angle, column);
    pack_integers(at, pieces->beam_a, pieces->beam_count);
    pack_integers(at, pieces->beam_b, pieces->beam_count);
    pack_integers(at, pieces->outline_piece, pieces->outline_count);
    pack_integers(at, pieces->outline_edge, pieces->outline_count);
}

/* Bodies follow each other without gaps, each grain with a piece at least. */
static bool unpack_bodies(OzBytes *at, OzPieces *pieces)
{
    int64_t bodies = pieces->grain_count + pieces->wall_count;
    for (int64_t b = 0; b <= bodies; b++) {
        int32_t first;
        oz_bytes_unpack(at, &first, sizeof first);
        pieces->first[b] = first;
        int64_t least = b == 0 ? 0 : pieces->first[b - 1] + (b <= pieces->grain_count);
        if (first < least || first > pieces->count || (b == 0 && first != 0)) {
            return false;
        }
        for (int64_t i = b > 0 ? pieces->first[b - 1] : 0; i < first; i++) {
            pieces->body[i] = (int)(b - 1);
        }
    }
    return pieces->first[pieces->grain_count] == pieces->free_count &&
           pieces->first[bodies] == pieces->count;
}

static bool piece_is_sound(const OzPieces *pieces, int64_t i)
{
    bool free_piece = i < pieces->free_count, good = pieces->reach[i] < 1e30;
    good = good && pieces->radius[i] >= 0 && pieces->radius[i] < 1e30;
    good = good && pieces->area[i] > 0 && pieces->area[i] < 1e30;
    good = good && (free_piece ? pieces->mass[i] > 0 : pieces->mass[i] == 0);
    good = good && (free_piece ? pieces->inertia[i] > 0 : pieces->inertia[i] == 0);
    return good && pieces->mass[i] < 1e30 && pieces->inertia[i] < 1e30 &&
           isfinite(pieces->angle[i]);
}

static bool all_are_within(const int *values, int64_t count, int64_t limit)
{
    for (int64_t i = 0; i < count; i++) {
        if (values[i] < 0 || values[i] >= limit) {
            return false;
        }
    }
    return true;
}

static void find_reach(OzPieces *pieces, int64_t i)
{
    double reach = pieces->radius[i];
    for (int c = 0; c < 3; c++) {
        const double *corner = pieces->corner + 6 * i + 2 * c;
        double next = hypot(corner[0], corner[1]);
        reach = next <= reach || isnan(reach) ? reach : next; /* a NaN is kept, to be refused */
    }
    pieces->reach[i] = reach;
}

bool oz_frame_pieces_unpack_static(OzBytes *at, OzPieces *pieces)
{
    size_t column = (size_t)pieces->count * sizeof(double);
    if (!unpack_bodies(at, pieces)) {
        return false;
    }
    oz_bytes_unpack(at, pieces->radius, column);
    oz_bytes_unpack(at, pieces->corner, 6 * column);
    oz_bytes_unpack(at, pieces->area, column);
    oz_bytes_unpack(at, pieces->mass, column);
    oz_bytes_unpack(at, pieces->inertia, column);
    oz_bytes_unpack(at, pieces->angle, column);
    unpack_integers(at, pieces->beam_a, pieces->beam_count);
    unpack_integers(at, pieces->beam_b, pieces->beam_count);
    unpack_integers(at, pieces->outline_piece, pieces->outline_count);
    unpack_integers(at, pieces->outline_edge, pieces->outline_count);
    for (int64_t i = 0; i < pieces->count; i++) {
        find_reach(pieces, i);
        if (!piece_is_sound(pieces, i)) {
            return false;
        }
    }
    return all_are_within(pieces->beam_a, pieces->beam_count, pieces->free_count) &&
           all_are_within(pieces->beam_b, pieces->beam_count, pieces->free_count) &&
           all_are_within(pieces->outline_piece, pieces->outline_count, pieces->count) &&
           all_are_within(pieces->outline_edge, pieces->outline_count, 3);
}

void oz_frame_pieces_pack(OzBytes *at, const OzSnapshot *snapshot)
{
    oz_bytes_pack_floats(at, snapshot->piece_position, 2 * snapshot->piece_count);
    oz_bytes_pack_floats(at, snapshot->piece_angle, snapshot->piece_count);
    oz_bytes_pack_floats(at, snapshot->piece_velocity, 2 * snapshot->piece_count);
}

void oz_frame_pieces_unpack(OzBytes *at, OzSnapshot *snapshot)
{
    oz_bytes_unpack_floats(at, snapshot->piece_position, 2 * snapshot->piece_count);
    oz_bytes_unpack_floats(at, snapshot->piece_angle, snapshot->piece_count);
    oz_bytes_unpack_floats(at, snapshot->piece_velocity, 2 * snapshot->piece_count);
    memset(snapshot->piece_spin, 0, (size_t)snapshot->piece_count * sizeof(double));
    oz_snapshot_join_pieces(snapshot);
    memset(snapshot->spin, 0, (size_t)(3 * snapshot->count) * sizeof(double));
}
