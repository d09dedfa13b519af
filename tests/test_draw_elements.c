/* Pictures of flat grains, against areas and colours that are known. */
#include "draw_rig.h"
#include "hand_heap.h"

#include "draw/palette.h"
#include "draw/pictures.h"
#include "observe/frames.h"

static const double PI = 3.14159265358979323846;
enum { SIDE = 600 };

/* 4 mm about the origin in 600 pixels, grains alone. */
static OzLook plain_look(void)
{
    return (OzLook){.width = SIDE,
                    .height = SIDE,
                    .view_count = 1,
                    .colour = OZ_COLOUR_TYPE,
                    .height_low = -2e-3,
                    .height_high = 2e-3,
                    .half_width = 2e-3,
                    .speed_high = 1,
                    .bare = true,
                    .flat = true,
                    .outlines = true};
}

static OzImage draw(const Heap *heap, const OzLook *look)
{
    return draw_states(&heap->snapshot, 1, look);
}

/* The pixel at a place of the plane, m. */
static const uint8_t *pixel_at(const OzImage *image, const OzLook *look, double x, double y)
{
    double scale = pixels_per_metre(look);
    size_t column = (size_t)(0.5 * image->width + scale * x);
    size_t row = (size_t)(0.5 * image->height - scale * y);
    return image->pixels + 4 * (row * (size_t)image->width + column);
}

static bool has_colour(const uint8_t *pixel, const float rgb[3])
{
    for (int k = 0; k < 3; k++) {
        if (fabs(pixel[k] - 255.0 * (double)rgb[k]) > 1.01) { /* rounding, once each way */
            return false;
        }
    }
    return true;
}

static double darkness(const uint8_t *pixel)
{
    return 1 - (pixel[0] + pixel[1] + pixel[2]) / 765.0;
}

static void square_covers_its_area(void **state)
{
    (void)state;
    OzLook look = plain_look();
    double edge = 1.5e-3, pixels = edge * pixels_per_metre(&look);
    for (int turned = 0; turned < 3; turned++) {
        Heap heap;
        heap_create(&heap, 1, 0, 0);
        heap_put_square(&heap, 0, 0.2e-3, -0.3e-3, edge, 0.31 + turned);
        heap_start(&heap);
        for (int outlines = 0; outlines < 2; outlines++) {
            look.outlines = outlines;
            OzImage image = draw(&heap, &look);
            assert_area(count_drawn(&image), pixels * pixels, 4 * pixels);
            oz_image_free(&image);
        }
        heap_free(&heap);
    }
}

static void grain_has_one_colour_and_a_mark(void **state)
{
    (void)state;
    Heap heap;
    OzLook look = plain_look();
    float rgb[3], dark[3];
    heap_create(&heap, 1, 0, 0);
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0);
    heap_start(&heap);
    oz_palette_type(0, rgb);
    for (int k = 0; k < 3; k++) {
        dark[k] = 0.6f * rgb[k];
    }
    OzImage image = draw(&heap, &look);
    assert_true(has_colour(pixel_at(&image, &look, 0, -0.6e-3), dark));
    assert_true(has_colour(pixel_at(&image, &look, 0.6e-3, 0), rgb));
    assert_true(has_colour(pixel_at(&image, &look, 0, 0.6e-3), rgb));
    assert_true(has_colour(pixel_at(&image, &look, 0.5e-3, 0.5e-3), rgb)); /* no inner lines */
    oz_image_free(&image);
    heap_move(&heap, 0, 0, 0, PI / 2); /* down has become right */
    image = draw(&heap, &look);
    assert_true(has_colour(pixel_at(&image, &look, 0.6e-3, 0), dark));
    assert_true(has_colour(pixel_at(&image, &look, 0, -0.6e-3), rgb));
    oz_image_free(&image);
    heap_free(&heap);
}

static void outline_lies_along_the_inside(void **state)
{
    (void)state;
    Heap heap;
    OzLook look = plain_look();
    heap_create(&heap, 1, 0, 0);
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0);
    heap_start(&heap);
    double pixel = 1 / pixels_per_metre(&look), rim = 1e-3 - 0.5 * pixel;
    for (int outlines = 0; outlines < 2; outlines++) {
        look.outlines = outlines;
        OzImage image = draw(&heap, &look);
        double edge = darkness(pixel_at(&image, &look, rim, 0));
        double inside = darkness(pixel_at(&image, &look, rim - 4 * pixel, 0));
        assert_int_equal(edge > inside + 0.1, outlines);
        assert_true(darkness(pixel_at(&image, &look, rim + 2 * pixel, 0)) == 0);
        oz_image_free(&image);
    }
    heap_free(&heap);
}

