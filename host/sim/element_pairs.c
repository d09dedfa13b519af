/* Sweep along x over the elements' circles. */
#include "sim/element_pairs.h"

#include "base/memory.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Of the mean radius: a list then lasts some hundred steps of fast grains, and is no third longer
 * than without a skin. */
static const double SKIN_SHARE = 0.3;

typedef struct Entry {
    double low; /* m, where the element's circle begins */
    int element;
} Entry;

static int by_low(const void *a, const void *b)
{
    const Entry *x = a, *y = b;
    return x->low != y->low ? (x->low > y->low) - (x->low < y->low) : x->element - y->element;
}

static int by_elements(const void *a, const void *b)
{
    const OzElementPair *x = a, *y = b;
    return x->a != y->a ? (x->a > y->a) - (x->a < y->a) : (x->b > y->b) - (x->b < y->b);
}

static bool still_holds(const OzElementPairs *pairs, const OzElements *elements,
                        const double *position)
{
    double allowed = 0.25 * pairs->skin * pairs->skin;
    for (int64_t i = 0; pairs->position && i < elements->count; i++) {
        double x = position[2 * i] - pairs->position[2 * i];
        double y = position[2 * i + 1] - pairs->position[2 * i + 1];
        if (x * x + y * y > allowed) {
            return false;
        }
    }
    return pairs->position != NULL;
}

static OzStatus add_pair(OzElementPairs *pairs, int i, int j)
{
    OZ_PASS(OZ_ROOM(&pairs->pair, &pairs->capacity, pairs->count + 1, "pairs of elements"));
    pairs->pair[pairs->count++] = (OzElementPair){i < j ? i : j, i < j ? j : i};
    return OZ_OK;
}

static bool may_touch(const OzElements *elements, const double *position, int i, int j, double skin)
{
    double x = position[2 * i] - position[2 * j], y = position[2 * i + 1] - position[2 * j + 1];
    double reach = elements->reach[i] + elements->reach[j] + skin;
    bool walls = i >= elements->free_count && j >= elements->free_count;
    return elements->body[i] != elements->body[j] && !walls && x * x + y * y < reach * reach;
}

static OzStatus sweep(OzElementPairs *pairs, const OzElements *elements, const double *position,
                      Entry *entries)
{
    for (int64_t i = 0; i < elements->count; i++) {
        entries[i] = (Entry){position[2 * i] - elements->reach[i], (int)i};
    }
    qsort(entries, (size_t)elements->count, sizeof *entries, by_low);
    for (int64_t i = 0; i < elements->count; i++) {
        int one = entries[i].element;
        double end = position[2 * one] + elements->reach[one] + pairs->skin;
        for (int64_t j = i + 1; j < elements->count && entries[j].low < end; j++) {
            if (may_touch(elements, position, one, entries[j].element, pairs->skin)) {
                OZ_PASS(add_pair(pairs, one, entries[j].element));
            }
        }
    }
    return OZ_OK;
}

OzStatus oz_element_pairs_renew(OzElementPairs *pairs, const OzElements *elements,
                                const double *position)
{
    OzStatus status = OZ_OK;
    Entry *entries = NULL;
    if (still_holds(pairs, elements, position)) {
        goto done;
    }
    double reach = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        reach += elements->reach[i] / (double)elements->free_count;
    }
    pairs->skin = SKIN_SHARE * reach;
    pairs->count = 0;
    OZ_TRY(OZ_NEW(&entries, elements->count));
    OZ_TRY(sweep(pairs, elements, position, entries));
    if (pairs->count > 0) {
        qsort(pairs->pair, (size_t)pairs->count, sizeof *pairs->pair, by_elements);
    }
    if (!pairs->position) {
        OZ_TRY(OZ_NEW(&pairs->position, 2 * elements->count));
    }
    memcpy(pairs->position, position, 2 * (size_t)elements->count * sizeof(double));
done:
    free(entries);
    return status;
}

void oz_element_pairs_free(OzElementPairs *pairs)
{
    free(pairs->pair);
    free(pairs->position);
    memset(pairs, 0, sizeof *pairs);
}
