/* Whole pictures of snapshots written by hand: colours, container, sizes, framing, files, the two
 * GL back-ends against each other. Never runs a simulation. */
#include "draw_bed.h"

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
    static const int sizes[][2] = {{63, 100}, {100, 63}, {8193, 100}, {100, 8193}};
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

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(back_ends_draw_the_same),
        cmocka_unit_test(describe_names_both_back_ends),
        cmocka_unit_test(colours_tell_direction_and_speed),
        cmocka_unit_test(every_shape_of_picture_is_drawn),
        cmocka_unit_test(container_is_drawn_without_grains_and_its_floor_moves),
        cmocka_unit_test(look_frames_the_bed_and_its_walls),
        cmocka_unit_test(impossible_sizes_are_refused),
        cmocka_unit_test(png_gives_the_pixels_back),
    };
    if (argc == 3) {
        return draw_in_child(argv[1], argv[2], picture_for_both);
    }
    return cmocka_run_group_tests(tests, begin_drawing, end);
}
