/* Where cells lie, and how a point is spread over them. */
#include "observe/coarse_grid.h"

#include "base/memory.h"
#include "model/fill_region.h"
#include "scene/boundary.h"

#include <math.h>
#include <stdlib.h>

int64_t oz_coarse_grid_count(const OzCoarseGrid *grid)
{
    return grid->cells[0] * grid->cells[1] * grid->cells[2];
}

static double edge_of(const OzCoarseGrid *grid, int axis)
{
    return (grid->high[axis] - grid->low[axis]) / (double)grid->cells[axis];
}

double oz_coarse_grid_volume(const OzCoarseGrid *grid)
{
    return edge_of(grid, 0) * edge_of(grid, 1) * edge_of(grid, 2);
}

double oz_coarse_grid_middle(const OzCoarseGrid *grid, int axis, int64_t i)
{
    return grid->low[axis] + ((double)i + 0.5) * edge_of(grid, axis);
}

/* What the grains take up along an axis. */
static void find_extent(const OzSnapshot *s, int axis, double extent[2])
{
    extent[0] = INFINITY;
    extent[1] = -INFINITY;
    for (int64_t i = 0; i < s->count; i++) {
        double reach =
            0.5 * (s->grains->length[i] * fabs(s->axis[3 * i + axis]) + s->grains->diameter[i]);
        extent[0] = fmin(extent[0], s->position[3 * i + axis] - reach);
        extent[1] = fmax(extent[1], s->position[3 * i + axis] + reach);
    }
}

static void place_axis(OzCoarseGrid *grid, const OzSnapshot *snapshot, const OzFillRegion *room,
                       int axis)
{
    const OzFieldTable *fields = &snapshot->scene->fields;
    double extent[2], margin = 0;
    bool is_open = grid->period[axis] == 0 && !fields->has_range[axis];
    find_extent(snapshot, axis, extent);
    grid->low[axis] = room->walled_low[axis] ? room->low[axis] : extent[0];
    grid->high[axis] = room->walled_high[axis] ? room->high[axis] : extent[1];
    if (fields->has_range[axis]) {
        grid->low[axis] = fields->range[axis][0];
        grid->high[axis] = fields->range[axis][1];
    }
    if (!(grid->high[axis] > grid->low[axis])) { /* no grains, or all beyond the wall */
        grid->low[axis] = isfinite(grid->low[axis]) ? grid->low[axis] : 0;
        grid->high[axis] = grid->low[axis] + grid->width;
    }
    margin = is_open && !grid->is_whole[axis] ? grid->width : 0;
    grid->low[axis] -= margin;
    grid->high[axis] += margin;
}

OzCoarseGrid oz_coarse_grid_make(const OzScene *scene)
{
    OzCoarseGrid grid = {.width = scene->fields.width};
    for (int axis = 0; axis < 3; axis++) {
        grid.cells[axis] = scene->fields.cells[axis];
        grid.period[axis] = oz_boundary_period(&scene->boundary, axis);
        grid.is_whole[axis] = grid.cells[axis] == 1 && !scene->fields.has_range[axis];
    }
    return grid;
}

void oz_coarse_grid_place(OzCoarseGrid *grid, const OzSnapshot *snapshot)
{
    OzFillRegion room = oz_fill_region_make(snapshot->scene, 0, 0);
    for (int axis = 0; axis < 3; axis++) {
        place_axis(grid, snapshot, &room, axis);
    }
}

/* The integral of the polynomial from its middle to u, and 1/2. */
static inline double sum_to(double u)
{
    double t = u < 0 ? -u : u, half = 1.25 * t * (1 - t * t * (2 - t * (2 - 0.6 * t)));
    half = t < 1 ? half : 0.5;
    return u < 0 ? 0.5 - half : 0.5 + half;
}

/* The cell at so many edges from the first one's begin, or the one next to it. */
static inline int64_t cell_at(double edges, int64_t cells)
{
    return !(edges > 0) ? 0 : edges < (double)cells ? (int64_t)edges : cells - 1;
}

/* Of a point that lies within reach of the cells. Most of the time of a moment is spent here, and
 * no function of the C library is called. */
static OzStatus add_image(const OzCoarseGrid *grid, int axis, double at, OzCoarseShares *shares)
{
    double edge = edge_of(grid, axis), width = grid->width, from = grid->low[axis] - at;
    int64_t first = cell_at((-width - from) / edge, grid->cells[axis]);
    int64_t end = cell_at((width - from) / edge, grid->cells[axis]) + 1;
    if (shares->count + end - first > shares->capacity) {
        OZ_PASS(OZ_ROOM(&shares->of, &shares->capacity, shares->count + end - first, "cells"));
    }
    OzCoarseShare *next = &shares->of[shares->count];
    double step = edge / width, below = sum_to(from / width + (double)first * step);
    for (int64_t i = first; i < end; i++) {
        double above = sum_to(from / width + (double)(i + 1) * step);
        *next++ = (OzCoarseShare){i, above - below};
        below = above;
    }
    shares->count += end - first;
    return OZ_OK;
}

OzStatus oz_coarse_grid_share(const OzCoarseGrid *grid, int axis, double at, OzCoarseShares *shares)
{
    double period = grid->period[axis], first = 0, last = 0;
    shares->count = 0;
    if (grid->is_whole[axis]) {
        OZ_PASS(OZ_ROOM(&shares->of, &shares->capacity, 1, "cells"));
        shares->of[shares->count++] = (OzCoarseShare){0, 1};
        return OZ_OK;
    }
    if (period > 0) {
        first = ceil((grid->low[axis] - grid->width - at) / period);
        last = floor((grid->high[axis] + grid->width - at) / period);
    }
    for (double image = first; image <= last; image++) {
        OZ_PASS(add_image(grid, axis, at + image * period, shares));
    }
    return OZ_OK;
}

void oz_coarse_grid_free_shares(OzCoarseShares *shares)
{
    free(shares->of);
    *shares = (OzCoarseShares){0};
}
