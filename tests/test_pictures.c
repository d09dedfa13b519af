/* Whole pictures of snapshots written by hand: colours, container, sizes, framing, files, the two
 * GL back-ends against each other. Never runs a simulation. */
#include "draw_bed.h"

#include "draw/framing.h"

#include <png.h>
#include <sys/stat.h>

static void centre_of_one_rod(OzColour colour, const double axis[3], uint8_t rgb[3])
{
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    Bed bed;
    look.colour = colour;
    bed_create(&bed, 1, 1e-3, 2e-3);
    place(&bed, 0, 0, 0, 2e-3, axis);
    bed.snapshot.velocity[0] = 1;
    OzImage image = draw(&bed, &look);
    memcpy(rgb, pixel(&image, 300, 300), 3);
    oz_image_free(&image);
    bed_free(&bed);
}

static void colours_tell_direction_and_speed(void **state)
{
    (void)state;
    const double opposite[3] = {-1, 0, 0}, slanted[3] = {0.8, 0.6, 0};
    uint8_t upright[3], lying[3], a[3], b[3];
    centre_of_one_rod(OZ_COLOUR_ANGLE, along_z, upright);
    centre_of_one_rod(OZ_COLOUR_ANGLE, along_x, lying);
    assert_true(upright[0] > 180 && upright[1] > 160 && upright[2] < 120); /* yellow */
    assert_true(lying[2] > lying[0] && lying[0] > 2 * lying[1]);           /* dark violet */
    centre_of_one_rod(OZ_COLOUR_AZIMUTH, along_x, a);
    centre_of_one_rod(OZ_COLOUR_AZIMUTH, opposite, b);
    assert_true(same_colour(a, b, 2));
    centre_of_one_rod(OZ_COLOUR_AZIMUTH, slanted, b);
    assert_false(same_colour(a, b, 40));
    centre_of_one_rod(OZ_COLOUR_ORDER, along_z, a); /* alone: none */
    assert_true(same_colour(a, lying, 2));
    centre_of_one_rod(OZ_COLOUR_SPEED, along_x, a); /* at the top of the bar: yellow */
    assert_true(a[0] > 180 && a[1] > 160 && a[2] < 120);
}

/* A picture with everything on it: container, floor, both views, overlay. */
static OzImage full_picture(int width, int height, int64_t count, double floor_offset)
{
    Bed bed;
    bed_create(&bed, count, 0.5e-3, 2e-3);
    bed.scene.title = "a title that is much too long for the narrowest of the pictures drawn here";
    bed.scene.period = 1.0 / 30;
    fill_randomly(&bed);
    bed.snapshot.wall_offset[0] = floor_offset;
    OzLook look = oz_renderer_look(&bed.scene, &bed.snapshot);
    look.width = width;
    look.height = height;
    OzImage image = draw(&bed, &look);
    bed_free(&bed);
    return image;
}

static void every_shape_of_picture_is_drawn(void **state)
{
    (void)state;
    static const int sizes[][2] = {{64, 64}, {1000, 64}, {64, 1000}, {333, 777}, {1281, 719}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        OzImage image = full_picture(sizes[i][0], sizes[i][1], 200, 0);
        int dark = 0;
        for (int k = 0; k < image.width * image.height; k++) {
            dark += image.pixels[4 * k] < 150;
        }
        assert_true(dark > 30);
        const uint8_t *corner = pixel(&image, image.width - 1, 0);
        assert_true(corner[0] > 240 && corner[1] > 240 && corner[2] > 240);
        assert_int_equal(corner[3], 255);
        oz_image_free(&image);
    }
}

static void container_is_drawn_without_grains_and_its_floor_moves(void **state)
{
    (void)state;
    OzImage rest = full_picture(400, 300, 0, 0), moved = full_picture(400, 300, 0, 0.5e-3);
    int different = 0;
    for (int i = 0; i < rest.width * rest.height; i++) {
        different += !same_colour(rest.pixels + 4 * (size_t)i, moved.pixels + 4 * (size_t)i, 4);
    }
    assert_true(different > 100);
    assert_true(count_drawn(&rest) > 1000);
    oz_image_free(&rest);
    oz_image_free(&moved);
    assert_int_equal(drawn_by_one(plain_look(OZ_VIEW_CUT), -1, 1e-3, 0, along_z), 0);
}

/* Pixels of a column, from the top down to the row, that are not the background. */
static int drawn_above(const OzImage *image, int column, int row)
{
    int count = 0;
    for (int y = 0; y < row; y++) {
        count += !same_colour(pixel(image, column, y), pixel(image, image->width - 1, 0), 1);
    }
    return count;
}

/* The glass ends at the framed height while all grains lie below, above one that jumps higher, and
 * with the picture where that has left it. */
