/* From where pictures are seen: silhouettes from above and from any side against exact areas, what
 * is in the middle, how large, and the two views of one picture. Never runs a simulation. */
#include "draw_bed.h"

static const double PI = 3.14159265358979323846;

static double disc_area(const OzLook *look, double radius)
{
    double pixels = pixels_per_metre(look) * radius;
    return PI * pixels * pixels;
}

/* The mean place of what is drawn in columns from `from` up to `to`, pixels from the top left. */
static void find_middle(const OzImage *image, int from, int to, double middle[2])
{
    double count = 0, sum[2] = {0, 0};
    for (int y = 0; y < image->height; y++) {
        for (int x = from; x < to; x++) {
            if (pixel(image, x, y)[1] < 255) {
                sum[0] += x + 0.5;
                sum[1] += y + 0.5;
                count++;
            }
        }
    }
    assert_true(count > 0);
    middle[0] = sum[0] / count;
    middle[1] = sum[1] / count;
}

/* Where a small sphere at these metres from the middle of what is framed is drawn, seen so, in
 * metres to the right and up from the middle of the picture. */
static void find_sphere(OzLook look, const double at[3], double seen[2])
{
    Bed bed;
    double middle[2], scale = pixels_per_metre(&look);
    bed_create(&bed, 1, 0.4e-3, 0);
    place(&bed, 0, at[0], at[1], 2e-3 + at[2], along_z);
    OzImage image = draw(&bed, &look);
    find_middle(&image, 0, image.width, middle);
    seen[0] = (middle[0] - 0.5 * image.width) / scale;
    seen[1] = (0.5 * image.height - middle[1]) / scale;
    oz_image_free(&image);
    bed_free(&bed);
}

/* What stands nearer by z looks larger by D / (D - z); a pixel is 1e-5 m. */
static void assert_seen(OzLook look, const double at[3], double right, double up, double nearer)
{
    double seen[2];
    OzCamera camera = oz_camera_make(&look, 0);
    double distance = camera.distance * camera.unit, larger = distance / (distance - nearer);
    find_sphere(look, at, seen);
    assert_near(seen[0], right * larger, 1e-5);
    assert_near(seen[1], up * larger, 1e-5);
}

static void a_place_is_seen_where_its_side_has_it(void **state)
{
    (void)state;
    static const double at[3] = {0.3e-3, 0.5e-3, 0.7e-3};
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    assert_seen(look, at, at[0], at[2], -at[1]);
    look.views[0] = OZ_VIEW_TOP;
    assert_seen(look, at, at[0], at[1], at[2]);
    look.views[0] = OZ_VIEW_FREE;
    assert_seen(look, at, at[0], at[2], -at[1]);
    look.free_azimuth = 0.5 * PI; /* the eye at +x: +y is to the right */
    assert_seen(look, at, at[1], at[2], at[0]);
    look.free_azimuth = PI;
    assert_seen(look, at, -at[0], at[2], at[1]);
    look.free_azimuth = 0.5 * PI;
    look.free_elevation = -0.5 * PI; /* from below, the eye's head to +x */
    assert_seen(look, at, at[1], at[0], -at[2]);
    look.free_elevation = PI / 6;
    assert_seen(look, at, at[1], -0.5 * at[0] + sqrt(0.75) * at[2],
                sqrt(0.75) * at[0] + 0.5 * at[2]);
}

static void a_rod_shows_the_side_that_is_seen(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_TOP);
    double shaft = 2 * 0.8e-3 * 2e-3 * pow(pixels_per_metre(&look), 2);
    double rim = 4 * PI * pixels_per_metre(&look) * 0.8e-3;
    /* End-on the nearer end, half a shaft nearer of 28 mm, hides the rest. */
    double end_on = disc_area(&look, 0.8e-3) * pow(28.0 / 27.0, 2);
    assert_area(drawn_by_one(look, 0, 1.6e-3, 2e-3, along_z), end_on, rim);
    assert_area(drawn_by_one(look, 0, 1.6e-3, 2e-3, along_x), disc_area(&look, 0.8e-3) + shaft,
                2 * rim);
    look.views[0] = OZ_VIEW_FREE;
    look.free_azimuth = 0.5 * PI;
    assert_area(drawn_by_one(look, 0, 1.6e-3, 2e-3, along_x), end_on, rim);
    assert_area(drawn_by_one(look, 0, 1.6e-3, 2e-3, along_y), disc_area(&look, 0.8e-3) + shaft,
                2 * rim);
}

