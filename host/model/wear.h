/* What has become of the beams of grains that can break or yield (`beams.strength`, `yield`), by
 * beam, and of the contacts that began where they broke (kernels/beam_strength.h), by pair of
 * triangles of one grain. Zeroed: a scene whose beams hold. */
#pragma once

#include "base/state.h"
#include "model/elements.h"

typedef struct OzWear {
    int64_t beam_count, scar_count, element_count; /* free elements */
    double *whole;       /* beam_count: 1, 0 once broken                                  */
    double *lost;        /* beam_count: J, that it stored when it broke                   */
    double *yielded;     /* beam_count: J, lost while it yielded                          */
    double *rest;        /* 3 x beam_count: length and angles at rest now, as those of elements */
    double *scar;        /* scar_count: root of m^3, least depth since the pair was parted */
    int64_t *scar_first; /* element_count: less i + 1, where the pairs of element i begin  */
    int64_t *scar_end;   /* element_count: the end of its grain's elements                 */
} OzWear;

/* Of pairs a < b of triangles of one grain: their number, and the index of one in `scar`, -1 where
 * they never were of one grain. */
int64_t oz_wear_scars(const OzElements *elements);
int64_t oz_wear_scar(const OzWear *wear, int64_t a, int64_t b);

/* Of grains as they were made, nothing broken; the caller frees (zeroed is fine). */
OzStatus oz_wear_create(OzWear *wear, const OzElements *elements);
void oz_wear_free(OzWear *wear);

/* Into one made for the same grains. */
void oz_wear_copy(OzWear *to, const OzWear *from);

/* Sums: beams that broke, and the energies that were lost so and by yielding. */
int64_t oz_wear_broken(const OzWear *wear);
double oz_wear_lost(const OzWear *wear);
double oz_wear_yielded(const OzWear *wear);

/* Saves or loads; nothing where beams hold. */
OzStatus oz_wear_state(OzWear *wear, OzStateVisit *visit);
