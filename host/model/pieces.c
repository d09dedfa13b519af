/* Connected components of the graph of beams. */
#include "model/pieces.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The lowest element that hangs together with element i; shortens the way for the next who asks. */
static int root_of(int *parent, int i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void join(int *parent, int a, int b)
{
    int one = root_of(parent, a), other = root_of(parent, b);
    parent[one > other ? one : other] = one > other ? other : one;
}

OzStatus oz_pieces_find(int *body, int64_t *count, const OzElements *elements, const double *whole)
{
    int *parent = NULL;
    OZ_PASS(OZ_NEW(&parent, elements->free_count));
    for (int i = 0; i < (int)elements->free_count; i++) {
        parent[i] = i;
    }
    for (int64_t k = 0; k < elements->beam_count; k++) {
        if (whole[k] > 0) {
            join(parent, elements->beam_a[k], elements->beam_b[k]);
        }
    }
    *count = elements->grain_count;
    for (int i = 0; i < (int)elements->free_count; i++) {
        int root = root_of(parent, i), grain = elements->body[i];
        if (root != i) {
            body[i] = body[root];
        } else {
            body[i] = i == elements->first[grain] ? grain : (int)(*count)++;
        }
    }
    free(parent);
    return OZ_OK;
}

/* Members of every piece, by number; walls keep their elements. */
static void list_members(OzElements *pieces, const OzElements *from)
{
    int64_t count = pieces->grain_count, shift = count - from->grain_count;
    for (int64_t i = 0; i < pieces->free_count; i++) {
        pieces->first[pieces->body[i] + 1]++;
    }
    for (int64_t p = 0; p < count; p++) {
        pieces->first[p + 1] += pieces->first[p];
    }
    for (int64_t i = 0; i < pieces->free_count; i++) {
        pieces->member[pieces->first[pieces->body[i]]++] = (int)i;
    }
    for (int64_t p = count; p > 0; p--) {
        pieces->first[p] = pieces->first[p - 1];
    }
    pieces->first[0] = 0;
    for (int64_t w = 0; w <= pieces->wall_count; w++) {
        pieces->first[count + w] = from->first[from->grain_count + w];
    }
    for (int64_t i = pieces->free_count; i < pieces->count; i++) {
        pieces->body[i] = from->body[i] + (int)shift;
    }
}

/* The way along an edge of an element, as it was made. */
static void edge_of(const OzElements *elements, int i, int edge, double along[2])
{
    const double still[2] = {0, 0};
    double c[6];
    int next = (edge + 1) % 3;
    oz_elements_corners(elements, i, still, elements->angle[i], c);
    along[0] = c[2 * next] - c[2 * edge];
    along[1] = c[2 * next + 1] - c[2 * edge + 1];
}

/* Marks the edges that two joined elements share: alike, gone along in opposite directions, and no
 * outline. */
static void expose(int *edges, const OzElements *elements, int a, int b)
{
    const double alike = 1e-6; /* far above rounding, far below any grain's irregularity */
    int outer_a = oz_elements_outer_edges(elements, a);
    int outer_b = oz_elements_outer_edges(elements, b);
    for (int k = 0; k < 9; k++) {
        double one[2], other[2];
        int e = k / 3, f = k % 3;
        edge_of(elements, a, e, one);
        edge_of(elements, b, f, other);
        bool inner = !(outer_a >> e & 1) && !(outer_b >> f & 1);
        if (inner && hypot(one[0] + other[0], one[1] + other[1]) < alike * hypot(one[0], one[1])) {
            edges[a] |= 1 << e;
            edges[b] |= 1 << f;
        }
    }
}

/* Outlines of before, and where beams between what are now two pieces were. */
static OzStatus find_outlines(OzElements *pieces, const OzElements *from)
{
    int *edges = NULL;
    OZ_PASS(OZ_NEW(&edges, from->count));
    for (int64_t k = 0; k < from->outline_count; k++) {
        edges[from->outline_element[k]] |= 1 << from->outline_edge[k];
    }
    for (int64_t k = 0; k < from->beam_count; k++) {
        if (pieces->body[from->beam_a[k]] != pieces->body[from->beam_b[k]]) {
            expose(edges, from, from->beam_a[k], from->beam_b[k]);
        }
    }
    pieces->outline_count = 0;
    for (int64_t i = 0; i < from->count; i++) {
        for (int e = 0; e < 3; e++) {
            if (edges[i] >> e & 1) {
                pieces->outline_element[pieces->outline_count] = (int)i;
                pieces->outline_edge[pieces->outline_count++] = e;
            }
        }
    }
    free(edges);
    return OZ_OK;
}

/* Mass, and of what broke also size and inertia, as it lies now. */
static void weigh(OzGrains *pieces, const OzGrains *grains, int64_t p, const double *position)
{
    const OzElements *elements = pieces->elements;
    double mass = 0, at[2] = {0, 0}, inertia = 0, reach = 0;
    int64_t first = elements->first[p], end = elements->first[p + 1];
    int grain = grains->elements->body[elements->member[first]];
    pieces->population[p] = grains->population[grain];
    if (end - first == grains->elements->first[grain + 1] - grains->elements->first[grain]) {
        pieces->diameter[p] = grains->diameter[grain];
        pieces->mass[p] = grains->mass[grain];
        pieces->inertia[p] = pieces->inertia_axis[p] = grains->inertia[grain];
        return;
    }
    for (int64_t k = first; k < end; k++) {
        int i = elements->member[k];
        mass += elements->mass[i];
        at[0] += elements->mass[i] * position[2 * i];
        at[1] += elements->mass[i] * position[2 * i + 1];
    }
    for (int64_t k = first; k < end; k++) {
        int i = elements->member[k];
        double away = hypot(position[2 * i] - at[0] / mass, position[2 * i + 1] - at[1] / mass);
        inertia += elements->inertia[i] + elements->mass[i] * away * away;
        reach = fmax(reach, away + elements->reach[i]);
    }
    pieces->diameter[p] = 2 * reach;
    pieces->mass[p] = mass;
    pieces->inertia[p] = pieces->inertia_axis[p] = inertia;
}

/* A shell around the elements of `from`, with arrays of its own for what differs. */
static OzStatus create_elements(OzElements **out, const OzElements *from, const double *whole)
{
    OzElements *pieces = NULL;
    OZ_PASS(OZ_NEW(out, 1));
    pieces = *out;
    *pieces = *from;
    pieces->first = NULL;
    pieces->body = pieces->member = pieces->outline_element = pieces->outline_edge = NULL;
    OZ_PASS(OZ_NEW(&pieces->body, from->count));
    OZ_PASS(oz_pieces_find(pieces->body, &pieces->grain_count, from, whole));
    OZ_PASS(OZ_NEW(&pieces->first, pieces->grain_count + from->wall_count + 1));
    OZ_PASS(OZ_NEW(&pieces->member, from->free_count));
    OZ_PASS(OZ_NEW(&pieces->outline_element, 3 * from->count));
    OZ_PASS(OZ_NEW(&pieces->outline_edge, 3 * from->count));
    list_members(pieces, from);
    return find_outlines(pieces, from);
}

static void free_elements(OzElements *pieces)
{
    if (pieces) {
        free(pieces->first);
        free(pieces->body);
        free(pieces->member);
        free(pieces->outline_element);
        free(pieces->outline_edge);
        free(pieces);
    }
}

OzStatus oz_pieces_make(OzGrains **pieces, const OzGrains *grains, const double *whole,
                        const double *position)
{
    OzStatus status = OZ_OK;
    OzElements *elements = NULL;
    OzGrains *made = NULL;
    *pieces = NULL;
    OZ_TRY(create_elements(&elements, grains->elements, whole));
    OZ_TRY(OZ_NEW(&made, 1));
    OZ_TRY(oz_grains_create(made, elements->grain_count));
    made->elements = elements;
    elements = NULL;
    for (int64_t p = 0; p < made->count; p++) {
        weigh(made, grains, p, position);
    }
    *pieces = made;
    made = NULL;
done:
    free_elements(elements);
    oz_pieces_free(made);
    return status;
}

void oz_pieces_free(OzGrains *pieces)
{
    if (pieces) {
        free_elements(pieces->elements);
        pieces->elements = NULL;
        oz_grains_free(pieces);
        free(pieces);
    }
}