static void zoom_and_target_choose_the_part(void **state)
{
    (void)state;
    static const double at[3] = {0.3e-3, 0.5e-3, 0.7e-3};
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    double scale = pixels_per_metre(&look), seen[2];
    look.zoom = 2;
    assert_near(pixels_per_metre(&look), 2 * scale, 1e-9 * scale);
    look.has_target = true;
    memcpy(look.target, (const double[]){0.1e-3, 0.5e-3, 2.2e-3}, sizeof look.target);
    find_sphere(look, at, seen);
    assert_near(seen[0], 0.2e-3, 1e-5);
    assert_near(seen[1], 0.5e-3, 1e-5);
    look.has_target = false;
    look.has_follow = true; /* the only grain */
    find_sphere(look, at, seen);
    assert_near(seen[0], 0, 1e-5);
    assert_near(seen[1], 0, 1e-5);
    look.zoom = 40; /* a sphere larger than the picture fills it */
    assert_int_equal(drawn_by_one(look, 0, 0.4e-3, 0, along_z), 600 * 600);
}

/* A rod that stands is a stadium from the front and a disc from above. */
static void two_views_are_of_two_sides(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    Bed bed;
    look.width = 1200;
    look.views[1] = OZ_VIEW_TOP;
    look.view_count = 2;
    bed_create(&bed, 1, 0.8e-3, 2e-3);
    place(&bed, 0, 0.4e-3, 0.6e-3, 2e-3, along_z);
    OzImage image = draw(&bed, &look);
    OzCamera cameras[2] = {oz_camera_make(&look, 0), oz_camera_make(&look, 1)};
    double scale = pixels_per_metre(&look), middles[2][2];
    find_middle(&image, 0, 600, middles[0]);
    find_middle(&image, 600, 1200, middles[1]);
    assert_near(cameras[0].scale, cameras[1].scale, 1e-12 * cameras[0].scale);
    /* Perspective moves a place by its 1 mm of 28 at most: 4 % of its distance from the middle. */
    for (int k = 0; k < 2; k++) {
        const OzPanel *panel = &cameras[k].panels[k];
        assert_near(middles[k][0], panel->middle_x + scale * 0.4e-3, 0.04 * scale * 0.4e-3 + 1);
        assert_near(middles[k][1], panel->middle_y - k * scale * 0.6e-3, 0.04 * scale * 0.6e-3 + 1);
    }
    oz_image_free(&image);
    bed_free(&bed);
}

/* The container is there with it: more is drawn than the grain, and on paper nothing but that. */
static void paper_is_white_and_without_text(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 1, 1e-3, 0);
    place(&bed, 0, 0, 0, 1.5e-3, along_z);
    OzLook look = oz_renderer_look(&bed.scene, &bed.snapshot);
    look.plain = true;
    OzImage image = draw(&bed, &look);
    static const uint8_t white[3] = {255, 255, 255};
    assert_true(same_colour(pixel(&image, 2, 2), white, 0));
    for (int y = 0; y < image.height; y++) {
        assert_true(same_colour(pixel(&image, image.width - 40, y), white, 0)); /* no legend */
    }
    assert_true(count_drawn(&image) > 10000);
    oz_image_free(&image);
    look.has_background = true;
    memcpy(look.background, (const float[]){0, 0.2f, 0.4f}, sizeof look.background);
    image = draw(&bed, &look);
    assert_true(same_colour(pixel(&image, 2, 2), (const uint8_t[]){0, 51, 102}, 0));
    oz_image_free(&image);
    bed_free(&bed);
}

/* A still bed's colours end at the speed of a fall through it, or where the scene says. */
static void colours_by_speed_end_where_the_scene_says(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 1, 1e-3, 0);
    place(&bed, 0, 0, 0, 1.5e-3, along_z);
    assert_true(oz_renderer_look(&bed.scene, &bed.snapshot).speed_high > 0.05);
    bed.scene.movie.speed_scale = 0.03;
    assert_true(oz_renderer_look(&bed.scene, &bed.snapshot).speed_high == 0.03);
    bed_free(&bed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_place_is_seen_where_its_side_has_it),
        cmocka_unit_test(a_rod_shows_the_side_that_is_seen),
        cmocka_unit_test(zoom_and_target_choose_the_part),
        cmocka_unit_test(two_views_are_of_two_sides),
        cmocka_unit_test(paper_is_white_and_without_text),
        cmocka_unit_test(colours_by_speed_end_where_the_scene_says),
    };
    return cmocka_run_group_tests(tests, begin_drawing, end_drawing);
}
