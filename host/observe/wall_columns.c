/* What walls bear and pistons do. */
#include "observe/wall_columns.h"

#include "model/servo_nature.h"
#include "scene/servo.h"

#include <string.h>

/* Rods are in space, trigrains in a plane, in which they turn about z. */
const char *oz_wall_columns_axes(OzColumnNeed need, const OzScene *scene)
{
    return scene->model == OZ_MODEL_RODS ? "xyz" : need == OZ_COLUMN_WALL_TURNS ? "z" : "xy";
}

static double of_wall(const OzObservation *o, OzColumnNeed need, double (*values)[3])
{
    const char *axes = oz_wall_columns_axes(need, o->snapshot->scene);
    int count = (int)strlen(axes);
    return values[o->index / count][axes[o->index % count] - 'x'];
}

bool oz_wall_columns_force(const OzObservation *o, double *value)
{
    *value = of_wall(o, OZ_COLUMN_WALLS, o->push->force);
    return o->push->is_known;
}

bool oz_wall_columns_torque(const OzObservation *o, double *value)
{
    *value = of_wall(o, OZ_COLUMN_WALL_TURNS, o->push->torque);
    return o->push->is_known;
}

int oz_wall_columns_servo(const OzScene *scene, int servo)
{
    int wall = 0;
    while (wall < scene->wall_count && oz_servo_number(scene, wall + 1) <= servo) {
        wall++;
    }
    return wall;
}

double oz_wall_columns_kinetic(const OzSnapshot *snapshot)
{
    double sum = 0;
    for (int w = 0; w < snapshot->scene->wall_count; w++) {
        if (snapshot->scene->walls[w].servo.present) {
            double v = snapshot->wall_velocity[w];
            sum += 0.5 * oz_servo_nature_of(snapshot->scene, snapshot->grains, w).mass * v * v;
        }
    }
    return sum;
}

static int wall_of(const OzObservation *o)
{
    return oz_wall_columns_servo(o->snapshot->scene, o->index);
}

bool oz_wall_columns_place(const OzObservation *o, double *value)
{
    *value = o->snapshot->wall_offset[wall_of(o)];
    return true;
}

bool oz_wall_columns_velocity(const OzObservation *o, double *value)
{
    *value = o->snapshot->wall_velocity[wall_of(o)];
    return true;
}

bool oz_wall_columns_servo_force(const OzObservation *o, double *value)
{
    *value = 0 - o->snapshot->wall_push[wall_of(o)];
    return true;
}

bool oz_wall_columns_pressure(const OzObservation *o, double *value)
{
    const OzSnapshot *s = o->snapshot;
    OzServoArea area;
    bool is_known = oz_servo_area_find(&area, s->scene, wall_of(o));
    if (is_known) {
        double now = oz_servo_area_now(&area, s->scene, s->wall_offset);
        *value = (0 - s->wall_push[wall_of(o)]) / now;
    }
    return is_known;
}
