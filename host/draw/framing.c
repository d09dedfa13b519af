/* A steady framing from walls and the first bed. Knows no GL. */
#include "draw/framing.h"

#include "draw/palette.h"
#include "draw/plane.h"
#include "draw/pressed.h"
#include "model/motion.h"
#include "scene/boundary.h"
#include "scene/wall_mesh.h"
#include "scene/wall_swing.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* High enough that the floor and the bed's surface are seen as areas, low enough that the cut plane
 * is seen nearly straight on. */
static const double ELEVATION = 11 * 3.14159265358979323846 / 180;

/* Of a view from any side, where a scene does not say more. */
static const double FREE = 30 * 3.14159265358979323846 / 180;

/* The space that the picture must hold, m. */
typedef struct Room {
    double low[3], high[3];
} Room;

static Room grain_room(const OzSnapshot *snapshot)
{
    Room room = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int k = 0; k < 3; k++) {
        double period = oz_boundary_period(&snapshot->scene->boundary, k);
        room.low[k] = period > 0 ? -period / 2 : room.low[k];
        room.high[k] = period > 0 ? period / 2 : room.high[k];
    }
    for (int64_t i = 0; i < snapshot->count; i++) {
        double place[3];
        oz_snapshot_place(snapshot, i, place);
        for (int k = 0; k < 3; k++) {
            double middle = place[k];
            double reach = 0.5 * (snapshot->grains->diameter[i] +
                                  snapshot->grains->length[i] * fabs(snapshot->axis[3 * i + k]));
            room.low[k] = fmin(room.low[k], middle - reach);
            room.high[k] = fmax(room.high[k], middle + reach);
        }
    }
    for (int k = 0; k < 3; k++) {
        if (!isfinite(room.low[k]) || !isfinite(room.high[k])) {
            room.low[k] = k == 2 ? 0 : -0.005;
            room.high[k] = k == 2 ? 0.01 : 0.005;
        }
    }
    return room;
}

double oz_framing_radius(const OzScene *scene)
{
    double radius = INFINITY;
    for (int w = 0; w < scene->wall_count; w++) {
        if (oz_wall_shape_is_upright(&scene->walls[w])) {
            radius = fmin(radius, 0.5 * scene->walls[w].diameter);
        }
    }
    return radius;
}

/* Room to bounce into: the floor's whole stroke and a throw at its highest speed. */
static double bounce(const OzScene *scene)
{
    double gravity =
        sqrt(scene->gravity[0] * scene->gravity[0] + scene->gravity[1] * scene->gravity[1] +
             scene->gravity[2] * scene->gravity[2]);
    double most = 0;
    for (int w = 0; w < scene->wall_count; w++) {
        const OzMotion *motion = &scene->walls[w].motion;
        if (motion->present && gravity > 0) {
            double shift[3];
            oz_wall_shape_shift(&scene->walls[w], oz_motion_reach(motion), shift);
            double rise = fabs(shift[2]), speed = 2 * PI * motion->frequency * rise;
            speed = motion->trace ? oz_motion_speed(motion) : speed;
            most = fmax(most, 2 * rise + 0.5 * speed * speed / gravity);
        }
    }
    return most;
}

/* Straight walls end the room where they stand: at the lowest point of their motion if they are
 * floors (and a little lower, to show the floor's body), and the highest if they are lids. */
static void close_by_planes(Room *room, const OzScene *scene)
{
    double body = 0.03 * (room->high[2] - room->low[2]);
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        for (int k = 0; k < 3 && wall->kind == OZ_WALL_PLANE; k++) {
            double stroke = k == 2 ? oz_motion_reach(&wall->motion) : 0;
            if (wall->normal[k] > 0.99) {
                room->low[k] = wall->point[k] - stroke - (k == 2 ? body : 0);
            } else if (wall->normal[k] < -0.99) {
                room->high[k] = wall->point[k] + stroke;
            }
        }
    }
}

/* Rectangles, discs, cones and open tubes are shown whole. */
static void include_sheet(Room *room, const OzWall *wall)
{
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    double u[3], v[3];
    oz_wall_shape_sides(wall, sides);
    const OzWallShape shape = sides[0];
    oz_wall_shape_across(shape.normal, u, v);
    bool is_square = wall->kind == OZ_WALL_RECTANGLE;
    for (int k = 0; k < 3 && is_square; k++) {
        u[k] = shape.across[k] * shape.extent[0];
        int a = (k + 1) % 3, b = (k + 2) % 3;
        v[k] = shape.extent[1] *
               (shape.normal[a] * shape.across[b] - shape.normal[b] * shape.across[a]);
    }
    for (int end = 0; end < (is_square ? 1 : 2); end++) {
        double radius = end ? shape.extent[0] : shape.radius;
        for (int k = 0; k < 3; k++) {
            double reach = is_square ? fabs(u[k]) + fabs(v[k]) : radius * hypot(u[k], v[k]);
            double middle = wall->point[k] + (end ? shape.extent[1] * shape.normal[k] : 0);
            room->low[k] = fmin(room->low[k], middle - reach);
            room->high[k] = fmax(room->high[k], middle + reach);
        }
    }
}

