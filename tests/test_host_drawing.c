/* Pictures that the host draws, against those that OpenGL draws of the same bed; and the same
 * picture from any number of threads, and from a renderer that has drawn another one before. */
#include "draw_bed.h"

#include <pthread.h>
#include <sched.h>

enum { GRAINS = 400, THREADS = 3 };

/* Whether a grain's surroundings are free of those before it: two sections in one place would be
 * painted by whichever comes first. */
static bool is_free(const Bed *bed, int64_t i)
{
    const double *own = &bed->snapshot.position[3 * i];
    for (int64_t j = 0; j < i; j++) {
        const double *at = &bed->snapshot.position[3 * j];
        double square = 0, reach = 0.5 * (bed->grains.diameter[i] + bed->grains.length[i] +
                                          bed->grains.diameter[j] + bed->grains.length[j]);
        for (int k = 0; k < 3; k++) {
            square += (own[k] - at[k]) * (own[k] - at[k]);
        }
        if (square < reach * reach) {
            return false;
        }
    }
    return true;
}

/* Rods and spheres of all sizes in their cylinder, above its floor, the largest first. */
static void fill_bed(Bed *bed)
{
    OzRandom random = oz_random_stream(3, 0);
    bed_create(bed, GRAINS, 0.8e-3, 2e-3);
    for (int64_t i = 0; i < GRAINS; i++) {
        double axis[3], size = 1.0 / (1 + 0.01 * (double)i);
        oz_random_direction(&random, axis);
        bed->grains.diameter[i] = oz_random_uniform(&random, 0.3e-3, 1e-3) * size;
        bed->grains.length[i] = i % 3 ? oz_random_uniform(&random, 0, 2e-3) * size : 0;
        bed->grains.population[i] = (int32_t)(i % 5);
        do {
            double angle = oz_random_uniform(&random, 0, 6.28);
            double away = oz_random_uniform(&random, 0, 3e-3);
            place(bed, i, away * cos(angle), away * sin(angle),
                  oz_random_uniform(&random, 2e-3, 9e-3), axis);
        } while (!is_free(bed, i));
    }
}

static OzLook bed_look(int width, int height, bool cut_outlines)
{
    return (OzLook){.width = width,
                    .height = height,
                    .views = {OZ_VIEW_LATERAL, OZ_VIEW_CUT},
                    .view_count = 2,
                    .colour = OZ_COLOUR_TYPE,
                    .height_low = 0,
                    .height_high = 1e-2,
                    .half_width = 4e-3,
                    .elevation = 0.19,
                    .speed_high = 1,
                    .cut_outlines = cut_outlines};
}

static OzImage draw_with(OzRenderer *by, const Bed *bed, const OzLook *look)
{
    OzImage image;
    assert_int_equal(oz_image_create(&image, look->width, look->height), OZ_OK);
    assert_int_equal(oz_renderer_draw(by, &bed->snapshot, look, &image), OZ_OK);
    return image;
}

/* What is left is how roundings fall and, along outlines, that a GPU takes slopes from pixels side
 * by side where the host knows them: there the two differ by a part of the step between two
 * colours. A grain left out, a colour or a shadow gone wrong is a multiple of this. */
static void assert_alike(const OzImage *a, const OzImage *b)
{
    size_t count = 4 * (size_t)a->width * (size_t)a->height, far = 0;
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        int away = abs(a->pixels[i] - b->pixels[i]);
        sum += away;
        far += away > 10;
    }
    if (sum > 0.25 * (double)count || far > count / 100) {
        fail_msg("mean difference %.3f, %zu of %zu values more than 10 apart", sum / (double)count,
                 far, count);
    }
}

static void host_and_gl_draw_alike(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 720}, {333, 517}};
    OzRenderer *gl = NULL;
    Bed bed;
    if (oz_renderer_create(&gl, OZ_GL_EGL, NULL) != OZ_OK) {
        skip();
    }
    fill_bed(&bed);
    for (int i = 0; i < 4; i++) {
        OzLook look = bed_look(sizes[i / 2][0], sizes[i / 2][1], i % 2);
        look.bare = i == 3;
        OzImage one = draw_with(gl, &bed, &look), other = draw_with(renderer, &bed, &look);
        assert_alike(&one, &other);
        oz_image_free(&one);
        oz_image_free(&other);
    }
    oz_renderer_free(gl);
    bed_free(&bed);
}