static void beams_are_drawn_on_demand(void **state)
{
    (void)state;
    Heap heap;
    OzLook look = plain_look();
    heap_create(&heap, 1, 0, 0);
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0);
    heap_start(&heap);
    double middle = 1e-3 / 3; /* between the centres of the right and the upper triangle */
    for (int beams = 0; beams < 2; beams++) {
        look.beams = beams;
        OzImage image = draw(&heap, &look);
        const uint8_t *seen = pixel_at(&image, &look, middle, middle);
        assert_int_equal(seen[0] > seen[2] + 80, beams); /* red, on blue */
        oz_image_free(&image);
    }
    heap_free(&heap);
}

static void disc_covers_its_area_and_shows_its_turn(void **state)
{
    (void)state;
    Heap heap;
    OzLook look = plain_look();
    float rgb[3];
    double radius = 1.2e-3, pixels = radius * pixels_per_metre(&look);
    heap_create(&heap, 0, 1, 0);
    heap_put_disc(&heap, 0, 0, 0, radius);
    heap_start(&heap);
    oz_palette_type(0, rgb);
    for (int turn = 0; turn < 2; turn++) {
        OzImage image = draw(&heap, &look);
        assert_area(count_drawn(&image), PI * pixels * pixels, 2 * PI * pixels);
        assert_int_equal(has_colour(pixel_at(&image, &look, 0.7e-3, 0), rgb), turn);
        assert_int_equal(has_colour(pixel_at(&image, &look, 0, 0.7e-3), rgb), !turn);
        assert_true(has_colour(pixel_at(&image, &look, -0.7e-3, 0.1e-3), rgb));
        oz_image_free(&image);
        heap_move(&heap, 0, 0, 0, PI / 2);
    }
    heap_free(&heap);
}

static void colours_tell_speed_and_turn(void **state)
{
    (void)state;
    static const OzColour colours[] = {OZ_COLOUR_SPEED, OZ_COLOUR_GREY, OZ_COLOUR_TURNED};
    Heap heap;
    OzLook look = plain_look();
    float expected[3][3];
    heap_create(&heap, 0, 1, 0);
    heap_put_disc(&heap, 0, 0, 0, 1e-3);
    heap_start(&heap);
    heap_push(&heap, 0, 0.18, -0.24, 5);
    heap_move(&heap, 0, 0, 0, 0.5 * PI);
    oz_palette_viridis(0.3, expected[0]);
    oz_palette_grey(0.3, expected[1]);
    oz_palette_cyclic(0.25, expected[2]);
    for (int i = 0; i < 3; i++) {
        look.colour = colours[i];
        OzImage image = draw(&heap, &look);
        assert_true(has_colour(pixel_at(&image, &look, -0.5e-3, -0.2e-3), expected[i]));
        oz_image_free(&image);
    }
    heap_free(&heap);
}

/* A rectangle of 3 mm x 1 mm as grain 0, its long side at the angle. */
static void put_rectangle(Heap *heap, double angle)
{
    static const double side[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    double corner[5][2], c = cos(angle), s = sin(angle);
    for (int i = 0; i < 5; i++) {
        double x = 1.5e-3 * side[i][0], y = 0.5e-3 * side[i][1];
        corner[i][0] = c * x - s * y;
        corner[i][1] = s * x + c * y;
    }
    for (int i = 0; i < 4; i++) {
        const double corners[6] = {
            0, 0, corner[i][0], corner[i][1], corner[i + 1][0], corner[i + 1][1]};
        assert_int_equal(oz_elements_set_triangle(heap->grains.elements, i, corners, HEAP_DENSITY),
                         OZ_OK);
    }
}

/* The angle is that of the long side whatever happened since the start, and of half a turn it is
 * the same; turning is told by the other colour. A square has no long side. */
static void colour_of_angle_is_the_long_axis(void **state)
{
    (void)state;
    const double starts[] = {0.3, 2.5};
    Heap heap;
    OzLook look = plain_look();
    float axis[3], turned[3];
    for (int i = 0; i < 4; i++) {
        double turn = i < 2 ? 0.4 : 0.4 + PI, angle = starts[i % 2] + turn;
        heap_create(&heap, 1, 0, 0);
        put_rectangle(&heap, starts[i % 2]);
        heap_start(&heap);
        heap_move(&heap, 0, 0, 0, turn);
        oz_palette_cyclic(fmod(angle, PI) / PI, axis);
        oz_palette_cyclic(turn / (2 * PI), turned);
        for (int c = 0; c < 2; c++) {
            look.colour = c ? OZ_COLOUR_TURNED : OZ_COLOUR_ANGLE;
            OzImage image = draw(&heap, &look);
            /* above the middle as it was made: not the darker element */
            const uint8_t *seen =
                pixel_at(&image, &look, -0.3e-3 * sin(angle), 0.3e-3 * cos(angle));
            assert_true(has_colour(seen, c ? turned : axis));
            oz_image_free(&image);
        }
        heap_free(&heap);
    }
    heap_create(&heap, 1, 0, 0);
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0.3);
    heap_start(&heap);
    look.colour = OZ_COLOUR_ANGLE;
    OzImage image = draw(&heap, &look);
    const uint8_t *seen = pixel_at(&image, &look, -0.5e-3 * sin(0.3), 0.5e-3 * cos(0.3));
    assert_true(abs(seen[0] - seen[1]) < 12 && abs(seen[1] - seen[2]) < 12); /* grey */
    oz_image_free(&image);
    heap_free(&heap);
}

