/* The camera's place and the picture's division from a look alone. Knows neither GL nor grains. */
#include "draw/camera.h"

#include "draw/palette.h"

#include <math.h>
#include <string.h>

/* Distance of the eye in units (a unit is about half the framed size): far enough that parallel
 * rods look parallel, near enough that the depth is felt. */
static const double EYE_DISTANCE = 14;

/* Below this size the overlay would cover the grains. */
enum { OVERLAY_MIN_WIDTH = 240, OVERLAY_MIN_HEIGHT = 160 };

static double font_size(const OzLook *look)
{
    if (look->bare || look->plain || look->width < OVERLAY_MIN_WIDTH ||
        look->height < OVERLAY_MIN_HEIGHT) {
        return 0;
    }
    return fmax(9, fmin(look->height / 34.0, look->width / 44.0));
}

static double zoom_of(const OzLook *look)
{
    return look->zoom > 0 ? look->zoom : 1;
}

/* Everything flat lies at the depth where the perspective is none. */
static void stand_over_plane(OzCamera *camera)
{
    const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memcpy(camera->axes, axes, sizeof axes);
    camera->centre[1] = camera->centre[2];
    camera->centre[2] = 0;
}

static void choose_side(const OzLook *look, int view, double *azimuth, double *elevation)
{
    OzView kind = look->views[view];
    bool is_free = kind == OZ_VIEW_FREE, is_top = kind == OZ_VIEW_TOP;
    *azimuth = is_free ? look->free_azimuth : 0;
    *elevation = look->flat ? 0
                 : is_top   ? 2 * atan(1.0)
                 : is_free  ? look->free_elevation
                            : look->elevation;
}

/* The middle of the picture; the farther from that of what is framed, the more depth there is. */
static void aim(OzCamera *camera, const OzLook *look)
{
    double away = 0;
    for (int k = 0; look->has_target && k < (look->flat ? 2 : 3); k++) {
        away = hypot(away, look->target[k] - camera->centre[k]);
        camera->centre[k] = look->target[k];
    }
    camera->depth += look->flat ? 0 : away / camera->unit;
}

static void stand(OzCamera *camera, const OzLook *look, int view)
{
    choose_side(look, view, &camera->azimuth, &camera->elevation);
    double s = sin(camera->elevation), c = cos(camera->elevation);
    double sa = sin(camera->azimuth), ca = cos(camera->azimuth);
    const double axes[3][3] = {{ca, sa, 0}, {-s * sa, s * ca, c}, {c * sa, -c * ca, s}};
    double half_height = 0.5 * (look->height_high - look->height_low);
    memcpy(camera->axes, axes, sizeof axes);
    camera->centre[0] = look->centre[0];
    camera->centre[1] = look->centre[1];
    camera->centre[2] = 0.5 * (look->height_low + look->height_high);
    camera->unit = fmax(fmax(half_height, look->half_width), 1e-12);
    camera->distance = EYE_DISTANCE;
    camera->depth = 1.5 * (look->half_width * c + half_height * fabs(s)) / camera->unit;
    if (look->flat) {
        stand_over_plane(camera);
    }
    aim(camera, look);
}

/* What the framed volume covers of a view, units at the depth of the middle: what stands in front
 * of that looks larger. */
static void find_extent(const OzLook *look, int view, double unit, double size[2])
{
    double azimuth = 0, elevation = 0, half_height = 0.5 * (look->height_high - look->height_low);
    choose_side(look, view, &azimuth, &elevation);
    bool from_above = fabs(elevation) > atan(1.0);
    double along = fabs(cos(azimuth)), across = fabs(sin(azimuth)), middle = look->half_width;
    const double *side = look->half_sides;
    bool is_square = look->is_round || look->flat || !(side[0] > 0);
    double wide = is_square ? middle : along * side[0] + across * side[1];
    double deep = is_square ? middle : across * side[0] + along * side[1];
    double front = look->flat ? 0 : from_above ? half_height : deep;
    double nearer = EYE_DISTANCE / (EYE_DISTANCE - front / unit);
    double upright = half_height * cos(elevation) + deep * fabs(sin(elevation));
    size[0] = 2 * wide / unit * nearer;
    size[1] = 2 * upright / unit * nearer;
}

/* The largest scale at which all views of the framed volume fit their areas, and what the widest
 * and this one cover then. */
static double fit(OzCamera *camera, const OzLook *look, int view, double width, double height)
{
    double size[2], widest = 0, scale = INFINITY;
    for (int i = 0; i < look->view_count; i++) {
        find_extent(look, i, camera->unit, size);
        scale = fmin(scale, fmin(width / size[0], height / size[1]));
        widest = fmax(widest, size[0]);
    }
    camera->scale = scale * zoom_of(look);
    find_extent(look, view, camera->unit, size);
    camera->content_width = size[0] * camera->scale;
    camera->content_height = size[1] * camera->scale;
    return widest * camera->scale;
}

/* Views stand side by side about the picture's middle, not much further apart than they are wide.
 */
