/* Adding up what grains and contacts are. */
#include "observe/coarse_sums.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_coarse_sums_create(OzCoarseSums *sums, const OzCoarseGrid *grid, int64_t grains)
{
    *sums = (OzCoarseSums){.cells = oz_coarse_grid_count(grid)};
    OZ_PASS(OZ_NEW(&sums->cell, OZ_COARSE_COUNT * sums->cells));
    OZ_PASS(OZ_NEW(&sums->volume, sums->cells));
    return OZ_NEW(&sums->fabric, 6 * grains);
}

void oz_coarse_sums_free(OzCoarseSums *sums)
{
    free(sums->cell);
    free(sums->volume);
    free(sums->fabric);
    free(sums->points.of);
    for (int axis = 0; axis < 3; axis++) {
        oz_coarse_grid_free_shares(&sums->shares[axis]);
    }
    *sums = (OzCoarseSums){0};
}

static OzStatus find_shares(OzCoarseSums *sums, const OzCoarseGrid *grid, const double at[3])
{
    for (int axis = 0; axis < 3; axis++) {
        OZ_PASS(oz_coarse_grid_share(grid, axis, at[axis], &sums->shares[axis]));
    }
    return OZ_OK;
}

/* Where numbers go: `count` of every cell, from `at` on, `apart` from cell to cell. */
typedef struct Target {
    double *at;
    int apart, count;
} Target;

/* The words of cells from `first` to `last`. */
static Target words(const OzCoarseSums *sums, int first, int last)
{
    return (Target){&sums->cell[first], OZ_COARSE_COUNT, last + 1 - first};
}

/* Gives numbers to the cells that have shares of a point. */
static OzStatus spread(OzCoarseSums *sums, const OzCoarseGrid *grid, const double at[3], Target to,
                       const double *numbers)
{
    OZ_PASS(find_shares(sums, grid, at));
    const OzCoarseShares *x = &sums->shares[0], *y = &sums->shares[1], *z = &sums->shares[2];
    for (int64_t k = 0; k < z->count; k++) {
        for (int64_t j = 0; j < y->count; j++) {
            double slice = sums->per_volume * z->of[k].share * y->of[j].share;
            int64_t row = (z->of[k].cell * grid->cells[1] + y->of[j].cell) * grid->cells[0];
            for (int64_t i = 0; i < x->count; i++) {
                double share = slice * x->of[i].share;
                double *cell = &to.at[(row + x->of[i].cell) * to.apart];
                for (int n = 0; n < to.count; n++) {
                    cell[n] += share * numbers[n];
                }
            }
        }
    }
    return OZ_OK;
}

/* factor times v v, as xx, yy, zz, xy, yz, xz. */
static void set_square(double to[6], double factor, const double v[3])
{
    for (int k = 0; k < 3; k++) {
        to[k] = factor * v[k] * v[k];
        to[3 + k] = factor * v[k == 2 ? 0 : k] * v[k == 2 ? 2 : k + 1];
    }
}

/* All that a grain has at its centre. */
static OzStatus add_centre(OzCoarseSums *sums, const OzCoarseGrid *grid, const OzSnapshot *s,
                           int64_t i)
{
    double at[OZ_COARSE_COUNT];
    double mass = s->grains->mass[i], length = s->grains->length[i];
    const double *velocity = &s->velocity[3 * i];
    double volume = oz_grains_volume(s->grains->diameter[i], length);
    at[OZ_COARSE_MASS] = mass;
    at[OZ_COARSE_SHAFT] = length > 0 ? mass : 0;
    for (int k = 0; k < 3; k++) {
        at[OZ_COARSE_MOMENTUM + k] = mass * velocity[k];
    }
    for (int k = 0; k < 6; k++) {
        at[OZ_COARSE_FABRIC + k] = volume * sums->fabric[6 * i + k];
    }
    set_square(&at[OZ_COARSE_FLUX], mass, velocity);
    set_square(&at[OZ_COARSE_DIRECTION], at[OZ_COARSE_SHAFT], &s->axis[3 * i]);
    return spread(sums, grid, &s->position[3 * i],
                  words(sums, OZ_COARSE_MASS, OZ_COARSE_DIRECTION_END), &at[OZ_COARSE_MASS]);
}

