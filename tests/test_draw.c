/* Grains drawn from snapshots written by hand: silhouettes and cut faces against exact areas, depth
 * order. Never runs a simulation. */
#include "draw_bed.h"

static const double PI = 3.14159265358979323846;

/* In the picture's plane but not along its rows or columns, where a whole edge would be rounded to
 * the same pixel. */
static const double askew[3] = {0.96, 0, 0.28}, steep[3] = {-0.28, 0, 0.96};

/* From the distance D a sphere of radius r looks like a disc of D r / sqrt(D^2 - r^2) in the plane
 * through its centre. */
static double disc_from(double distance, double radius)
{
    return distance * radius / sqrt(distance * distance - radius * radius);
}

static double eye_distance(const OzLook *look)
{
    OzCamera camera = oz_camera_make(look, 0);
    return camera.distance * camera.unit;
}

static void sphere_covers_its_disc(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    for (int raised = 0; raised < 2; raised++) {
        look.elevation = 0.5 * raised;
        double radius = pixels_per_metre(&look) * disc_from(eye_distance(&look), 1.5e-3);
        assert_area(drawn_by_one(look, 0, 3e-3, 0, along_z), PI * radius * radius, 2 * PI * radius);
    }
}

static void rod_covers_its_stadium(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    double scale = pixels_per_metre(&look), radius = scale * disc_from(eye_distance(&look), 0.4e-3);
    double shaft = scale * 2e-3;
    double area = PI * radius * radius + 2 * radius * shaft;
    assert_area(drawn_by_one(look, 0, 0.8e-3, 2e-3, askew), area, 2 * (PI * radius + shaft));
    assert_area(drawn_by_one(look, 0, 0.8e-3, 2e-3, steep), area, 2 * (PI * radius + shaft));
}

/* Seen end-on, the nearer end hides the rest and looks larger by what it stands nearer. */
static void rod_end_on_covers_a_disc(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    double far = eye_distance(&look), near = far - 1e-3;
    double radius = pixels_per_metre(&look) * disc_from(near, 0.8e-3) * far / near;
    assert_area(drawn_by_one(look, 0, 1.6e-3, 2e-3, along_y), PI * radius * radius,
                2 * PI * radius);
}

static void slanted_rod_covers_its_shadow(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    double scale = pixels_per_metre(&look), radius = scale * disc_from(eye_distance(&look), 0.4e-3);
    const double axis[3] = {0.48, 0.6, 0.64};
    double shaft = 0.8 * scale * 2e-3; /* the eye looks along y */
    double area = PI * radius * radius + 2 * radius * shaft;
    int count = drawn_by_one(look, 0, 0.8e-3, 2e-3, axis);
    /* The near half grows by as much as the far half shrinks; squares of 4 % are left, and the band
     * of samples about the outline, which is 1 % here. */
    assert_near(count, area, 0.015 * area);
}

static void grain_before_the_cut_shows_its_section_alone(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_CUT);
    double scale = pixels_per_metre(&look), before = 0.6e-3;
    double radius = scale * sqrt(1.5e-3 * 1.5e-3 - before * before);
    assert_area(drawn_by_one(look, -before, 3e-3, 0, along_z), PI * radius * radius,
                2 * PI * radius);
    before = 0.2e-3;
    radius = scale * sqrt(0.4e-3 * 0.4e-3 - before * before);
    double shaft = scale * 2e-3;
    assert_area(drawn_by_one(look, -before, 0.8e-3, 2e-3, askew),
                PI * radius * radius + 2 * radius * shaft, 2 * (PI * radius + shaft));
    assert_int_equal(drawn_by_one(look, -1.6e-3, 3e-3, 0, along_z), 0);
}

static void upright_cut_through_a_rod_is_a_disc(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_CUT);
    double radius = pixels_per_metre(&look) * 0.8e-3;
    /* What lies behind the plane looks smaller than the section. */
    assert_area(drawn_by_one(look, 0.3e-3, 1.6e-3, 2e-3, along_y), PI * radius * radius,
                2 * PI * radius);
}

/* The flat face is one colour up to the outline, which lies between the surface and 0.14 radii
 * within. */
