/* Snapshot arrays. Knows nothing of where the state comes from. */
#include "observe/snapshot.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_snapshot_create(OzSnapshot *snapshot, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    int64_t count = grains->count;
    memset(snapshot, 0, sizeof *snapshot);
    snapshot->scene = scene;
    snapshot->grains = grains;
    snapshot->count = count;
    OZ_TRY(OZ_NEW(&snapshot->position, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->quaternion, 4 * count));
    OZ_TRY(OZ_NEW(&snapshot->axis, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->velocity, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->spin, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->wall_offset, scene->wall_count));
    OZ_TRY(OZ_NEW(&snapshot->wall_velocity, scene->wall_count));
done:
    if (status != OZ_OK) {
        oz_snapshot_free(snapshot);
    }
    return status;
}

void oz_snapshot_free(OzSnapshot *snapshot)
{
    free(snapshot->position);
    free(snapshot->quaternion);
    free(snapshot->axis);
    free(snapshot->velocity);
    free(snapshot->spin);
    free(snapshot->wall_offset);
    free(snapshot->wall_velocity);
    memset(snapshot, 0, sizeof *snapshot);
}

void oz_snapshot_move_walls(OzSnapshot *snapshot)
{
    const OzScene *scene = snapshot->scene;
    for (int w = 0; w < scene->wall_count; w++) {
        const OzMotion *motion = &scene->walls[w].motion;
        double rate = 2 * 3.14159265358979323846 * motion->frequency;
        bool moves = motion->present;
        snapshot->wall_offset[w] = moves ? motion->amplitude * sin(rate * snapshot->time) : 0;
        snapshot->wall_velocity[w] =
            moves ? motion->amplitude * rate * cos(rate * snapshot->time) : 0;
    }
}

void oz_snapshot_turn_axes(OzSnapshot *snapshot)
{
    for (int64_t i = 0; i < snapshot->count; i++) {
        oz_grains_axis(&snapshot->quaternion[4 * i], &snapshot->axis[3 * i]);
    }
}