static OzStatus add_volume(OzCoarseSums *sums, const OzCoarseGrid *grid, const OzSnapshot *s,
                           int64_t i)
{
    double diameter = s->grains->diameter[i], length = s->grains->length[i];
    double volume = oz_grains_volume(diameter, length);
    OZ_PASS(oz_coarse_body_fill(&sums->points, diameter, length, &s->axis[3 * i], grid->width));
    for (int64_t p = 0; p < sums->points.count; p++) {
        const OzCoarsePoint *point = &sums->points.of[p];
        double at[3], own = volume * point->share;
        for (int k = 0; k < 3; k++) {
            at[k] = s->position[3 * i + k] + point->at[k];
        }
        OZ_PASS(spread(sums, grid, at, (Target){sums->volume, 1, 1}, &own));
    }
    return OZ_OK;
}

/* The nearest image of a step from one place to another. */
static void nearest(const OzCoarseGrid *grid, double step[3])
{
    for (int k = 0; k < 3; k++) {
        double period = grid->period[k];
        step[k] -= period > 0 ? period * rint(step[k] / period) : 0;
    }
}

/* One grain's part of a contact: force is what it pushes the other body with. */
static OzStatus add_branch(OzCoarseSums *sums, const OzCoarseGrid *grid, const double centre[3],
                           const double point[3], const double force[3])
{
    static const double gauss[] = {-0.38729833462074168852, 0, 0.38729833462074168852};
    static const double weight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double branch[3], longest = 0;
    for (int k = 0; k < 3; k++) {
        branch[k] = point[k] - centre[k];
    }
    nearest(grid, branch);
    for (int k = 0; k < 3; k++) {
        longest = fmax(longest, fabs(branch[k]));
    }
    int pieces = (int)fmin(fmax(ceil(2 * longest / grid->width), 1), 1000);
    for (int n = 0; n < 3 * pieces; n++) {
        double along = (n / 3 + 0.5 + gauss[n % 3]) / pieces, at[3], stress[9];
        for (int k = 0; k < 3; k++) {
            at[k] = centre[k] + along * branch[k];
        }
        for (int k = 0; k < 9; k++) {
            stress[k] = weight[n % 3] / pieces * force[k / 3] * branch[k % 3];
        }
        OZ_PASS(
            spread(sums, grid, at, words(sums, OZ_COARSE_CONTACT, OZ_COARSE_CONTACT_END), stress));
    }
    return OZ_OK;
}

static OzStatus add_contact(OzCoarseSums *sums, const OzCoarseGrid *grid, const OzSnapshot *s,
                            const OzContactEntry *e)
{
    double force[3], back[3], square[6];
    set_square(square, 1, e->normal);
    for (int k = 0; k < 3; k++) {
        force[k] = e->push * e->normal[k] + e->tangential[k];
        back[k] = -force[k];
    }
    for (int k = 0; k < 6; k++) {
        sums->fabric[6 * (int64_t)e->a + k] += square[k];
        sums->fabric[6 * (int64_t)(e->b < 0 ? e->a : e->b) + k] += e->b < 0 ? 0 : square[k];
    }
    OZ_PASS(add_branch(sums, grid, &s->position[3 * (int64_t)e->a], e->point, force));
    return e->b < 0
               ? spread(sums, grid, e->point, words(sums, OZ_COARSE_WALL, OZ_COARSE_WALL_END), back)
               : add_branch(sums, grid, &s->position[3 * (int64_t)e->b], e->point, back);
}

OzStatus oz_coarse_sums_fill(OzCoarseSums *sums, const OzCoarseGrid *grid,
                             const OzSnapshot *snapshot)
{
    sums->per_volume = 1 / oz_coarse_grid_volume(grid);
    memset(sums->cell, 0, (size_t)(OZ_COARSE_COUNT * sums->cells) * sizeof *sums->cell);
    memset(sums->volume, 0, (size_t)sums->cells * sizeof *sums->volume);
    memset(sums->fabric, 0, (size_t)(6 * snapshot->count) * sizeof *sums->fabric);
    for (int64_t c = 0; c < snapshot->contacts.count; c++) {
        OZ_PASS(add_contact(sums, grid, snapshot, &snapshot->contacts.entry[c]));
    }
    for (int64_t i = 0; i < snapshot->count; i++) {
        OZ_PASS(add_centre(sums, grid, snapshot, i));
        OZ_PASS(add_volume(sums, grid, snapshot, i));
    }
    for (int64_t i = 0; i < sums->cells; i++) {
        sums->cell[i * OZ_COARSE_COUNT + OZ_COARSE_VOLUME] = sums->volume[i];
    }
    return OZ_OK;
}