/* Containers that close in upon themselves are shown whole; a box only as wide as it is, and as
 * deep as it goes. */
static void surround(Room *room, const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        bool is_box = wall->kind == OZ_WALL_BOX, is_ball = wall->kind == OZ_WALL_SPHERE;
        bool is_sheet = oz_wall_shape_is_sheet(wall);
        bool is_tube =
            wall->kind == OZ_WALL_CYLINDER && !oz_wall_shape_is_upright(wall) && !is_sheet;
        double swept = oz_wall_swing_reach(wall);
        const double *about = wall->motion.has_point ? wall->motion.point : wall->point;
        for (int k = 0; k < 3 && swept > 0; k++) {
            double across = swept * sqrt(1 - wall->motion.axis[k] * wall->motion.axis[k]);
            room->low[k] = fmin(room->low[k], about[k] - across);
            room->high[k] = fmax(room->high[k], about[k] + across);
        }
        for (int k = 0; k < 3 && wall->mesh; k++) {
            room->low[k] = fmin(room->low[k], wall->point[k] + wall->mesh->low[k]);
            room->high[k] = fmax(room->high[k], wall->point[k] + wall->mesh->high[k]);
        }
        if (is_sheet && !wall->mesh) {
            include_sheet(room, wall);
        }
        for (int k = 0; k < 3 && (is_box || is_ball || is_tube); k++) {
            double along = is_tube ? wall->axis[k] * wall->length : 0;
            double reach = is_box ? wall->size[k] / 2 : wall->diameter / 2;
            reach *= is_tube ? sqrt(1 - wall->axis[k] * wall->axis[k]) : 1;
            double low = wall->point[k] + fmin(along, 0) - (is_box && k == 2 ? 0 : reach);
            double high = wall->point[k] + fmax(along, 0) + reach;
            room->low[k] = fmin(room->low[k], low);
            room->high[k] = is_box && k == 2 ? room->high[k] : fmax(room->high[k], high);
        }
    }
}

static void widen(Room *room, const OzScene *scene)
{
    double height = room->high[2] - room->low[2];
    double wide = fmax(room->high[0] - room->low[0], room->high[1] - room->low[1]);
    double margin = fmax(0.06 * wide, 0.5 * (0.4 * height - wide));
    for (int k = 0; k < 2; k++) {
        room->low[k] -= margin;
        room->high[k] += margin;
    }
    room->low[2] -= 0.02 * height;
    room->high[2] += fmax(0.08 * height, fmin(bounce(scene), 0.6 * height));
}

double oz_framing_top(const OzLook *look, const OzCamera *camera, const OzSnapshot *snapshot)
{
    double height = look->height_high - look->height_low, top = look->height_high - 0.01 * height;
    /* The picture's upper edge, where the back of a wall is seen lowest, and a little more. */
    double rise = sin(fabs(camera->elevation)) * look->half_width +
                  camera->panels[0].middle_y / camera->scale * camera->unit;
    double most = camera->centre[2] + 1.1 * rise / fmax(cos(camera->elevation), 0.1);
    for (int64_t i = 0; i < snapshot->count; i++) {
        double place[3],
            reach = 0.5 * (snapshot->grains->diameter[i] +
                           snapshot->grains->length[i] * fabs(snapshot->axis[3 * i + 2]));
        oz_snapshot_place(snapshot, i, place);
        top = fmax(top, place[2] + reach);
    }
    return fmax(fmin(top + 0.01 * height, most), look->height_high);
}

/* The scale of speed: what a moving floor gives, else what a fall through the bed gives, else what
 * there is. */
