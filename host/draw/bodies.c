/* Grains as the camera sees them, sorted by depth. */
#include "draw/bodies.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void oz_bodies_free(OzBodies *bodies)
{
    free(bodies->bodies);
    free(bodies->grains);
    free(bodies->unsorted);
    oz_local_order_free(&bodies->order);
    memset(bodies, 0, sizeof *bodies);
}

static OzStatus fit(OzBodies *bodies, int64_t count)
{
    if (count <= bodies->capacity && bodies->bodies) {
        return OZ_OK;
    }
    oz_bodies_free(bodies);
    OZ_PASS(OZ_NEW(&bodies->bodies, count));
    OZ_PASS(OZ_NEW(&bodies->grains, count));
    OZ_PASS(OZ_NEW(&bodies->unsorted, count));
    bodies->capacity = count;
    return OZ_OK;
}

OzSide oz_bodies_side(const OzBodies *bodies, OzView view, int64_t k)
{
    if (view != OZ_VIEW_CUT) {
        return OZ_SIDE_BEHIND;
    }
    const OzBody *body = &bodies->bodies[k];
    double middle = -bodies->offset, rise = 0;
    for (int c = 0; c < 3; c++) {
        middle += bodies->inward[c] * (double)body->centre[c];
        rise += bodies->inward[c] * (double)body->axis[c];
    }
    double reach = (double)body->radius + (double)body->half_shaft * fabs(rise);
    if (middle >= reach) {
        return OZ_SIDE_BEHIND;
    }
    return middle > -reach ? OZ_SIDE_CROSSING : OZ_SIDE_FRONT;
}

static OzBody body_of(const OzSnapshot *snapshot, const OzCamera *camera, int64_t i)
{
    OzBody body = {.radius = (float)(0.5 * snapshot->grains->diameter[i] / camera->unit),
                   .half_shaft = (float)(0.5 * snapshot->grains->length[i] / camera->unit)};
    double centre[3], axis[3];
    oz_camera_see(camera, &snapshot->position[3 * i], centre);
    oz_camera_turn(camera, &snapshot->axis[3 * i], axis);
    for (int k = 0; k < 3; k++) {
        body.centre[k] = (float)centre[k];
        body.axis[k] = (float)axis[k];
    }
    return body;
}

/* Widens the reach by a grain, with room for its looking larger in front. */
static void reach_for(OzBodies *bodies, const OzBody *body)
{
    double distance = bodies->camera->distance;
    double radius = (double)body->radius + (double)body->half_shaft;
    double gap = distance - (double)body->centre[2] - radius;
    double nearer = distance / fmax(gap, 0.1 * distance);
    for (int k = 0; k < 2; k++) {
        double middle = nearer * (double)body->centre[k];
        bodies->low[k] = fmin(bodies->low[k], middle - nearer * radius);
        bodies->high[k] = fmax(bodies->high[k], middle + nearer * radius);
    }
}

/* In buckets of equal depth by counting, each in the grains' order. */
static OzStatus sort_by_depth(OzBodies *bodies)
{
    enum { BUCKETS = 1 << 14 };
    int64_t count = bodies->count, *starts = NULL, sum = 0;
    double depth = bodies->camera->depth;
    OZ_PASS(OZ_NEW(&starts, BUCKETS));
    for (int pass = 0; pass < 2; pass++) {
        for (int64_t i = 0; i < count; i++) {
            double share = 0.5 - 0.5 * (double)bodies->unsorted[i].centre[2] / depth;
            int64_t *start = &starts[(int)(fmin(fmax(share, 0), 1) * (BUCKETS - 1))];
            if (pass == 1) {
                bodies->grains[*start] = i;
                bodies->bodies[*start] = bodies->unsorted[i];
            }
            ++*start;
        }
        for (int b = 0; pass == 0 && b < BUCKETS; b++) {
            int64_t own = starts[b];
            starts[b] = sum;
            sum += own;
        }
    }
    free(starts);
    return OZ_OK;
}

static void find_cut(OzBodies *bodies)
{
    const OzLook *look = bodies->look;
    const OzCamera *camera = bodies->camera;
    double cut[3] = {look->centre[0], look->cut, camera->centre[2]}, on_plane[3];
    oz_camera_see(camera, cut, on_plane);
    oz_camera_turn(camera, (const double[3]){0, 1, 0}, bodies->inward);
    bodies->offset = 0;
    for (int k = 0; k < 3; k++) {
        bodies->offset += bodies->inward[k] * on_plane[k];
    }
}

OzStatus oz_bodies_take(OzBodies *bodies, const OzSnapshot *snapshot, const OzLook *look,
                        const OzCamera *camera)
{
    OZ_PASS(fit(bodies, snapshot->count));
    if (look->colour == OZ_COLOUR_ORDER) {
        OZ_PASS(oz_local_order_find(&bodies->order, snapshot));
    }
    bodies->snapshot = snapshot;
    bodies->look = look;
    bodies->camera = camera;
    bodies->count = snapshot->count;
    find_cut(bodies);
    memset(bodies->low, 0, sizeof bodies->low);
    memset(bodies->high, 0, sizeof bodies->high);
    for (int64_t i = 0; i < snapshot->count; i++) {
        bodies->unsorted[i] = body_of(snapshot, camera, i);
        reach_for(bodies, &bodies->unsorted[i]);
    }
    return sort_by_depth(bodies);
}

OzBox oz_bodies_box(const OzBodies *bodies, int view, double container_high)
{
    const double high[2] = {bodies->high[0], fmax(bodies->high[1], container_high)};
    return oz_camera_box(bodies->camera, bodies->look, view, bodies->low, high);
}
