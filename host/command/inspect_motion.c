/* A line a motion. */
#include "command/inspect_motion.h"

#include "model/motion.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static void print_shaken(FILE *file, int w, const OzScene *scene)
{
    const OzMotion *motion = &scene->walls[w].motion;
    double d[3];
    oz_motion_direction(motion, d);
    fprintf(file, "wall %d             moves %.6g m ", w, motion->amplitude);
    if (scene->model == OZ_MODEL_TRIGRAINS || d[2] == 1) {
        fputs("up and down", file);
    } else {
        fprintf(file, "along [%.3g, %.3g, %.3g] and back", d[0], d[1], d[2]);
    }
    fprintf(file, " at %g Hz: %.4g times gravity", motion->frequency, motion->acceleration_ratio);
    if (motion->phase != 0) {
        fprintf(file, "; from %g degrees on", motion->phase);
    }
    if (motion->from > 0 || motion->until > 0) {
        fprintf(file, "; from %g s", motion->from);
    }
    if (motion->until > 0) {
        fprintf(file, " until %g s", motion->until);
    }
    fputc('\n', file);
}

static void print_steady(FILE *file, int w, const OzMotion *motion)
{
    const double *v = motion->velocity;
    fprintf(file, "wall %d             goes on at [%.4g, %.4g, %.4g] m/s from %g s", w, v[0], v[1],
            v[2], motion->from);
    if (motion->until > 0) {
        fprintf(file, " until %g s, by %.4g m", motion->until,
                oz_motion_speed(motion) * (motion->until - motion->from));
    }
    fputc('\n', file);
}

static void print_turning(FILE *file, int w, const OzScene *scene)
{
    const OzWall *wall = &scene->walls[w];
    const double *g = scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    double turn = wall->motion.angular_velocity;
    bool is_drum = wall->kind == OZ_WALL_DRUM || wall->kind == OZ_WALL_CYLINDER;
    fprintf(file, "wall %d             turns at %g rad/s, once in %.4g s", w, turn,
            2 * PI / fabs(turn));
    if (is_drum && gravity > 0) {
        fprintf(file, "; Froude number %.4g", turn * turn * wall->diameter / 2 / gravity);
    }
    if (wall->motion.from > 0) {
        fprintf(file, "; from %g s", wall->motion.from);
    }
    if (wall->motion.until > 0) {
        fprintf(file, "; until %g s, by %.4g rad", wall->motion.until,
                turn * (wall->motion.until - wall->motion.from));
    }
    fputc('\n', file);
}

static void print_times(FILE *file, int w, const OzWall *wall)
{
    fprintf(file, "wall %d             is there", w);
    if (wall->since > 0) {
        fprintf(file, " from %g s on", wall->since);
    }
    if (wall->until > 0) {
        fprintf(file, " until %g s", wall->until);
    }
    fputc('\n', file);
}

void oz_inspect_motion_print(FILE *file, const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzMotion *motion = &scene->walls[w].motion;
        if (scene->walls[w].since > 0 || scene->walls[w].until > 0) {
            print_times(file, w, &scene->walls[w]);
        }
        if (motion->present && motion->frequency > 0) {
            print_shaken(file, w, scene);
        }
        if (motion->present && !motion->trace && motion->frequency == 0 &&
            oz_motion_speed(motion) > 0) {
            print_steady(file, w, motion);
        }
        if (motion->present && motion->angular_velocity != 0) {
            print_turning(file, w, scene);
        }
    }
}