static void walls_follow_a_grain_that_jumps(void **state)
{
    (void)state;
    const double heights[] = {1.5e-3, 9e-3, 1e3};
    Bed bed;
    bed_create(&bed, 2, 1e-3, 0);
    place(&bed, 0, 0, 0, 1.5e-3, along_z);
    place(&bed, 1, 0, 0, 1.5e-3, along_z);
    OzLook look = oz_renderer_look(&bed.scene, &bed.snapshot);
    look.width = 600;
    look.height = 1200;
    look.view_count = 1;
    look.height_high = 5e-3; /* as of a flat bed: half the picture is left above */
    look.elevation = 0;
    OzCamera camera = oz_camera_make(&look, 0);
    double scale = camera.scale / camera.unit, middle = camera.centre[2];
    int side = (int)lround(camera.panels[0].middle_x + scale * 4e-3); /* the glass's edge */
    int framed = (int)(camera.panels[0].middle_y - scale * (look.height_high - middle));
    for (int i = 0; i < 3; i++) {
        bed.snapshot.position[5] = heights[i];
        OzImage image = draw(&bed, &look);
        int top = (int)(camera.panels[0].middle_y - scale * (heights[i] + 0.5e-3 - middle));
        int expected = i == 0 ? 0 : framed - (top > 0 ? top : 0);
        /* The line is three pixels wide and a hundredth of the height above the grain. */
        assert_near(drawn_above(&image, side, framed - 3), expected, 12);
        oz_image_free(&image);
    }
    bed_free(&bed);
}

static OzImage titled(const char *title)
{
    Bed bed;
    bed_create(&bed, 0, 0.5e-3, 0);
    bed.scene.title = (char *)(size_t)title;
    OzLook look = oz_renderer_look(&bed.scene, &bed.snapshot);
    look.width = 640;
    look.height = 480;
    OzImage image = draw(&bed, &look);
    bed_free(&bed);
    return image;
}

/* Rows of the first line that hold ink; *right is the last column that does. */
static int ink_rows(const OzImage *image, int *right)
{
    int rows = 0;
    *right = 0;
    for (int y = 0; y < 28; y++) { /* a margin of 11 and a line of 14 */
        int found = -1;
        for (int x = 0; x < image->width; x++) {
            found = pixel(image, x, y)[0] < 128 ? x : found;
        }
        rows += found >= 0;
        *right = found > *right ? found : *right;
    }
    return rows;
}

static void long_title_is_shortened_and_stays_readable(void **state)
{
    (void)state;
    char title[3000], cut[3000];
    int width, other, same = 0;
    memset(title, 'H', sizeof title - 1);
    title[sizeof title - 1] = '\0';
    memcpy(cut, title, sizeof cut);
    for (int i = 400; i < 2999; i += 2) { /* two bytes a letter: never cut in the middle */
        memcpy(cut + i, "\xc3\x84", 2);
    }
    cut[2998] = '\0';
    OzImage plain = titled("HHH"), longer = titled(title), mixed = titled(cut);
    int rows = ink_rows(&plain, &width);
    /* Letters shrink to 0.8 at most, and rounding takes a row. */
    assert_true(ink_rows(&longer, &other) >= 0.8 * rows - 1);
    assert_true(rows >= 8 && other > 600 && other < 640 - 10); /* within the margins */
    for (int i = 0; i < 640 * 28; i++) {
        same += same_colour(longer.pixels + 4 * (size_t)i, mixed.pixels + 4 * (size_t)i, 0);
    }
    assert_int_equal(same, 640 * 28); /* the same beginning */
    oz_image_free(&plain);
    oz_image_free(&longer);
    oz_image_free(&mixed);
}

/* Down from a rod that hovers over the floor of a large picture: its shadow fades without a step
 * that the eye takes for an edge. Of n pairs of neighbours each darkens the floor by 0.6 / n of its
 * 200 levels where it leaves the rod: six make steps of 20 and, two in a row, of 40; 54 of 2.2, of
 * which a few may fall into one row. */
static void shadows_have_no_hard_edges(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 1, 2e-3, 3e-3);
    place(&bed, 0, 0, 0, 3.5e-3, along_x);
    OzLook look = oz_renderer_look(&bed.scene, &bed.snapshot);
    look.width = 2400;
    look.height = 1800;
    look.view_count = 1;
    look.elevation = 0.8;
    OzCamera camera = oz_camera_make(&look, 0);
    double scale = camera.scale / camera.unit;
    double lowest = (3.5e-3 - camera.centre[2]) * cos(look.elevation) - 1e-3; /* of the rod */
    int column = (int)camera.panels[0].middle_x, step = 0, darkest = 255;
    int first = (int)(camera.panels[0].middle_y - scale * lowest) + 10; /* past its own outline */
    OzImage image = draw(&bed, &look);
    for (int y = first; y < first + 100; y++) {
        int here = pixel(&image, column, y)[1], next = pixel(&image, column, y + 1)[1];
        step = abs(here - next) > step ? abs(here - next) : step;
        darkest = here < darkest ? here : darkest;
    }
    assert_true(darkest < 200); /* there is a shadow */
    assert_in_range(step, 0, 12);
    oz_image_free(&image);
    bed_free(&bed);
}