static void divide(OzCamera *camera, const OzLook *look, double left, double right, double middle_y,
                   double widest)
{
    double share = (right - left) / look->view_count;
    double pitch = fmin(share, fmax(1.7 * widest, 9 * camera->font));
    double middle = 0.5 * (left + right);
    camera->panel_count = look->view_count;
    for (int i = 0; i < look->view_count; i++) {
        OzPanel *panel = &camera->panels[i];
        panel->middle_x = middle + pitch * (i - 0.5 * (look->view_count - 1));
        panel->middle_y = middle_y;
        panel->x = i == 0 ? 0 : (int)lround(middle);
        panel->width = (i == look->view_count - 1 ? look->width : (int)lround(middle)) - panel->x;
    }
}

/* Blank borders for the overlay, in text sizes beside the margin: the colour bar's column on the
 * right, captions below, the heading above. On the left as much as on the right, in wide pictures
 * whose views are as large with it. */
static void place(OzCamera *camera, const OzLook *look, int view, double heading)
{
    double font = camera->font;
    double margin = font > 0 ? 0.8 * font : 0.02 * fmin(look->width, look->height);
    double column = look->no_legend ? 0 : (oz_palette_is_by_type(look) ? 9 : 6) * font;
    double right = look->width - margin - column, left = margin;
    double top = margin + heading * font, bottom = look->height - margin - 1.3 * font;
    double views = look->view_count * (look->view_count > 1 ? 1.12 : 1.0);
    double widest = fit(camera, look, view, (right - left) / views, bottom - top);
    double scale = camera->scale;
    if (look->width > 1.3 * look->height) {
        left = margin + column;
        widest = fit(camera, look, view, (right - left) / views, bottom - top);
        if (camera->scale < 0.98 * scale) {
            left = margin;
            widest = fit(camera, look, view, (right - left) / views, bottom - top);
        }
    }
    divide(camera, look, left, right, 0.5 * (top + bottom), widest);
}

OzCamera oz_camera_make(const OzLook *look, int view)
{
    OzCamera camera = {.font = font_size(look)};
    stand(&camera, look, view);
    /* Beside slender containers the heading's second line finds room; above wide ones it needs
     * some. */
    place(&camera, look, view, 1.8);
    if (camera.panels[0].middle_x - 0.5 * camera.content_width < 14 * camera.font) {
        place(&camera, look, view, 3.2);
    }
    return camera;
}

bool oz_camera_agrees(const OzCamera *a, const OzCamera *b)
{
    return a->azimuth == b->azimuth && a->elevation == b->elevation;
}

void oz_camera_away(const OzCamera *camera, double away[3])
{
    const double *eye = camera->axes[2];
    double level = hypot(eye[0], eye[1]);
    bool along = level > 0.7;
    for (int k = 0; k < 3; k++) {
        const double *axis = camera->axes[k];
        double flat = -(axis[0] * eye[0] + axis[1] * eye[1]) / fmax(level, 1e-12);
        away[k] = along ? flat : k == 2 ? -1 : 0;
    }
}

const float *oz_camera_background(const OzLook *look)
{
    static const float white[3] = {1, 1, 1};
    /* A shade off white, against which glass looks clean. */
    static const float background[3] = {0.972f, 0.976f, 0.982f};
    return look->bare             ? white
           : look->has_background ? look->background
           : look->plain          ? white
                                  : background;
}

OzBox oz_camera_box(const OzCamera *camera, const OzLook *look, int panel, const double low[2],
                    const double high[2])
{
    enum { BORDER = 4 }; /* pixels: lines and samples beside the content */
    const OzPanel *p = &camera->panels[panel];
    if (look->has_target || look->zoom > 1) { /* what is framed may lie anywhere */
        return (OzBox){p->x, 0, p->width, look->height};
    }
    double scale = camera->scale,
           half[2] = {0.5 * camera->content_width, 0.5 * camera->content_height};
    double left = p->middle_x + fmin(-half[0], scale * low[0]) - BORDER;
    double right = p->middle_x + fmax(half[0], scale * high[0]) + BORDER;
    double top = p->middle_y - fmax(half[1], scale * high[1]) - BORDER;
    double bottom = p->middle_y - fmin(-half[1], scale * low[1]) + BORDER;
    OzBox box = {.x = (int)fmax(left, p->x), .y = (int)fmax(top, 0)};
    box.width = (int)fmax(fmin(right, p->x + p->width) - box.x, 0);
    box.height = (int)fmax(fmin(bottom, look->height) - box.y, 0);
    return box;
}

void oz_camera_turn(const OzCamera *camera, const double world[3], double view[3])
{
    for (int i = 0; i < 3; i++) {
        const double *axis = camera->axes[i];
        view[i] = axis[0] * world[0] + axis[1] * world[1] + axis[2] * world[2];
    }
}

void oz_camera_see(const OzCamera *camera, const double world[3], double view[3])
{
    double offset[3];
    for (int i = 0; i < 3; i++) {
        offset[i] = (world[i] - camera->centre[i]) / camera->unit;
    }
    oz_camera_turn(camera, offset, view);
}
