/* Two measures of a bed's slope in the drum. Knows nothing of time. */
#include "observe/inclination.h"

#include <math.h>

/* The first drum with axes along and against gravity. */
typedef struct Frame {
    const OzWall *drum;
    double right[2], up[2];
    double turning; /* 1, or -1 for a drum that turns clockwise */
} Frame;

static const OzWall *find_drum(const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].kind == OZ_WALL_DRUM) {
            return &scene->walls[w];
        }
    }
    return NULL;
}

bool oz_inclination_applies(const OzScene *scene)
{
    return find_drum(scene) && hypot(scene->gravity[0], scene->gravity[1]) > 0;
}

static Frame make_frame(const OzScene *scene)
{
    const double *g = scene->gravity;
    double size = hypot(g[0], g[1]);
    Frame frame = {.drum = find_drum(scene), .up = {-g[0] / size, -g[1] / size}};
    frame.right[0] = frame.up[1];
    frame.right[1] = -frame.up[0];
    frame.turning = frame.drum->motion.angular_velocity < 0 ? -1 : 1;
    return frame;
}

/* A point's coordinates from the drum's axis: along right and up. */
static void place(const Frame *frame, const double point[2], double out[2])
{
    double x = point[0] - frame->drum->point[0], y = point[1] - frame->drum->point[1];
    out[0] = frame->right[0] * x + frame->right[1] * y;
    out[1] = frame->up[0] * x + frame->up[1] * y;
}

static double column_place(const Frame *frame, int column)
{
    double width = 0.5 * frame->drum->diameter;
    return width * ((column + 0.5) / OZ_INCLINATION_COLUMNS - 0.5);
}

/* The highest point of every column; -INFINITY where no grain is. */
static void find_tops(const Frame *frame, const OzSnapshot *snapshot,
                      double tops[OZ_INCLINATION_COLUMNS])
{
    double pitch = column_place(frame, 1) - column_place(frame, 0);
    double left = column_place(frame, 0);
    for (int c = 0; c < OZ_INCLINATION_COLUMNS; c++) {
        tops[c] = -INFINITY;
    }
    for (int64_t g = 0; g < snapshot->count; g++) {
        double at[2], radius = 0.5 * snapshot->grains->diameter[g];
        place(frame, &snapshot->position[3 * g], at);
        double first = fmax(ceil((at[0] - radius - left) / pitch), 0);
        double last = fmin(floor((at[0] + radius - left) / pitch), OZ_INCLINATION_COLUMNS - 1);
        for (double c = first; c <= last; c++) {
            double off = left + pitch * c - at[0];
            double top = at[1] + sqrt(fmax(radius * radius - off * off, 0));
            tops[(int)c] = fmax(tops[(int)c], top);
        }
    }
}

bool oz_inclination_surface(const OzSnapshot *snapshot, double *angle)
{
    if (!oz_inclination_applies(snapshot->scene)) {
        return false;
    }
    Frame frame = make_frame(snapshot->scene);
    double tops[OZ_INCLINATION_COLUMNS], n = 0, x = 0, y = 0, xx = 0, xy = 0;
    find_tops(&frame, snapshot, tops);
    for (int c = 0; c < OZ_INCLINATION_COLUMNS; c++) {
        double at = column_place(&frame, c);
        if (isfinite(tops[c])) {
            n += 1, x += at, y += tops[c], xx += at * at, xy += at * tops[c];
        }
    }
    *angle = n >= 2 ? frame.turning * atan2(n * xy - x * y, n * xx - x * x) : 0;
    return n >= 0.5 * OZ_INCLINATION_COLUMNS;
}

bool oz_inclination_centre(const OzSnapshot *snapshot, double *angle)
{
    double mass = 0, sum[2] = {0, 0};
    if (!oz_inclination_applies(snapshot->scene)) {
        return false;
    }
    Frame frame = make_frame(snapshot->scene);
    for (int64_t g = 0; g < snapshot->count; g++) {
        double at[2];
        place(&frame, &snapshot->position[3 * g], at);
        mass += snapshot->grains->mass[g];
        sum[0] += snapshot->grains->mass[g] * at[0];
        sum[1] += snapshot->grains->mass[g] * at[1];
    }
    *angle = frame.turning * atan2(sum[0], -sum[1]);
    return mass > 0 && hypot(sum[0], sum[1]) > 1e-12 * mass * frame.drum->diameter;
}
