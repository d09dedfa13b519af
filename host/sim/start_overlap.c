/* Counting overlaps at the start, of any model. */
#include "sim/start_overlap.h"

#include <math.h>

/* A force chain bears some three times the mean load (Radjai et al. 1996: forces fall off
 * exponentially above the mean, by 1.4 a mean). */
static const double chain = 3;

double oz_start_overlap_load(const OzScene *scene, const OzGrains *grains)
{
    const double *g = scene->gravity;
    double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    double low = INFINITY, high = -INFINITY, mass = 0, diameter = INFINITY;
    for (int64_t i = 0; i < grains->count; i++) {
        const double *x = &grains->position[3 * i];
        double height = size > 0 ? -(g[0] * x[0] + g[1] * x[1] + g[2] * x[2]) / size : 0;
        low = fmin(low, height);
        high = fmax(high, height);
        mass = fmax(mass, grains->mass[i]);
        diameter = fmin(diameter, grains->diameter[i]);
    }
    return grains->count > 0 ? chain * mass * size * (1 + (high - low) / diameter) : 0;
}

void oz_start_overlap_add(OzStart *start, const OzStartOverlap *overlap, double most, bool refuse)
{
    bool refused = refuse || overlap->share > most;
    start->count++;
    if ((refused && start->refused == 0) ||
        (overlap->share > start->worst.share && refused == (start->refused > 0))) {
        start->worst = *overlap;
    }
    start->refused += refused;
}