static void wall_is_drawn_until_it_is_gone(void **state)
{
    (void)state;
    Heap heap;
    OzLook look = plain_look();
    look.bare = false;
    heap_create(&heap, 0, 1, 1);
    heap_put_disc(&heap, 0, 0, 1e-3, 0.3e-3);
    heap_put_wall(&heap, 0, (const double[6]){-1e-3, -1e-3, 1e-3, -1e-3, 0, 0.5e-3});
    heap_start(&heap);
    heap.wall.until = 0.5;
    double shown[3];
    for (int i = 0; i < 3; i++) {
        heap.snapshot.time = 0.25 * (i + 1);
        OzImage image = draw(&heap, &look);
        OzCamera camera = oz_camera_make(&look, 0);
        const OzPanel *panel = &camera.panels[0];
        size_t row = (size_t)(panel->middle_y + 0.4e-3 * camera.scale / camera.unit);
        shown[i] = darkness(image.pixels + 4 * (row * SIDE + (size_t)panel->middle_x));
        oz_image_free(&image);
    }
    assert_true(shown[0] > 0.15); /* a calm grey, on nearly white */
    assert_true(shown[1] < 0.05 && shown[2] < 0.05);
    heap_free(&heap);
}

static void later_states_are_stronger(void **state)
{
    (void)state;
    enum { STATES = 4 };
    Heap heap;
    OzSnapshot states[STATES];
    OzLook look = plain_look();
    heap_create(&heap, 1, 0, 0);
    heap_put_square(&heap, 0, -1.5e-3, 0, 0.8e-3, 0);
    heap_start(&heap);
    for (int i = 0; i < STATES; i++) {
        assert_int_equal(oz_snapshot_copy(&states[i], &heap.snapshot), OZ_OK);
        heap_move(&heap, 0, 1e-3, 0, 0);
    }
    OzImage image = draw_states(states, STATES, &look);
    double last = 0;
    for (int i = 0; i < STATES; i++) {
        double next = darkness(pixel_at(&image, &look, (i - 1.5) * 1e-3, 0.2e-3));
        assert_true(next > last + 0.05);
        last = next;
    }
    oz_image_free(&image);
    image = draw_states(&states[STATES - 1], 1, &look); /* and the last is as strong as alone */
    assert_true(darkness(pixel_at(&image, &look, 1.5e-3, 0.2e-3)) == last);
    oz_image_free(&image);
    for (int i = 0; i < STATES; i++) {
        oz_snapshot_free(&states[i]);
    }
    heap_free(&heap);
}