static void section_is_flat_in_the_colour_of_its_grain(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_CUT);
    Bed bed;
    float rgb[3];
    bed_create(&bed, 1, 3e-3, 0);
    place(&bed, 0, 0, 0, 2e-3, along_z);
    OzImage image = draw(&bed, &look);
    oz_palette_type(0, rgb);
    uint8_t face[3], centre[3];
    for (int k = 0; k < 3; k++) {
        face[k] = (uint8_t)lroundf(255 * (0.92f * rgb[k] + 0.08f));
    }
    memcpy(centre, pixel(&image, 300, 300), 3);
    assert_true(same_colour(centre, face, 3));
    int flat = 0;
    for (int i = 0; i < image.width * image.height; i++) {
        flat += same_colour(image.pixels + 4 * (size_t)i, centre, 1);
    }
    double radius = 0.86 * 1.5e-3 * pixels_per_metre(&look);
    /* Half a pixel of the rim is blended with the outline. */
    assert_near(flat, PI * radius * radius, 1.0 * 2 * PI * radius);
    oz_image_free(&image);
    bed_free(&bed);
}

static void colour_of_type(int row, const OzImage *image, int x, int y, bool expected)
{
    float rgb[3];
    oz_palette_type(row, rgb);
    const uint8_t *got = pixel(image, x, y);
    /* Light changes brightness; of these two types, one is bluer than red, the other redder. */
    bool bluer = got[2] > got[0], wanted = rgb[2] > rgb[0];
    if ((bluer == wanted) != expected) {
        fail_msg("pixel %d %d is %d %d %d", x, y, got[0], got[1], got[2]);
    }
}

static void nearer_rod_hides_the_other(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    Bed bed;
    bed_create(&bed, 2, 0.8e-3, 2e-3);
    bed.grains.population[1] = 1;
    for (int front = 0; front < 2; front++) {
        place(&bed, 0, 0, front == 0 ? -1e-3 : 1e-3, 2e-3, along_x);
        place(&bed, 1, 0, front == 0 ? 1e-3 : -1e-3, 2e-3, along_z);
        OzImage image = draw(&bed, &look);
        colour_of_type(front, &image, 300, 300, true);
        oz_image_free(&image);
    }
    bed_free(&bed);
}

/* Two equal spheres side by side that share half their bodies part along the middle column. */
static void depth_is_exact_within_a_pixel(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    Bed bed;
    bed_create(&bed, 2, 2e-3, 0);
    bed.grains.population[1] = 1;
    place(&bed, 0, -0.4e-3, 0, 2e-3, along_z);
    place(&bed, 1, 0.4e-3, 0, 2e-3, along_z);
    OzImage image = draw(&bed, &look);
    for (int y = 220; y <= 380; y += 20) {
        colour_of_type(0, &image, 297, y, true);
        colour_of_type(1, &image, 302, y, true);
    }
    oz_image_free(&image);
    bed_free(&bed);
}

/* What the cut takes away whole leaves its outline and nothing within. */
static void outline_of_a_grain_before_the_cut_is_a_ring(void **state)
{
    (void)state;
    OzLook look = plain_look(OZ_VIEW_CUT);
    look.cut_outlines = true;
    Bed bed;
    bed_create(&bed, 1, 2e-3, 0);
    place(&bed, 0, 0, -1.2e-3, 2e-3, along_z);
    OzImage image = draw(&bed, &look);
    /* Half the grain's distance from the eye nearer than the plane through the middle. */
    double eye = eye_distance(&look), scale = pixels_per_metre(&look) * eye / (eye - 1.2e-3);
    double radius = scale * disc_from(eye - 1.2e-3, 1e-3);
    double width = 0.11 * 1e-3 * pixels_per_metre(&look);
    double ring = PI * (radius * radius - (radius - width) * (radius - width));
    assert_near(count_drawn(&image), ring, 4 * PI * radius); /* a pixel at both of its edges */
    assert_int_equal(pixel(&image, 300, 300)[0], 255);
    const uint8_t *rim = pixel(&image, 300 + (int)(radius - 0.5 * width), 300);
    assert_true(rim[2] > rim[0] && rim[0] > 60); /* faint, in the hue of its type */
    oz_image_free(&image);
    look.cut_outlines = false;
    assert_int_equal(drawn_by_one(look, -1.2e-3, 2e-3, 0, along_z), 0);
    bed_free(&bed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_covers_its_disc),
        cmocka_unit_test(rod_covers_its_stadium),
        cmocka_unit_test(rod_end_on_covers_a_disc),
        cmocka_unit_test(slanted_rod_covers_its_shadow),
        cmocka_unit_test(grain_before_the_cut_shows_its_section_alone),
        cmocka_unit_test(upright_cut_through_a_rod_is_a_disc),
        cmocka_unit_test(section_is_flat_in_the_colour_of_its_grain),
        cmocka_unit_test(outline_of_a_grain_before_the_cut_is_a_ring),
        cmocka_unit_test(nearer_rod_hides_the_other),
        cmocka_unit_test(depth_is_exact_within_a_pixel),
    };
    return cmocka_run_group_tests(tests, begin_drawing, end_drawing);
}
