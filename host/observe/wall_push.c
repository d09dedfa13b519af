/* Forces on walls. */
#include "observe/wall_push.h"

#include "base/memory.h"
#include "scene/wall_swing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void oz_wall_push_free(OzWallPush *push)
{
    free(push->force);
    free(push->torque);
    free(push->point);
    free(push->impulse);
    memset(push, 0, sizeof *push);
}

OzStatus oz_wall_push_take(OzWallPush *push, const OzScene *scene)
{
    if (push->kind == scene->observe.walls) {
        return OZ_OK;
    }
    oz_wall_push_free(push);
    push->kind = scene->observe.walls;
    push->since = NAN;
    if (push->kind == OZ_OBSERVE_WALLS_NONE) {
        return OZ_OK;
    }
    push->count = scene->wall_count;
    OZ_PASS(OZ_NEW(&push->force, push->count));
    OZ_PASS(OZ_NEW(&push->torque, push->count));
    OZ_PASS(OZ_NEW(&push->point, push->count));
    return OZ_NEW(&push->impulse, push->count);
}

static void see_instant(OzWallPush *push, const OzSnapshot *now)
{
    push->is_known = now->has_contacts;
    for (int w = 0; w < push->count; w++) {
        const OzWall *wall = &now->scene->walls[w];
        double shift[3], flat[3] = {0, now->wall_offset[w], 0};
        OzWall turned = oz_wall_swing_turned(wall, oz_snapshot_turn(now, w));
        oz_wall_shape_shift(wall, now->wall_offset[w], shift);
        for (int k = 0; k < 3; k++) {
            bool in_plane = now->scene->model == OZ_MODEL_TRIGRAINS;
            push->point[w][k] = turned.point[k] + (in_plane ? flat[k] : shift[k]);
        }
    }
    oz_contact_list_push_walls(&now->contacts, push->force, push->count);
    oz_contact_list_turn_walls(&now->contacts, (const double(*)[3])push->point, push->torque,
                               push->count);
}

static void see_mean(OzWallPush *push, const OzSnapshot *now)
{
    double time = now->time - push->since;
    push->is_known = now->has_wall_impulse && time > 0;
    if (!now->has_wall_impulse) {
        return;
    }
    for (int w = 0; push->is_known && w < push->count; w++) {
        const double *to = now->wall_impulse[w], *from = push->impulse[w];
        for (int k = 0; k < 3; k++) {
            push->force[w][k] = (to[k] - from[k]) / time;
            push->torque[w][k] = (to[3 + k] - from[3 + k]) / time;
        }
    }
    memcpy(push->impulse, now->wall_impulse, (size_t)push->count * sizeof *push->impulse);
    push->since = now->time;
}

void oz_wall_push_see(OzWallPush *push, const OzSnapshot *now)
{
    if (push->kind == OZ_OBSERVE_WALLS_MEAN) {
        see_mean(push, now);
    } else if (push->kind == OZ_OBSERVE_WALLS_INSTANT) {
        see_instant(push, now);
    }
}

OzStatus oz_wall_push_state(OzWallPush *push, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "wall_push", 1));
    if (push->kind == OZ_OBSERVE_WALLS_MEAN) {
        OZ_PASS(oz_state_double(visit, "since", "s", &push->since, 1));
        OZ_PASS(oz_state_double(visit, "impulse", "N s and N m s",
                                push->impulse ? push->impulse[0] : NULL, 6 * (int64_t)push->count));
    }
    oz_state_leave(visit);
    return OZ_OK;
}
