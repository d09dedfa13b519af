/* Rods are sorted into cells as wide as two of them can be apart as neighbours, so that each looks
 * at its own cell and those around it. Knows no columns and no colours. */
#include "model/local_order.h"

#include "base/memory.h"
#include "scene/boundary.h"
#include "scene/wall_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells: counts along each direction, from low on. */
typedef struct Cells {
    double low[3], size[3];
    int64_t count[3];
    double period[3]; /* m, after which places repeat themselves along the direction; 0: never */
} Cells;

/* What a rod's neighbours add up to. */
typedef struct Sums {
    double cosine, sine; /* of 6 theta */
    double parallel;     /* (3 (u.u_k)^2 - 1)/2 */
    int count;
} Sums;

void oz_local_order_axis(const OzScene *scene, double axis[3])
{
    axis[0] = axis[1] = 0;
    axis[2] = 1;
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].kind == OZ_WALL_CYLINDER) {
            oz_wall_shape_axis(&scene->walls[w], axis);
            return;
        }
    }
}

void oz_local_order_free(OzLocalOrder *order)
{
    free(order->psi6);
    free(order->crystal);
    free(order->place);
    free(order->next);
    free(order->heads);
    memset(order, 0, sizeof *order);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool is_rod(const OzSnapshot *snapshot, int64_t i)
{
    return snapshot->grains->length[i] > 0;
}

static OzStatus fit(OzLocalOrder *order, int64_t count)
{
    if (count <= order->capacity && order->psi6) {
        return OZ_OK;
    }
    oz_local_order_free(order);
    OZ_PASS(OZ_NEW(&order->psi6, count));
    OZ_PASS(OZ_NEW(&order->crystal, count));
    OZ_PASS(OZ_NEW(&order->place, 3 * count));
    OZ_PASS(OZ_NEW(&order->next, count));
    order->capacity = count;
    return OZ_OK;
}

static double height_of(const OzSnapshot *snapshot, const double axis[3], int64_t i)
{
    return snapshot->grains->length[i] * fabs(dot(&snapshot->axis[3 * i], axis)) +
           snapshot->grains->diameter[i];
}

/* Along a direction of the container, which in a periodic cell is one of the cell's own. */
static double period_along(const OzBoundary *boundary, const double direction[3])
{
    double period = 0;
    for (int k = 0; k < 3; k++) {
        period = fabs(direction[k]) > 0.5 ? oz_boundary_period(boundary, k) : period;
    }
    return period;
}

/* Cells between low and high along direction k, as many as grains at most have room beside each
 * other, and whole ones in a period. */
static void cut_into_cells(Cells *cells, int k, double high, double reach, double most)
{
    double length = high - cells->low[k];
    cells->size[k] = fmax(reach * (1 + 1e-9), length / most);
    double count = floor(length / cells->size[k]) + (cells->period[k] == 0);
    cells->count[k] = count >= 1 && count <= most + 1 ? (int64_t)count : 1; /* of NaN too */
    if (cells->period[k] > 0) {
        cells->size[k] = length / (double)cells->count[k];
    }
}

/* The places of all grains in the container's own directions, and cells for them: no smaller than
 * neighbours can be apart, and about as many as grains at most. */
static Cells find_cells(OzLocalOrder *order, const OzSnapshot *snapshot, const double axis[3])
{
    double across[2][3], high[3] = {-INFINITY, -INFINITY, -INFINITY}, reach[3] = {0};
    const double *direction[3] = {across[0], across[1], axis};
    Cells cells = {.low = {INFINITY, INFINITY, INFINITY}};
    oz_wall_shape_across(axis, across[0], across[1]);
    for (int64_t i = 0; i < snapshot->count; i++) {
        double *place = &order->place[3 * i], within[3];
        oz_snapshot_place(snapshot, i, within);
        reach[0] = fmax(reach[0], OZ_LOCAL_ORDER_REACH * snapshot->grains->diameter[i]);
        reach[2] = fmax(reach[2], height_of(snapshot, axis, i) / 2);
        for (int k = 0; k < 3; k++) {
            place[k] = dot(within, direction[k]);
            cells.low[k] = fmin(cells.low[k], place[k]);
            high[k] = fmax(high[k], place[k]);
        }
    }
    reach[1] = reach[0];
    for (int k = 0; k < 3; k++) {
        cells.period[k] = period_along(&snapshot->scene->boundary, direction[k]);
        if (cells.period[k] > 0) {
            cells.low[k] = -cells.period[k] / 2;
            high[k] = cells.period[k] / 2;
        }
        cut_into_cells(&cells, k, high[k], reach[k], 2 + cbrt((double)snapshot->count));
    }
    return cells;
}

/* The cell of a place along one direction; a NaN lies in the first. */
static int64_t cell_of(const Cells *cells, const double place[3], int k)
{
    double cell = floor((place[k] - cells->low[k]) / cells->size[k]);
    int64_t last = cells->count[k] - 1;
    return cell >= 0 ? (cell < (double)last ? (int64_t)cell : last) : 0;
}

static int64_t index_of(const Cells *cells, const int64_t cell[3])
{
    return (cell[2] * cells->count[1] + cell[1]) * cells->count[0] + cell[0];
}

static OzStatus sort_into_cells(OzLocalOrder *order, const OzSnapshot *snapshot, const Cells *cells)
{
    int64_t count = cells->count[0] * cells->count[1] * cells->count[2];
    if (count > order->head_capacity) {
        free(order->heads);
        order->head_capacity = 0;
        OZ_PASS(OZ_NEW(&order->heads, count));
        order->head_capacity = count;
    }
    for (int64_t c = 0; c < count; c++) {
        order->heads[c] = -1;
    }
    for (int64_t i = snapshot->count - 1; i >= 0; i--) {
        const double *place = &order->place[3 * i];
        int64_t cell[3] = {cell_of(cells, place, 0), cell_of(cells, place, 1),
                           cell_of(cells, place, 2)};
        if (is_rod(snapshot, i)) {
            int64_t *head = &order->heads[index_of(cells, cell)];
            order->next[i] = *head;
            *head = i;
        }
    }
    return OZ_OK;
}

/* To the nearest image. */
static double way_along(const OzLocalOrder *order, const Cells *cells, int k, int64_t from,
                        int64_t to)
{
    double way = order->place[3 * to + k] - order->place[3 * from + k];
    double period = cells->period[k];
    return period > 0 ? way - period * round(way / period) : way;
}

static void add_neighbour(Sums *sums, const OzLocalOrder *order, const OzSnapshot *snapshot,
                          const Cells *cells, const double axis[3], int64_t i, int64_t k)
{
    const double *d = snapshot->grains->diameter;
    double x = way_along(order, cells, 0, i, k), y = way_along(order, cells, 1, i, k);
    double up = way_along(order, cells, 2, i, k);
    double height = (height_of(snapshot, axis, i) + height_of(snapshot, axis, k)) / 2;
    double reach = OZ_LOCAL_ORDER_REACH * (d[i] + d[k]) / 2;
    if (i == k || fabs(up) > height / 2 || !(x * x + y * y <= reach * reach)) {
        return;
    }
    double theta = atan2(y, x);
    double along = dot(&snapshot->axis[3 * i], &snapshot->axis[3 * k]);
    sums->cosine += cos(6 * theta);
    sums->sine += sin(6 * theta);
    sums->parallel += (3 * along * along - 1) / 2;
    sums->count++;
}

/* The cells around one along direction k, each of them once. */
static int cells_around(const Cells *cells, int k, int64_t own, int64_t around[3])
{
    int found = 0;
    for (int64_t cell = own - 1; cell <= own + 1; cell++) {
        int64_t count = cells->count[k], inside = (cell + count) % count;
        bool is_there = cells->period[k] > 0 || inside == cell;
        for (int f = 0; f < found; f++) {
            is_there &= around[f] != inside;
        }
        if (is_there) {
            around[found++] = inside;
        }
    }
    return found;
}

static Sums add_neighbours(const OzLocalOrder *order, const OzSnapshot *snapshot,
                           const Cells *cells, const double axis[3], int64_t i)
{
    Sums sums = {0};
    int64_t around[3][3];
    int found[3];
    for (int k = 0; k < 3; k++) {
        found[k] = cells_around(cells, k, cell_of(cells, &order->place[3 * i], k), around[k]);
    }
    for (int n = 0; n < found[0] * found[1] * found[2]; n++) {
        int64_t cell[3] = {around[0][n % found[0]], around[1][n / found[0] % found[1]],
                           around[2][n / found[0] / found[1]]};
        for (int64_t k = order->heads[index_of(cells, cell)]; k >= 0; k = order->next[k]) {
            add_neighbour(&sums, order, snapshot, cells, axis, i, k);
        }
    }
    return sums;
}

OzStatus oz_local_order_find(OzLocalOrder *order, const OzSnapshot *snapshot)
{
    double axis[3];
    oz_local_order_axis(snapshot->scene, axis);
    OZ_PASS(fit(order, snapshot->count));
    Cells cells = find_cells(order, snapshot, axis);
    OZ_PASS(sort_into_cells(order, snapshot, &cells));
    for (int64_t i = 0; i < snapshot->count; i++) {
        order->psi6[i] = order->crystal[i] = 0;
        if (is_rod(snapshot, i)) {
            Sums sums = add_neighbours(order, snapshot, &cells, axis, i);
            bool enough = sums.count >= OZ_LOCAL_ORDER_LEAST;
            double psi6 = enough ? hypot(sums.cosine, sums.sine) / sums.count : 0;
            order->psi6[i] = psi6;
            order->crystal[i] = enough ? psi6 * fmax(sums.parallel / sums.count, 0) : 0;
        }
    }
    return OZ_OK;
}
