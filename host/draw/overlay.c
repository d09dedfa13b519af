/* Setting the overlay on an image. Knows no GL. */
#include "draw/overlay.h"

#include "draw/framing.h"
#include "draw/palette.h"
#include "draw/pressed.h"
#include "model/motion.h"
#include "scene/mixing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Text on what is light, and on what is dark. */
static const float INK[2][3] = {{0.15f, 0.17f, 0.21f}, {0.93f, 0.94f, 0.96f}};
static const float PALE[2][3] = {{0.38f, 0.41f, 0.47f}, {0.70f, 0.73f, 0.78f}};

/* What every part needs. */
typedef struct Page {
    const OzFont *font;
    OzImage *image;
    const OzSnapshot *snapshot;
    const OzLook *look;
    const OzCamera *camera;
    double size, margin;     /* pixels: the text's size, the blank border */
    const float *ink, *pale; /* red, green, blue of text */
} Page;

/* The beginning of a text that fits, with an ellipsis; the size stays. */
static void shorten(const Page *page, OzWeight weight, double size, double most, char *text)
{
    static const char ellipsis[] = "\xe2\x80\xa6";
    double room = most - oz_font_width(page->font, weight, size, ellipsis);
    size_t kept = oz_font_fit(page->font, weight, size, text, room);
    while (kept > 0 && text[kept - 1] == ' ') {
        kept--;
    }
    memcpy(text + kept, ellipsis, sizeof ellipsis);
}

/* place: 0 starts at x, 1 ends there, 0.5 is centred. Texts that are too long for the picture
 * shrink a little, and where that is not enough lose their end. */
static void write_text(const Page *page, OzWeight weight, double size, double place, double x,
                       double y, const float rgb[3], const char *whole)
{
    enum { LETTERS = 1024 };     /* more than fit at any size */
    const double smallest = 0.8; /* of the size */
    char text[LETTERS + 8];
    double most = page->look->width - 2 * page->margin;
    snprintf(text, LETTERS, "%s", whole);
    double width = oz_font_width(page->font, weight, size, text);
    if (width > most) {
        size *= fmax(most / width, smallest);
        if (most / width < smallest || strlen(whole) >= LETTERS) {
            shorten(page, weight, size, most, text);
        }
        width = oz_font_width(page->font, weight, size, text);
    }
    double left = fmin(x - place * width, page->look->width - page->margin - width);
    oz_font_draw(page->font, page->image, weight, size, fmax(left, page->margin), y, rgb, text);
}

static void fill(const Page *page, double left, double top, double right, double bottom,
                 const float rgb[3])
{
    const OzImage *image = page->image;
    int y_end = (int)lround(fmin(bottom, image->height));
    int x_end = (int)lround(fmin(right, image->width));
    for (int y = (int)lround(fmax(top, 0)); y < y_end; y++) {
        for (int x = (int)lround(fmax(left, 0)); x < x_end; x++) {
            uint8_t *pixel = image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
            for (int k = 0; k < 3; k++) {
                pixel[k] = (uint8_t)lroundf(255 * rgb[k]);
            }
        }
    }
}

static void add_heading(const Page *page)
{
    const OzScene *scene = page->snapshot->scene;
    const char *own = scene->movie.title ? scene->movie.title : scene->title;
    const char *title = own && *own ? own : scene->name;
    double y = page->margin + 0.9 * page->size;
    char text[96];
    int used = snprintf(text, sizeof text, "t = %.3f s%s", page->snapshot->time,
                        page->look->settles ? " of settling" : "");
    if (scene->period > 0 && !page->look->settles) {
        snprintf(text + used, sizeof text - (size_t)used, "   tap %.1f",
                 oz_motion_tap(scene, page->snapshot->time));
    }
    if (title) {
        write_text(page, OZ_WEIGHT_BOLD, 1.05 * page->size, 0, page->margin, y, page->ink, title);
        y += 1.45 * page->size;
    }
    write_text(page, OZ_WEIGHT_REGULAR, page->size, 0, page->margin, y, page->ink, text);
}