static void look_frames_the_bed_and_its_walls(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 2, 0.5e-3, 2e-3);
    place(&bed, 0, 0, 0, 1.25e-3, along_x);
    place(&bed, 1, 0, 0, 9e-3, along_z);
    bed.walls[0].motion =
        (OzMotion){.present = true, .frequency = 30, .acceleration_ratio = 2, .amplitude = 5.5e-4};
    OzLook look = oz_renderer_look(&bed.scene, &bed.snapshot);
    assert_true(look.height_low < 1e-3 - 5.5e-4);
    assert_true(look.height_high > 9e-3 + 1.25e-3 + 2 * 5.5e-4);
    assert_near(look.half_width, 4e-3, 1e-12);
    assert_int_equal(look.view_count, 2);
    bed_free(&bed);
}

static void impossible_sizes_are_refused(void **state)
{
    (void)state;
    static const int sizes[][2] = {{63, 100}, {100, 63}, {8191, 100}, {100, 8191}};
    Bed bed;
    bed_create(&bed, 0, 1e-3, 0);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        OzLook look = plain_look(OZ_VIEW_LATERAL);
        OzImage image;
        look.width = sizes[i][0];
        look.height = sizes[i][1];
        assert_int_equal(oz_image_create(&image, look.width, look.height), OZ_OK);
        assert_int_equal(oz_renderer_draw(renderer, &bed.snapshot, &look, &image), OZ_ERR_GRAPHICS);
        assert_non_null(strstr(oz_status_text(), "cannot be drawn"));
        oz_image_free(&image);
    }
    bed_free(&bed);
}

static void png_gives_the_pixels_back(void **state)
{
    (void)state;
    OzImage image = full_picture(200, 161, 100, 0);
    const char *path = in_folder("picture.png");
    png_image png = {.version = PNG_IMAGE_VERSION};
    struct stat info;
    char part[300];
    assert_int_equal(oz_image_write_png(&image, path), OZ_OK);
    assert_true(png_image_begin_read_from_file(&png, path));
    png.format = PNG_FORMAT_RGBA;
    uint8_t *back = malloc(PNG_IMAGE_SIZE(png));
    assert_true(png_image_finish_read(&png, NULL, back, 0, NULL));
    assert_memory_equal(back, image.pixels, (size_t)200 * 161 * 4);
    free(back);
    snprintf(part, sizeof part, "%s.part", path);
    assert_int_not_equal(stat(part, &info), 0);
    assert_int_equal(oz_image_write_png(&image, "/nowhere/at/all.png"), OZ_ERR_FILE);
    oz_image_free(&image);
}

static OzImage picture_for_both(void)
{
    return full_picture(640, 360, 300, 0);
}

static void describe_names_both_back_ends(void **state)
{
    (void)state;
    FILE *file = fopen(in_folder("describe.txt"), "w+");
    assert_non_null(file);
    oz_renderer_describe(file);
    rewind(file);
    char found[2048] = "";
    size_t got = fread(found, 1, sizeof found - 1, file);
    found[got] = '\0';
    fclose(file);
    assert_non_null(strstr(found, "EGL"));
    assert_non_null(strstr(found, "OSMesa"));
}

static int end(void **state)
{
    (void)state;
    oz_renderer_free(renderer);
    return remove_folder((const char *const[]){"picture.png", "describe.txt", NULL});
}

/* All grey would say nothing. */
static void spheres_show_speed_in_the_place_of_an_angle(void **state)
{
    (void)state;
    for (int has_rod = 0; has_rod < 2; has_rod++) {
        Bed bed;
        bed_create(&bed, 2, 1e-3, 0);
        bed.grains.length[1] = has_rod * 1e-3;
        bed.scene.movie = (OzMovieSettings){
            .width = 640, .height = 480, .view_count = 1, .colour = OZ_COLOUR_ANGLE};
        bed.scene.snapshots.width = bed.scene.snapshots.height = 100;
        OzLook look = oz_renderer_look(&bed.scene, &bed.snapshot);
        OzLook still = oz_framing_still(&bed.scene, &look);
        OzColour expected = has_rod ? OZ_COLOUR_ANGLE : OZ_COLOUR_SPEED;
        assert_int_equal(look.colour, expected);
        assert_int_equal(still.colour, expected);
        bed_free(&bed);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(back_ends_draw_the_same),
        cmocka_unit_test(describe_names_both_back_ends),
        cmocka_unit_test(colours_tell_direction_and_speed),
        cmocka_unit_test(every_shape_of_picture_is_drawn),
        cmocka_unit_test(container_is_drawn_without_grains_and_its_floor_moves),
        cmocka_unit_test(walls_follow_a_grain_that_jumps),
        cmocka_unit_test(long_title_is_shortened_and_stays_readable),
        cmocka_unit_test(shadows_have_no_hard_edges),
        cmocka_unit_test(look_frames_the_bed_and_its_walls),
        cmocka_unit_test(spheres_show_speed_in_the_place_of_an_angle),
        cmocka_unit_test(impossible_sizes_are_refused),
        cmocka_unit_test(png_gives_the_pixels_back),
    };
    if (argc == 3) {
        return draw_in_child(argv[1], argv[2], picture_for_both);
    }
    return cmocka_run_group_tests(tests, begin_drawing, end);
}
