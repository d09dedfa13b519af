/* Pictures of snapshots written by hand: silhouettes and cut faces against exact areas, depth
 * order, colours, the two GL back-ends against each other, sizes, files. Never runs a simulation.
 */
#include "hand_bed.h"

#include "draw/camera.h"
#include "draw/palette.h"
#include "draw/renderer.h"

#include <png.h>
#include <sys/stat.h>
#include <sys/wait.h>

static const double PI = 3.14159265358979323846;

/* A child that gets no GL context leaves with this. */
enum { NO_CONTEXT = 77 };

static OzRenderer *renderer;

/* 4 mm framed in 600 pixels, seen level, grains alone. */
static OzLook plain_look(OzView view)
{
    return (OzLook){.width = 600,
                    .height = 600,
                    .views = {view},
                    .view_count = 1,
                    .colour = OZ_COLOUR_TYPE,
                    .height_low = 0,
                    .height_high = 4e-3,
                    .half_width = 2e-3,
                    .speed_high = 1,
                    .bare = true};
}

static void place(Bed *bed, int64_t i, double x, double y, double z, const double axis[3])
{
    put(bed, i, z, axis[0], axis[1], axis[2]);
    bed->snapshot.position[3 * i] = x;
    bed->snapshot.position[3 * i + 1] = y;
}

static OzImage draw(const Bed *bed, const OzLook *look)
{
    OzImage image;
    assert_int_equal(oz_image_create(&image, look->width, look->height), OZ_OK);
    if (oz_renderer_draw(renderer, &bed->snapshot, look, &image) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return image;
}

static const uint8_t *pixel(const OzImage *image, int x, int y)
{
    return image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static bool same_colour(const uint8_t *a, const uint8_t *b, int tolerance)
{
    return abs(a[0] - b[0]) <= tolerance && abs(a[1] - b[1]) <= tolerance &&
           abs(a[2] - b[2]) <= tolerance;
}

static int count_drawn(const OzImage *image)
{
    const uint8_t white[3] = {255, 255, 255};
    int count = 0;
    for (int i = 0; i < image->width * image->height; i++) {
        count += !same_colour(image->pixels + 4 * (size_t)i, white, 0);
    }
    return count;
}

static double pixels_per_metre(const OzLook *look)
{
    OzCamera camera = oz_camera_make(look);
    return camera.scale / camera.unit;
}

/* A pixel counts when one of its samples is covered. Samples lie within 0.4 pixels of its middle
 * along each axis, so the count may exceed the area by that band about the outline, and nothing
 * less. */
static void assert_area(int count, double area, double outline)
{
    if (count < area - 0.05 * outline || count > area + 0.45 * outline) {
        fail_msg("%d pixels are not the area %.1f with its outline of %.1f", count, area, outline);
    }
}

static int drawn_by_one(OzLook look, double y, double diameter, double length, const double axis[3])
{
    Bed bed;
    bed_create(&bed, 1, diameter, length);
    place(&bed, 0, 0, y, 2e-3, axis);
    OzImage image = draw(&bed, &look);
    int count = count_drawn(&image);
    oz_image_free(&image);
    bed_free(&bed);
    return count;
}

static const double along_x[3] = {1, 0, 0}, along_y[3] = {0, 1, 0}, along_z[3] = {0, 0, 1};

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
    OzCamera camera = oz_camera_make(look);
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

/* Child: draws with one back-end, writes the raw pixels. */
static int draw_in_child(const char *backend, const char *path)
{
    OzGlBackend kind = strcmp(backend, "egl") == 0 ? OZ_GL_EGL : OZ_GL_OSMESA;
    if (oz_renderer_create(&renderer, kind, NULL) != OZ_OK) {
        return NO_CONTEXT;
    }
    OzImage image = full_picture(640, 360, 300, 0);
    FILE *file = fopen(path, "wb");
    size_t size = (size_t)image.width * (size_t)image.height * 4;
    bool written = file && fwrite(image.pixels, 1, size, file) == size;
    if (file) {
        fclose(file);
    }
    oz_image_free(&image);
    oz_renderer_free(renderer);
    return written ? 0 : 1;
}

static uint8_t *pixels_from(const char *backend, size_t size)
{
    char path[300], self[300];
    snprintf(path, sizeof path, "%s", in_folder(backend));
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    assert_true(length > 0);
    self[length] = '\0';
    pid_t child = fork();
    if (child == 0) {
        execl(self, self, backend, path, (char *)NULL);
        _exit(1);
    }
    int outcome = -1;
    assert_int_equal(waitpid(child, &outcome, 0), child);
    if (WIFEXITED(outcome) && WEXITSTATUS(outcome) == NO_CONTEXT) {
        return NULL;
    }
    assert_int_equal(outcome, 0);
    uint8_t *pixels = malloc(size);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fread(pixels, 1, size, file), size);
    fclose(file);
    return pixels;
}

/* Compilers may order sums differently, which moves a colour by a level and, on an outline, a
 * sample; anything more is another picture. */
static void back_ends_draw_the_same(void **state)
{
    (void)state;
    size_t size = (size_t)640 * 360 * 4, far = 0;
    uint8_t *a = pixels_from("egl", size), *b = pixels_from("osmesa", size);
    if (!a || !b) {
        free(a);
        free(b);
        skip();
    }
    for (size_t i = 0; i < size; i++) {
        far += abs(a[i] - b[i]) > 3;
    }
    assert_true(far < size / 1000);
    free(a);
    free(b);
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

static int begin(void **state)
{
    if (make_folder(state) != 0) {
        return -1;
    }
    if (oz_renderer_create(&renderer, OZ_GL_AUTO, NULL) != OZ_OK) {
        fprintf(stderr, "%s\n", oz_status_text());
        return -1;
    }
    return 0;
}

static int end(void **state)
{
    (void)state;
    oz_renderer_free(renderer);
    return remove_folder(
        (const char *const[]){"picture.png", "egl", "osmesa", "describe.txt", NULL});
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(back_ends_draw_the_same),
        cmocka_unit_test(describe_names_both_back_ends),
        cmocka_unit_test(sphere_covers_its_disc),
        cmocka_unit_test(rod_covers_its_stadium),
        cmocka_unit_test(rod_end_on_covers_a_disc),
        cmocka_unit_test(slanted_rod_covers_its_shadow),
        cmocka_unit_test(grain_before_the_cut_shows_its_section_alone),
        cmocka_unit_test(upright_cut_through_a_rod_is_a_disc),
        cmocka_unit_test(section_is_flat_in_the_colour_of_its_grain),
        cmocka_unit_test(nearer_rod_hides_the_other),
        cmocka_unit_test(depth_is_exact_within_a_pixel),
        cmocka_unit_test(colours_tell_direction_and_speed),
        cmocka_unit_test(every_shape_of_picture_is_drawn),
        cmocka_unit_test(container_is_drawn_without_grains_and_its_floor_moves),
        cmocka_unit_test(look_frames_the_bed_and_its_walls),
        cmocka_unit_test(impossible_sizes_are_refused),
        cmocka_unit_test(png_gives_the_pixels_back),
    };
    if (argc == 3) {
        return draw_in_child(argv[1], argv[2]);
    }
    return cmocka_run_group_tests(tests, begin, end);
}