static double typical_speed(const OzScene *scene, const OzSnapshot *snapshot, double height)
{
    double speed = 0;
    for (int w = 0; w < scene->wall_count; w++) {
        speed = fmax(speed, 1.25 * oz_motion_speed(&scene->walls[w].motion));
    }
    if (!(speed > 0)) {
        speed = sqrt(2 * height * fabs(scene->gravity[2]));
    }
    for (int64_t i = 0; i < snapshot->count && !(speed > 0); i++) {
        const double *v = &snapshot->velocity[3 * i];
        speed = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return speed > 0 ? oz_palette_round_up(speed) : 1;
}

static void take_camera(OzLook *look, const OzMovieSettings *movie)
{
    look->chains = movie->chains;
    look->free_azimuth = movie->has_azimuth ? movie->azimuth : FREE;
    look->free_elevation = movie->has_elevation ? movie->elevation : FREE;
    look->zoom = movie->zoom;
    look->plain = movie->style == OZ_STYLE_PAPER;
    look->no_legend = !movie->legend;
    look->has_target = movie->has_target;
    look->has_follow = movie->has_follow;
    look->follow = movie->follow;
    look->has_background = movie->has_background;
    for (int k = 0; k < 3; k++) {
        look->target[k] = movie->target[k];
        look->background[k] = (float)movie->background[k];
    }
}

static bool has_rods(const OzSnapshot *snapshot)
{
    bool has = false;
    for (int64_t i = 0; i < snapshot->count && !has; i++) {
        has = snapshot->grains->length[i] > 0;
    }
    return has;
}

/* Spheres have no angle to show. */
static OzColour shown_colour(OzColour asked, const OzSnapshot *snapshot)
{
    bool is_empty = asked == OZ_COLOUR_ANGLE && !snapshot->grains->elements && !has_rods(snapshot);
    return is_empty ? OZ_COLOUR_SPEED : asked;
}

static void take_settings(OzLook *look, const OzMovieSettings *movie, const OzSnapshot *snapshot)
{
    if (movie->width > 0) { /* a loaded scene has them filled in, movie or not */
        look->width = movie->width;
        look->height = movie->height;
        look->view_count = movie->view_count;
        look->views[0] = movie->views[0];
        look->views[1] = movie->views[1];
        look->colour = shown_colour(movie->colour, snapshot);
        look->cut_outlines = movie->cut_outlines;
        take_camera(look, movie);
    }
}

static void frame_standing(OzLook *look, const OzScene *scene, const OzSnapshot *snapshot)
{
    Room room = grain_room(snapshot);
    double radius = oz_framing_radius(scene);
    surround(&room, scene);
    close_by_planes(&room, scene); /* first to know the size, then to keep the walls' sides */
    widen(&room, scene);
    close_by_planes(&room, scene);
    look->height_low = room.low[2];
    look->height_high = fmax(room.high[2], room.low[2] + 1e-9);
    look->is_round = isfinite(radius);
    if (look->is_round) {
        look->half_width = radius;
    } else {
        for (int k = 0; k < 2; k++) {
            look->half_sides[k] = fmax(0.5 * (room.high[k] - room.low[k]), 1e-9);
        }
        look->half_width = fmax(look->half_sides[0], look->half_sides[1]);
        look->centre[0] = 0.5 * (room.low[0] + room.high[0]);
        look->centre[1] = 0.5 * (room.low[1] + room.high[1]);
        look->cut = look->centre[1];
    }
    look->speed_high = typical_speed(scene, snapshot, look->height_high - look->height_low);
}

OzLook oz_framing_look(const OzScene *scene, const OzSnapshot *snapshot)
{
    bool flat = snapshot->grains->elements != NULL;
    OzLook look = {.width = 1280,
                   .height = 720,
                   .views = {OZ_VIEW_LATERAL, OZ_VIEW_CUT},
                   .view_count = 2,
                   .colour = flat ? OZ_COLOUR_SPEED : OZ_COLOUR_ANGLE,
                   .elevation = ELEVATION};
    take_settings(&look, &scene->movie, snapshot);
    if (flat) {
        oz_plane_frame(&look, scene, snapshot);
    } else {
        frame_standing(&look, scene, snapshot);
    }
    if (scene->movie.speed_scale > 0) {
        look.speed_high = scene->movie.speed_scale;
    }
    look.force_high =
        scene->movie.force_scale > 0 ? scene->movie.force_scale : oz_pressed_scale(snapshot, &look);
    return look;
}

OzLook oz_framing_still(const OzScene *scene, const OzLook *movie)
{
    const OzSnapshotSettings *stills = &scene->snapshots;
    OzLook look = *movie;
    if (stills->width > 0) {
        look.width = stills->width;
        look.height = stills->height;
        look.colour = stills->colour == scene->movie.colour ? movie->colour : stills->colour;
        look.view_count = look.flat ? 1 : stills->view_count;
        look.views[0] = stills->views[0];
        look.views[1] = stills->views[1];
    }
    return look;
}

void oz_framing_keep(OzLook *look, const OzLook *framed)
{
    look->height_low = framed->height_low;
    look->height_high = framed->height_high;
    look->centre[0] = framed->centre[0];
    look->centre[1] = framed->centre[1];
    look->half_width = framed->half_width;
    look->half_sides[0] = framed->half_sides[0];
    look->half_sides[1] = framed->half_sides[1];
    look->cut = framed->cut;
    look->speed_high = framed->speed_high;
    look->force_high = framed->force_high;
}

OzStatus oz_framing_state(OzLook *look, OzStateVisit *visit)
{
    OZ_PASS(oz_state_double(visit, "height_low", "m", &look->height_low, 1));
    OZ_PASS(oz_state_double(visit, "height_high", "m", &look->height_high, 1));
    OZ_PASS(oz_state_double(visit, "centre", "m", look->centre, 2));
    OZ_PASS(oz_state_double(visit, "half_width", "m", &look->half_width, 1));
    OZ_PASS(oz_state_double(visit, "half_sides", "m", look->half_sides, 2));
    OZ_PASS(oz_state_double(visit, "cut", "m", &look->cut, 1));
    OZ_PASS(oz_state_double(visit, "force_high", "N", &look->force_high, 1));
    return oz_state_double(visit, "speed_high", "m/s", &look->speed_high, 1);
}
