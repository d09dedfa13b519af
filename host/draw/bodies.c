/* Grains as the camera sees them, sorted by depth. */
#include "draw/bodies.h"

#include "base/memory.h"
#include "draw/palette.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float CHAIN[3] = {0.70f, 0.13f, 0.10f};

/* Between chains grains are drawn so thin, of their own width. */
static const double THIN = 0.35;

static void free_bodies(OzBodies *bodies)
{
    free(bodies->bodies);
    free(bodies->grains);
    free(bodies->unsorted);
    bodies->bodies = bodies->unsorted = NULL;
    bodies->grains = NULL;
    bodies->capacity = 0;
}

void oz_bodies_free(OzBodies *bodies)
{
    free_bodies(bodies);
    oz_local_order_free(&bodies->order);
    oz_pressed_free(&bodies->pressed);
    memset(bodies, 0, sizeof *bodies);
}

void oz_bodies_colour(const OzBodies *bodies, int64_t k, float rgb[3])
{
    const OzLook *look = bodies->look;
    const double *share =
        look->colour == OZ_COLOUR_ORDER ? bodies->order.crystal : bodies->pressed.share;
    if (bodies->grains[k] < bodies->snapshot->count) {
        oz_palette_grain(bodies->snapshot, look, share, bodies->grains[k], rgb);
    } else {
        memcpy(rgb, CHAIN, sizeof CHAIN);
    }
}

static OzStatus fit(OzBodies *bodies, int64_t count)
{
    if (count <= bodies->capacity && bodies->bodies) {
        return OZ_OK;
    }
    free_bodies(bodies);
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

static OzBody body_of(const OzSnapshot *snapshot, const OzCamera *camera, bool is_thin, int64_t i)
{
    double width = is_thin ? THIN : 1;
    OzBody body = {.radius = (float)(0.5 * width * snapshot->grains->diameter[i] / camera->unit),
                   .half_shaft = (float)(0.5 * snapshot->grains->length[i] / camera->unit)};
    double place[3], centre[3], axis[3];
    oz_snapshot_place(snapshot, i, place);
    oz_camera_see(camera, place, centre);
    oz_camera_turn(camera, &snapshot->axis[3 * i], axis);
    for (int k = 0; k < 3; k++) {
        body.centre[k] = (float)centre[k];
        body.axis[k] = (float)axis[k];
    }
    return body;
}

static OzBody chain_of(const OzChain *chain, const OzCamera *camera, double width)
{
    OzBody body = {.radius = (float)(0.5 * width / camera->unit)};
    double ends[2][3], half[3], length = 0;
    oz_camera_see(camera, chain->from, ends[0]);
    oz_camera_see(camera, chain->to, ends[1]);
    for (int k = 0; k < 3; k++) {
        half[k] = 0.5 * (ends[1][k] - ends[0][k]);
        length += half[k] * half[k];
    }
    length = fmax(sqrt(length), 1e-12);
    for (int k = 0; k < 3; k++) {
        body.centre[k] = (float)(0.5 * (ends[0][k] + ends[1][k]));
        body.axis[k] = (float)(half[k] / length);
    }
    body.half_shaft = (float)length;
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

static void add_chains(OzBodies *bodies)
{
    const OzSnapshot *snapshot = bodies->snapshot;
    double diameter = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        diameter += snapshot->grains->diameter[i] / (double)snapshot->count;
    }
    for (int64_t i = 0; i < bodies->pressed.chain_count; i++) {
        const OzChain *chain = &bodies->pressed.chains[i];
        OzBody *body = &bodies->unsorted[snapshot->count + i];
        *body = chain_of(chain, bodies->camera, diameter * oz_pressed_width(chain, bodies->look));
        reach_for(bodies, body);
    }
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
    OZ_PASS(oz_pressed_find(&bodies->pressed, snapshot, look));
    OZ_PASS(fit(bodies, snapshot->count + bodies->pressed.chain_count));
    if (look->colour == OZ_COLOUR_ORDER) {
        OZ_PASS(oz_local_order_find(&bodies->order, snapshot));
    }
    bodies->snapshot = snapshot;
    bodies->look = look;
    bodies->camera = camera;
    bodies->count = snapshot->count + bodies->pressed.chain_count;
    find_cut(bodies);
    memset(bodies->low, 0, sizeof bodies->low);
    memset(bodies->high, 0, sizeof bodies->high);
    for (int64_t i = 0; i < snapshot->count; i++) {
        bodies->unsorted[i] = body_of(snapshot, camera, look->chains, i);
        reach_for(bodies, &bodies->unsorted[i]);
    }
    add_chains(bodies);
    return sort_by_depth(bodies);
}

OzBox oz_bodies_box(const OzBodies *bodies, int view, double container_high)
{
    const double high[2] = {bodies->high[0], fmax(bodies->high[1], container_high)};
    return oz_camera_box(bodies->camera, bodies->look, view, bodies->low, high);
}
