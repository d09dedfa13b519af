/* Sweep along x over the pieces' circles. */
#include "compute/piece_pairs.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Of the mean radius: a list then lasts some hundred steps of fast grains, and is no third longer
 * than without a skin. */
static const double SKIN_SHARE = 0.3;

typedef struct Entry {
    double low; /* m, where the piece's circle begins */
    int piece;
} Entry;

static int by_low(const void *a, const void *b)
{
    const Entry *x = a, *y = b;
    return x->low != y->low ? (x->low > y->low) - (x->low < y->low) : x->piece - y->piece;
}

static int by_pieces(const void *a, const void *b)
{
    const OzPiecePair *x = a, *y = b;
    return x->a != y->a ? (x->a > y->a) - (x->a < y->a) : (x->b > y->b) - (x->b < y->b);
}

static bool still_holds(const OzPiecePairs *pairs, const OzPieces *pieces, const double *position)
{
    double allowed = 0.25 * pairs->skin * pairs->skin;
    for (int64_t i = 0; pairs->position && i < pieces->count; i++) {
        double x = position[2 * i] - pairs->position[2 * i];
        double y = position[2 * i + 1] - pairs->position[2 * i + 1];
        if (x * x + y * y > allowed) {
            return false;
        }
    }
    return pairs->position != NULL;
}

static OzStatus add_pair(OzPiecePairs *pairs, int i, int j)
{
    if (pairs->count == pairs->capacity) {
        int64_t more = 2 * pairs->capacity + 64;
        OZ_PASS(oz_memory_grow((void **)&pairs->pair, (size_t)pairs->capacity, (size_t)more,
                               sizeof *pairs->pair, "pairs of pieces"));
        pairs->capacity = more;
    }
    pairs->pair[pairs->count++] = (OzPiecePair){i < j ? i : j, i < j ? j : i};
    return OZ_OK;
}

static bool may_touch(const OzPieces *pieces, const double *position, int i, int j, double skin)
{
    double x = position[2 * i] - position[2 * j], y = position[2 * i + 1] - position[2 * j + 1];
    double reach = pieces->reach[i] + pieces->reach[j] + skin;
    bool walls = i >= pieces->free_count && j >= pieces->free_count;
    return pieces->body[i] != pieces->body[j] && !walls && x * x + y * y < reach * reach;
}

static OzStatus sweep(OzPiecePairs *pairs, const OzPieces *pieces, const double *position,
                      Entry *entries)
{
    for (int64_t i = 0; i < pieces->count; i++) {
        entries[i] = (Entry){position[2 * i] - pieces->reach[i], (int)i};
    }
    qsort(entries, (size_t)pieces->count, sizeof *entries, by_low);
    for (int64_t i = 0; i < pieces->count; i++) {
        int one = entries[i].piece;
        double end = position[2 * one] + pieces->reach[one] + pairs->skin;
        for (int64_t j = i + 1; j < pieces->count && entries[j].low < end; j++) {
            if (may_touch(pieces, position, one, entries[j].piece, pairs->skin)) {
                OZ_PASS(add_pair(pairs, one, entries[j].piece));
            }
        }
    }
    return OZ_OK;
}

OzStatus oz_piece_pairs_renew(OzPiecePairs *pairs, const OzPieces *pieces, const double *position)
{
    OzStatus status = OZ_OK;
    Entry *entries = NULL;
    if (still_holds(pairs, pieces, position)) {
        goto done;
    }
    double reach = 0;
    for (int64_t i = 0; i < pieces->free_count; i++) {
        reach += pieces->reach[i] / (double)pieces->free_count;
    }
    pairs->skin = SKIN_SHARE * reach;
    pairs->count = 0;
    OZ_TRY(OZ_NEW(&entries, pieces->count));
    OZ_TRY(sweep(pairs, pieces, position, entries));
    if (pairs->count > 0) {
        qsort(pairs->pair, (size_t)pairs->count, sizeof *pairs->pair, by_pieces);
    }
    if (!pairs->position) {
        OZ_TRY(OZ_NEW(&pairs->position, 2 * pieces->count));
    }
    memcpy(pairs->position, position, 2 * (size_t)pieces->count * sizeof(double));
done:
    free(entries);
    return status;
}

void oz_piece_pairs_free(OzPiecePairs *pairs)
{
    free(pairs->pair);
    free(pairs->position);
    memset(pairs, 0, sizeof *pairs);
}