static void gallery_ends_with_the_strobe(void **state)
{
    (void)state;
    Heap heap;
    OzPictures *pictures = NULL;
    OzPicturesSettings settings = {.folder = folder, .renderer = &renderer};
    char path[256], second[256];
    snprintf(path, sizeof path, "%s/snapshots/strobe.png", folder);
    snprintf(second, sizeof second, "%s/snapshots/time_0.500000.png", folder);
    heap_create(&heap, 2, 0, 0);
    heap.scene.snapshots.strobe = 0.25;
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0.3);
    heap_put_square(&heap, 1, 4e-3, 0.3e-3, 2e-3, 0.3);
    heap_start(&heap);
    heap_push(&heap, 0, 4e-3, 0, 0);
    assert_int_equal(oz_pictures_create(&pictures, &settings, &heap.scene), OZ_OK);
    for (int i = 0; i < 4; i++) {
        heap.snapshot.time = 0.25 * i;
        int purpose = OZ_FRAME_STROBE | (i == 2 ? OZ_FRAME_SNAPSHOT : 0);
        assert_int_equal(oz_pictures_add(pictures, &heap.snapshot, purpose), OZ_OK);
        heap_move(&heap, 0, 1e-3, 0, 0);
    }
    assert_false(oz_file_exists(path));
    assert_int_equal(oz_pictures_finish(pictures), OZ_OK);
    assert_true(oz_file_exists(path));
    assert_true(oz_file_exists(second));
    remove(path);
    remove(second);
    heap_free(&heap);
}

static void look_frames_drum_outlet_and_flight(void **state)
{
    (void)state;
    Heap heap;
    heap_create(&heap, 0, 1, 1);
    heap_put_disc(&heap, 0, 1e-3, 0, 1e-3);
    heap_put_wall(&heap, 0, (const double[6]){3e-3, 4e-3, 3e-3, 3.5e-3, 2.5e-3, 4e-3});
    heap.wall.motion = (OzMotion){.present = true, .angular_velocity = 1};
    heap_start(&heap);
    OzLook look = oz_renderer_look(&heap.scene, &heap.snapshot);
    assert_true(look.flat && look.view_count == 1 && look.elevation == 0);
    assert_int_equal(look.colour,
                     OZ_COLOUR_SPEED); /* as movie.colour, which there is none of here */
    assert_true(look.half_width >= 5e-3 && look.half_width < 5.5e-3); /* all around, and a margin */
    assert_true(look.height_low <= -5e-3 && look.height_high >= 5e-3);
    heap.scene.observe = (OzObserve){.outlet = -20e-3, .has_outlet = true};
    look = oz_renderer_look(&heap.scene, &heap.snapshot);
    assert_true(look.height_low < -22e-3 && look.height_high < 6e-3);
    heap_free(&heap);
    heap_create(&heap, 0, 1, 0);
    heap_put_disc(&heap, 0, 0, 0, 1e-3);
    heap_start(&heap);
    heap_push(&heap, 0, 5e-3, 0, 0); /* 5 mm in the run's second */
    look = oz_renderer_look(&heap.scene, &heap.snapshot);
    assert_true(look.centre[0] + look.half_width > 6e-3);
    assert_true(look.centre[0] - look.half_width < -1e-3);
    assert_true(look.speed_high == 5e-3);
    heap_free(&heap);
}

static OzImage picture_for_both(void)
{
    Heap heap;
    heap_create(&heap, 2, 1, 1);
    heap.scene.name = "picture";
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0.3);
    heap_put_square(&heap, 1, 3e-3, 1e-3, 2e-3, 0.8);
    heap_put_disc(&heap, 2, 1e-3, 3e-3, 0.8e-3);
    heap_put_wall(&heap, 0, (const double[6]){-2e-3, -3e-3, 6e-3, -3e-3, 1e-3, -2e-3});
    heap_start(&heap);
    OzLook look = oz_renderer_look(&heap.scene, &heap.snapshot);
    look.width = 640;
    look.height = 360;
    OzImage image = draw(&heap, &look);
    heap_free(&heap);
    return image;
}

static int end(void **state)
{
    (void)state;
    oz_renderer_free(renderer);
    return remove_folder((const char *const[]){"snapshots", NULL});
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(back_ends_draw_the_same),
        cmocka_unit_test(square_covers_its_area),
        cmocka_unit_test(grain_has_one_colour_and_a_mark),
        cmocka_unit_test(outline_lies_along_the_inside),
        cmocka_unit_test(beams_are_drawn_on_demand),
        cmocka_unit_test(disc_covers_its_area_and_shows_its_turn),
        cmocka_unit_test(colours_tell_speed_and_turn),
        cmocka_unit_test(colour_of_angle_is_the_long_axis),
        cmocka_unit_test(wall_is_drawn_until_it_is_gone),
        cmocka_unit_test(later_states_are_stronger),
        cmocka_unit_test(gallery_ends_with_the_strobe),
        cmocka_unit_test(look_frames_drum_outlet_and_flight),
    };
    if (argc == 3) {
        return draw_in_child(argv[1], argv[2], picture_for_both);
    }
    return cmocka_run_group_tests(tests, begin_drawing, end);
}
