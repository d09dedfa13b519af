/* A steady framing of flat grains. Knows no GL. */
#include "draw/plane.h"

#include "draw/palette.h"
#include "model/motion.h"

#include <math.h>

/* What the picture must hold, m: x and y. */
typedef struct Room {
    double low[2], high[2];
} Room;

static void take_point(Room *room, const double point[2], double reach)
{
    for (int k = 0; k < 2; k++) {
        room->low[k] = fmin(room->low[k], point[k] - reach);
        room->high[k] = fmax(room->high[k], point[k] + reach);
    }
}

static void take_grains(Room *room, const OzSnapshot *snapshot)
{
    const OzElements *elements = snapshot->grains->elements;
    for (int64_t i = 0; i < elements->free_count; i++) {
        take_point(room, snapshot->element_position + 2 * i, elements->reach[i]);
    }
}

/* A corner of a wall, at the ends of a wall's strokes or all around the point about which it turns.
 */
static void take_wall_point(Room *room, const OzWall *wall, const double point[2])
{
    const OzMotion *motion = &wall->motion;
    double stroke = oz_motion_reach(motion);
    if (motion->present && motion->angular_velocity != 0) {
        take_point(room, wall->point, hypot(point[0] - wall->point[0], point[1] - wall->point[1]));
        return;
    }
    take_point(room, (const double[2]){point[0], point[1] - stroke}, 0);
    take_point(room, (const double[2]){point[0], point[1] + stroke}, 0);
}

static void take_walls(Room *room, const OzScene *scene, const OzSnapshot *snapshot)
{
    const OzElements *elements = snapshot->grains->elements;
    for (int64_t i = elements->free_count; i < elements->count; i++) {
        double corners[6];
        oz_elements_corners(elements, i, snapshot->element_position + 2 * i,
                            snapshot->element_angle[i], corners);
        for (int c = 0; c < 3; c++) {
            take_wall_point(room, &scene->walls[elements->body[i] - elements->grain_count],
                            corners + 2 * c);
        }
    }
}

static double size_of(const Room *room)
{
    return fmax(room->high[0] - room->low[0], room->high[1] - room->low[1]);
}

/* Without gravity grains go straight on: room for the way of each, if it is not so long that
 * nothing could be seen any more; an endless one is. */
static void take_flights(Room *room, const OzScene *scene, const OzSnapshot *snapshot)
{
    double most = 4 * size_of(room);
    Room flown = *room;
    if (isinf(scene->duration)) {
        return;
    }
    for (int64_t g = 0; g < snapshot->count && hypot(scene->gravity[0], scene->gravity[1]) == 0;
         g++) {
        const double *x = &snapshot->position[3 * g], *v = &snapshot->velocity[3 * g];
        double end[2] = {x[0] + v[0] * scene->duration, x[1] + v[1] * scene->duration};
        double aside = 0.15 * hypot(end[0] - x[0], end[1] - x[1]);
        take_point(&flown, end, 0.5 * snapshot->grains->diameter[g] + aside);
    }
    if (size_of(&flown) < most) {
        *room = flown;
    }
}

/* A tenth of the picture shows what has flowed out. */
static void take_outlet(Room *room, const OzScene *scene)
{
    if (scene->observe.has_outlet) {
        double above = room->high[1] - scene->observe.outlet;
        room->low[1] = fmin(room->low[1], scene->observe.outlet - fmax(0.1 * above, 0));
    }
}

static Room find_room(const OzScene *scene, const OzSnapshot *snapshot)
{
    Room room = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    take_grains(&room, snapshot);
    take_walls(&room, scene, snapshot);
    if (!(isfinite(size_of(&room)) && size_of(&room) > 0)) {
        room = (Room){{-0.005, -0.005}, {0.005, 0.005}};
    }
    take_flights(&room, scene, snapshot);
    take_outlet(&room, scene);
    double margin = 0.03 * size_of(&room);
    take_point(&room, room.low, margin);
    take_point(&room, room.high, margin);
    return room;
}

/* The speed of a drum's rim, m/s; negative without a drum. */
static double rim_speed(const OzScene *scene)
{
    double speed = -1;
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        if (wall->kind == OZ_WALL_DRUM) {
            double turn = wall->motion.present ? fabs(wall->motion.angular_velocity) : 0;
            speed = fmax(speed, 0.5 * turn * wall->diameter);
        }
    }
    return speed;
}

/* Grains that flow freely fall a few of their own sizes at a time before they hit others; those of
 * an avalanche in a drum roll over each other and hardly fall. */
static double flow_speed(const OzScene *scene, const OzSnapshot *snapshot)
{
    double rim = rim_speed(scene), sizes_fallen = rim < 0 ? 3 : 0.1;
    double sum = 0, gravity = hypot(scene->gravity[0], scene->gravity[1]);
    for (int64_t g = 0; g < snapshot->count; g++) {
        sum += snapshot->grains->diameter[g];
    }
    double size = snapshot->count > 0 ? sum / (double)snapshot->count : 0;
    return fmax(sqrt(2 * gravity * sizes_fallen * size), 2 * rim);
}

static double fastest(const OzSnapshot *snapshot)
{
    double most = 0;
    for (int64_t g = 0; g < snapshot->count; g++) {
        most = fmax(most, hypot(snapshot->velocity[3 * g], snapshot->velocity[3 * g + 1]));
    }
    return most;
}

void oz_plane_frame(OzLook *look, const OzScene *scene, const OzSnapshot *snapshot)
{
    Room room = find_room(scene, snapshot);
    double flow = flow_speed(scene, snapshot);
    double speed = flow > 0 ? flow : fastest(snapshot);
    look->flat = true;
    look->elevation = 0;
    look->view_count = 1;
    look->outlines = scene->movie.width <= 0 || scene->movie.outlines; /* 0: not a loaded scene */
    look->beams = scene->movie.beams;
    look->height_low = room.low[1];
    look->height_high = room.high[1];
    look->half_width = 0.5 * (room.high[0] - room.low[0]);
    look->centre[0] = 0.5 * (room.low[0] + room.high[0]);
    look->speed_high = speed > 0 ? oz_palette_round_up(speed) : 1;
}
