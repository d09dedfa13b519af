/* Parting grains on the host. */
#include "sim/element_part.h"

#include "base/memory.h"
#include "sim/element_overlap.h"

#include <math.h>
#include <string.h>

static OzTriangle triangle_at(const OzElements *elements, int i, const double *at, double angle)
{
    double corners[6];
    OzTriangle t;
    oz_elements_corners(elements, i, at, angle, corners);
    for (int k = 0; k < 3; k++) {
        t.corner[k] = oz_vec2(corners[2 * k], corners[2 * k + 1]);
    }
    return t;
}

/* Root of the integral of depth over the overlap of two elements, m^1.5. */
static double depth_of(const OzElements *elements, const double *x, const double *angle, int a,
                       int b)
{
    const double still[2] = {0, 0}, apart[2] = {x[2 * b] - x[2 * a], x[2 * b + 1] - x[2 * a + 1]};
    if (hypot(apart[0], apart[1]) >= elements->reach[a] + elements->reach[b]) {
        return 0;
    }
    OzTriangle one = triangle_at(elements, a, still, angle[a]);
    OzTriangle other = triangle_at(elements, b, apart, angle[b]);
    return sqrt(fmax(oz_element_overlap_find(elements, a, b, &one, &other).energy, 0));
}

void oz_element_part_contacts(OzWear *wear, const OzScene *scene, const OzElements *elements,
                              const double *position, const double *angle, OzElementParting parting)
{
    OZ_USE_SWITCHES(oz_host_switches_elements(scene));
    const int *before = parting.before, *after = parting.after;
    for (int a = 0; a < (int)wear->element_count; a++) {
        for (int b = a + 1; b < (int)wear->scar_end[a]; b++) {
            if (before[a] == before[b] && after[a] != after[b]) {
                wear->scar[oz_wear_scar(wear, a, b)] = depth_of(elements, position, angle, a, b);
            }
        }
    }
}

OzStatus oz_element_part_grains(OzElementForces *forces, const OzGrains *grains,
                                const OzElementState *state)
{
    OzGrains *pieces = NULL;
    const int *before = forces->elements->body;
    size_t bytes = (size_t)grains->elements->free_count * sizeof *before;
    forces->broke = false;
    OZ_PASS(oz_pieces_make(&pieces, grains, forces->wear->whole, state->position));
    if (memcmp(before, pieces->elements->body, bytes) == 0) {
        oz_pieces_free(pieces);
        return OZ_OK;
    }
    oz_element_part_contacts(forces->wear, forces->scene, grains->elements, state->position,
                             state->angle, (OzElementParting){before, pieces->elements->body});
    oz_element_pairs_free(&forces->pairs); /* they are of other bodies */
    oz_pieces_free(forces->pieces);
    forces->pieces = pieces;
    forces->elements = pieces->elements;
    return OZ_OK;
}
