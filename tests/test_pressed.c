/* What pictures show of contacts: colours by force and by contacts, and chains, whose tubes are
 * measured. Never runs a simulation. */
#include "draw_bed.h"

#include "draw/pressed.h"

enum { SMALL = 500 }; /* pixels */

/* Three spheres of 1 mm in a row, the outer ones 1.2 mm from the middle one, which pushes the first
 * by 1 N twice and stands on wall 0 with 3 N. */
static void make_row(Bed *bed)
{
    static const OzContactEntry contacts[] = {
        {.a = 0, .b = 1, .part_b = 0, .push = 1},
        {.a = 0, .b = 1, .part_b = 1, .push = 1},
        {.a = 1, .b = -1, .push = 3, .point = {0, 0, 1.2e-3}},
    };
    bed_create(bed, 3, 1e-3, 0);
    for (int64_t i = 0; i < 3; i++) {
        place(bed, i, 1.2e-3 * (double)(i - 1), 0, 2e-3, along_z);
    }
    for (int k = 0; k < 3; k++) {
        assert_int_equal(oz_contact_list_add(&bed->snapshot.contacts, &contacts[k]), OZ_OK);
    }
    bed->snapshot.has_contacts = true;
}

static OzLook look_of(OzColour colour, bool chains)
{
    OzLook look = plain_look(OZ_VIEW_LATERAL);
    look.width = look.height = SMALL;
    look.colour = colour;
    look.chains = chains;
    look.force_high = 10;
    return look;
}

static void shares_are_sums_over_contacts(void **state)
{
    (void)state;
    OzPressed pressed = {0};
    OzLook look = look_of(OZ_COLOUR_FORCE, false);
    Bed bed;
    make_row(&bed);
    assert_int_equal(oz_pressed_find(&pressed, &bed.snapshot, &look), OZ_OK);
    const double forces[3] = {0.2, 0.5, 0};
    const double neighbours[3] = {1.0 / 12, 2.0 / 12, 0}; /* the wall is one */
    for (int i = 0; i < 3; i++) {
        assert_near(pressed.share[i], forces[i], 1e-15);
    }
    look.colour = OZ_COLOUR_COORDINATION;
    assert_int_equal(oz_pressed_find(&pressed, &bed.snapshot, &look), OZ_OK);
    for (int i = 0; i < 3; i++) {
        assert_near(pressed.share[i], neighbours[i], 1e-15);
    }
    bed.snapshot.has_contacts = false;
    assert_int_equal(oz_pressed_find(&pressed, &bed.snapshot, &look), OZ_OK);
    assert_near(pressed.share[1], 0, 0);
    oz_pressed_free(&pressed);
    bed_free(&bed);
}

static void a_pair_is_one_chain(void **state)
{
    (void)state;
    OzPressed pressed = {0};
    OzLook look = look_of(OZ_COLOUR_ANGLE, true);
    Bed bed;
    make_row(&bed);
    assert_int_equal(oz_pressed_find(&pressed, &bed.snapshot, &look), OZ_OK);
    assert_int_equal(pressed.chain_count, 2);
    assert_near(pressed.chains[0].push, 2, 0);
    assert_near(pressed.chains[0].from[0], -1.2e-3, 1e-18);
    assert_near(pressed.chains[0].to[0], 0, 1e-18);
    assert_near(pressed.chains[1].push, 3, 0);
    assert_near(pressed.chains[1].to[2], 1.2e-3, 1e-18);
    assert_near(oz_pressed_width(&pressed.chains[0], &look), 0.2 * 0.6, 1e-15);
    pressed.chains[0].push = 100;
    assert_near(oz_pressed_width(&pressed.chains[0], &look), 0.6, 1e-15);
    oz_pressed_free(&pressed);
    bed_free(&bed);
}

/* Rows of the column at x (m from the middle) that are drawn, as metres. */
static double drawn_height(const OzImage *image, const OzLook *look, double x)
{
    double scale = pixels_per_metre(look), ink = 0;
    int column = (int)(0.5 * image->width + scale * x);
    for (int y = 0; y < image->height; y++) {
        ink += pixel(image, column, y)[1] < 255;
    }
    return ink / scale;
}

/* Between the thin spheres, of 0.35 of 1 mm, a tube of 0.6 of 0.2 mm; on the other side nothing. */
static void a_chain_is_a_tube_between_thin_grains(void **state)
{
    (void)state;
    OzLook look = look_of(OZ_COLOUR_ANGLE, true);
    double pixel_size = 1 / pixels_per_metre(&look);
    Bed bed;
    make_row(&bed);
    OzImage image = draw(&bed, &look);
    /* Half a pixel at either side is drawn beyond an outline (assert_area). */
    assert_near(drawn_height(&image, &look, -0.6e-3), 0.12e-3, 1.5 * pixel_size);
    assert_near(drawn_height(&image, &look, -1.2e-3), 0.35e-3, 1.5 * pixel_size);
    assert_near(drawn_height(&image, &look, 1.2e-3), 0.35e-3, 1.5 * pixel_size);
    assert_near(drawn_height(&image, &look, 0.6e-3), 0, 0);
    const uint8_t *tube = pixel(&image, (int)(SMALL / 2 - 0.6e-3 / pixel_size), SMALL / 2);
    assert_true(tube[0] > 2 * tube[1] && tube[0] > 2 * tube[2]); /* red */
    oz_image_free(&image);
    bed_free(&bed);
}

/* A column of 100 grains of weight w over a floor of width b: a grain on the floor has 100 w / b^2
 * times pi d^2 around it, rounded up to 1, 2 or 5 times a power of ten. */
static void the_scale_is_that_of_the_weight(void **state)
{
    (void)state;
    Bed bed;
    OzLook look = {.half_width = 4e-3};
    bed_create(&bed, 100, 1e-3, 0);
    double weight = 100 * 2500 * 3.14159265358979 / 6 * 1e-9 * 9.81; /* 1.284e-3 N */
    double force = weight / 64e-6 * 3.14159265358979 * 1e-6;         /* 6.30e-5 N  */
    double scale = oz_pressed_scale(&bed.snapshot, &look);
    assert_true(force > 5e-5 && force < 1e-4);
    assert_near(scale, 1e-4, 1e-15);
    bed.scene.gravity[2] = 0;
    assert_near(oz_pressed_scale(&bed.snapshot, &look), 1, 0);
    bed_free(&bed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_are_sums_over_contacts),
        cmocka_unit_test(a_pair_is_one_chain),
        cmocka_unit_test(a_chain_is_a_tube_between_thin_grains),
        cmocka_unit_test(the_scale_is_that_of_the_weight),
    };
    return cmocka_run_group_tests(tests, begin_drawing, end_drawing);
}