static void add_captions(const Page *page)
{
    double y = page->look->height - page->margin - 0.25 * page->size;
    static const char *const names[] = {[OZ_VIEW_LATERAL] = "lateral view",
                                        [OZ_VIEW_CUT] = "axial cut",
                                        [OZ_VIEW_TOP] = "from above",
                                        [OZ_VIEW_FREE] = "free view"};
    char every[48];
    if (page->look->flat) {
        snprintf(every, sizeof every, "a state every %.4g s", page->look->strobe);
        write_text(page, OZ_WEIGHT_REGULAR, 0.9 * page->size, 0.5, 0.5 * page->look->width, y,
                   page->pale, page->look->strobe > 0 ? every : "");
        return;
    }
    for (int i = 0; i < page->camera->panel_count; i++) {
        write_text(page, OZ_WEIGHT_REGULAR, 0.9 * page->size, 0.5, page->camera->panels[i].middle_x,
                   y, page->pale, names[page->look->views[i]]);
    }
}

/* What has just been changed. */
static void add_news(const Page *page)
{
    double y = page->look->height - page->margin - 2.2 * page->size;
    if (page->look->caption) {
        write_text(page, OZ_WEIGHT_BOLD, page->size, 0.5, 0.5 * page->look->width, y, page->ink,
                   page->look->caption);
    }
}

static void length_text(char *text, size_t size, double length)
{
    static const struct {
        double metres;
        const char *name;
    } units[] = {{1, "m"}, {1e-3, "mm"}, {1e-6, "\xc2\xb5m"}, {1e-9, "nm"}};
    int row = 0;
    while (row < 3 && length < 0.1 * units[row].metres * (1 - 1e-9)) {
        row++;
    }
    snprintf(text, size, "%.3g %s", length / units[row].metres, units[row].name);
}

/* The largest round length of at most about a ninth of the picture. */
static void add_scale_bar(const Page *page)
{
    double pixels_per_metre = page->camera->scale / page->camera->unit;
    double most = fmax(page->look->width / 9.0, 3 * page->size) / pixels_per_metre;
    double length = oz_palette_round_up(most * 0.4001);
    double x = page->margin, y = page->look->height - page->margin;
    double width = length * pixels_per_metre, thick = fmax(2, 0.14 * page->size);
    double tick = 0.25 * page->size;
    char text[32];
    length_text(text, sizeof text, length);
    fill(page, x, y - thick, x + width, y, page->ink);
    fill(page, x, y - tick - thick, x + 0.6 * thick, y, page->ink);
    fill(page, x + width - 0.6 * thick, y - tick - thick, x + width, y, page->ink);
    write_text(page, OZ_WEIGHT_REGULAR, 0.9 * page->size, 0.5, x + 0.5 * width,
               y - thick - 0.55 * page->size, page->ink, text);
}

/* Directions of flat grains' long axes go half around. */
static bool is_long_axis(const OzLook *look)
{
    return look->flat && look->colour == OZ_COLOUR_ANGLE;
}

static void bar_colour(const OzLook *look, double share, float rgb[3])
{
    if (is_long_axis(look) || look->colour == OZ_COLOUR_AZIMUTH ||
        look->colour == OZ_COLOUR_TURNED) {
        oz_palette_cyclic(share, rgb);
    } else if (look->colour == OZ_COLOUR_GREY) {
        oz_palette_grey(share, rgb);
    } else {
        oz_palette_viridis(share, rgb);
    }
}

static void tick_text(const OzLook *look, double share, char *text, size_t size)
{
    switch (look->colour) {
    case OZ_COLOUR_ANGLE:
        snprintf(text, size, "%.0f\xc2\xb0", (look->flat ? 180 : 90) * share);
        break;
    case OZ_COLOUR_AZIMUTH:
        snprintf(text, size, "%.0f\xc2\xb0", 180 * share);
        break;
    case OZ_COLOUR_TURNED:
        snprintf(text, size, "%.0f\xc2\xb0", 360 * share);
        break;
    case OZ_COLOUR_ORDER:
        snprintf(text, size, "%.3g", share);
        break;
    case OZ_COLOUR_FORCE:
        snprintf(text, size, "%.3g", look->force_high * share);
        break;
    case OZ_COLOUR_COORDINATION:
        snprintf(text, size, "%.3g", OZ_PRESSED_CONTACTS * share);
        break;
    default:
        snprintf(text, size, "%.3g", look->speed_high * share);
    }
}