typedef struct Work {
    pthread_t thread;
    const Bed *bed;
    OzImage image;
    bool is_done;
} Work;

static void *draw_in_thread(void *argument)
{
    Work *work = argument;
    OzLook look = bed_look(640, 360, true);
    OzRenderer *own = NULL;
    work->is_done = oz_renderer_create(&own, OZ_GL_HOST, NULL) == OZ_OK &&
                    oz_image_create(&work->image, 640, 360) == OZ_OK &&
                    oz_renderer_draw(own, &work->bed->snapshot, &look, &work->image) == OZ_OK;
    oz_renderer_free(own);
    return NULL;
}

static void assert_same(const OzImage *a, const OzImage *b)
{
    size_t size = 4 * (size_t)a->width * (size_t)a->height;
    assert_memory_equal(a->pixels, b->pixels, size);
}

static void threads_draw_the_same(void **state)
{
    (void)state;
    Bed bed;
    Work works[THREADS] = {0};
    fill_bed(&bed);
    for (int i = 0; i < THREADS; i++) {
        works[i].bed = &bed;
        assert_int_equal(pthread_create(&works[i].thread, NULL, draw_in_thread, &works[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(works[i].thread, NULL), 0);
        assert_true(works[i].is_done);
        assert_same(&works[i].image, &works[0].image);
    }
    for (int i = 0; i < THREADS; i++) {
        oz_image_free(&works[i].image);
    }
    bed_free(&bed);
}

/* Where there is one processor, views are drawn one after the other. */
static void one_processor_draws_the_same(void **state)
{
    (void)state;
    Bed bed;
    OzLook look = bed_look(640, 360, true);
    OzRenderer *own = NULL;
    cpu_set_t all, one;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&one);
    for (size_t i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; i++) {
        if (CPU_ISSET(i, &all)) {
            CPU_SET(i, &one);
        }
    }
    fill_bed(&bed);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    assert_int_equal(oz_renderer_create(&own, OZ_GL_HOST, NULL), OZ_OK);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
    OzImage here = draw_with(own, &bed, &look), there = draw_with(renderer, &bed, &look);
    assert_same(&here, &there);
    oz_renderer_free(own);
    oz_image_free(&here);
    oz_image_free(&there);
    bed_free(&bed);
}

/* Glass is kept from picture to picture, and painted anew in another one. */
static void nothing_is_left_of_earlier_pictures(void **state)
{
    (void)state;
    Bed bed;
    OzLook looks[2] = {bed_look(640, 360, false), bed_look(500, 400, true)};
    OzImage fresh[2];
    fill_bed(&bed);
    for (int i = 0; i < 2; i++) {
        OzRenderer *own = NULL;
        assert_int_equal(oz_renderer_create(&own, OZ_GL_HOST, NULL), OZ_OK);
        fresh[i] = draw_with(own, &bed, &looks[i]);
        oz_renderer_free(own);
    }
    for (int i = 0; i < 5; i++) {
        OzImage again = draw_with(renderer, &bed, &looks[i / 2 % 2]);
        assert_same(&again, &fresh[i / 2 % 2]);
        oz_image_free(&again);
    }
    oz_image_free(&fresh[0]);
    oz_image_free(&fresh[1]);
    bed_free(&bed);
}

static int begin_host(void **state)
{
    return make_folder(state) == 0 && oz_renderer_create(&renderer, OZ_GL_HOST, NULL) == OZ_OK ? 0
                                                                                               : -1;
}

static int end(void **state)
{
    (void)state;
    oz_renderer_free(renderer);
    return remove_folder((const char *const[]){NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_draw_the_same),
        cmocka_unit_test(one_processor_draws_the_same),
        cmocka_unit_test(nothing_is_left_of_earlier_pictures),
        cmocka_unit_test(host_and_gl_draw_alike),
    };
    return cmocka_run_group_tests(tests, begin_host, end);
}