static void add_colour_bar(const Page *page)
{
    static const char *const names[] = {
        [OZ_COLOUR_ANGLE] = "angle to floor", [OZ_COLOUR_AZIMUTH] = "azimuth",
        [OZ_COLOUR_SPEED] = "speed (m/s)",    [OZ_COLOUR_GREY] = "speed (m/s)",
        [OZ_COLOUR_TURNED] = "turned by",     [OZ_COLOUR_ORDER] = "local order",
        [OZ_COLOUR_FORCE] = "pushed (N)",     [OZ_COLOUR_COORDINATION] = "contacts"};
    double right = page->look->width - page->margin, width = 0.85 * page->size;
    double height = fmin(0.45 * page->look->height, 14 * page->size);
    double top = 0.5 * (page->look->height - height), left = right - width;
    int divisions = page->look->colour == OZ_COLOUR_ANGLE && !page->look->flat ? 3 : 4;
    for (int row = 0; row < (int)height; row++) {
        float rgb[3];
        bar_colour(page->look, 1 - (row + 0.5) / height, rgb);
        fill(page, left, floor(top) + row, right, floor(top) + row + 1, rgb);
    }
    for (int i = 0; i <= divisions; i++) {
        double y = top + height * (1 - (double)i / divisions);
        char text[32];
        tick_text(page->look, (double)i / divisions, text, sizeof text);
        fill(page, left - 0.3 * page->size, y - 0.5, left, y + 0.5, page->pale);
        write_text(page, OZ_WEIGHT_REGULAR, 0.8 * page->size, 1, left - 0.5 * page->size,
                   y + 0.29 * page->size, page->ink, text);
    }
    write_text(page, OZ_WEIGHT_REGULAR, 0.85 * page->size, 1, right, top - 0.85 * page->size,
               page->ink, is_long_axis(page->look) ? "long axis" : names[page->look->colour]);
}

static void flat_population_text(const OzPopulation *population, char *text, size_t size)
{
    static const char *const names[] = {[OZ_SHAPE_SQUARE] = "squares",
                                        [OZ_SHAPE_POLYGON] = "polygons",
                                        [OZ_SHAPE_STAR] = "stars",
                                        [OZ_SHAPE_VERTICES] = "given shape",
                                        [OZ_SHAPE_DISC] = "discs"};
    const OzRange *range =
        population->shape == OZ_SHAPE_SQUARE ? &population->edge : &population->radius;
    char length[32];
    length_text(length, sizeof length, 0.5 * (range->low + range->high));
    snprintf(text, size, range->high > 0 ? "%s %s" : "%s", names[population->shape], length);
}

static void population_text(const OzPopulation *population, char *text, size_t size)
{
    char length[32];
    length_text(length, sizeof length,
                0.5 * (population->diameter.low + population->diameter.high));
    if (population->kind == OZ_GRAINS_FILE) {
        snprintf(text, size, "from file");
    } else if (population->aspect.high > 0) {
        snprintf(text, size, "rods %s, %.3g:1", length,
                 0.5 * (population->aspect.low + population->aspect.high));
    } else {
        snprintf(text, size, "spheres %s", length);
    }
}

static void add_type_legend(const Page *page)
{
    const OzScene *scene = page->snapshot->scene;
    bool by_material = page->look->colour == OZ_COLOUR_MATERIAL;
    int count = by_material ? oz_mixing_count(scene) : scene->population_count;
    int rows = count < 12 ? count : 12;
    double right = page->look->width - page->margin, box = 0.8 * page->size;
    double y = 0.5 * page->look->height - 0.75 * rows * page->size;
    for (int i = 0; i < rows; i++, y += 1.5 * page->size) {
        float rgb[3];
        char text[64];
        oz_palette_type(i, rgb);
        if (by_material) {
            snprintf(text, sizeof text, "%s", oz_mixing_name(scene, i));
        } else {
            (page->look->flat ? flat_population_text : population_text)(&scene->populations[i],
                                                                        text, sizeof text);
        }
        fill(page, right - box, y, right, y + box, rgb);
        write_text(page, OZ_WEIGHT_REGULAR, 0.8 * page->size, 1, right - box - 0.5 * page->size,
                   y + 0.72 * page->size, page->ink, text);
    }
}

void oz_overlay_draw(const OzFont *font, OzImage *image, const OzSnapshot *snapshot,
                     const OzLook *look, const OzCamera *camera)
{
    const float *behind = oz_camera_background(look);
    bool is_dark = 0.3f * behind[0] + 0.6f * behind[1] + 0.1f * behind[2] < 0.5f;
    Page page = {font,         image,        snapshot,           look,
                 camera,       camera->font, 0.8 * camera->font, INK[is_dark],
                 PALE[is_dark]};
    if (!(page.size > 0)) {
        return;
    }
    add_heading(&page);
    add_captions(&page);
    add_news(&page);
    add_scale_bar(&page);
    if (look->no_legend) {
        return;
    }
    if (oz_palette_is_by_type(look)) {
        add_type_legend(&page);
    } else {
        add_colour_bar(&page);
    }
}
