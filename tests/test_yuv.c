/* Colours of movies against the formulas of bt709, in double. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/random.h"
#include "draw/yuv.h"

enum { WIDTH = 66, HEIGHT = 10 };

/* Of colours from 0 to 255. */
static void expect(const double rgb[3], double yuv[3])
{
    double luma = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    yuv[0] = 16 + 219 * luma / 255;
    yuv[1] = 128 + 224 * (rgb[2] - luma) / 1.8556 / 255;
    yuv[2] = 128 + 224 * (rgb[0] - luma) / 1.5748 / 255;
}

static int channel(const OzImage *image, int x, int y, int k)
{
    return image->pixels[4 * ((x < 0 ? 0 : x) + y * WIDTH) + k];
}

/* Half a level is rounding; weights of 15 bits are off by 3 of 255 x 2^-16 at most. */
static void assert_level(uint8_t got, double expected)
{
    if (fabs(got - expected) > 0.5 + 0.02) {
        fail_msg("%d instead of %.3f", got, expected);
    }
}

static void check(const OzImage *image)
{
    static uint8_t luma[WIDTH * HEIGHT], blue[WIDTH * HEIGHT / 4], red[WIDTH * HEIGHT / 4];
    int32_t room[OZ_YUV_ROOM(WIDTH)];
    double rgb[3], yuv[3];
    oz_yuv_convert(image, room, (uint8_t *[]){luma, blue, red},
                   (int[]){WIDTH, WIDTH / 2, WIDTH / 2});
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int k = 0; k < 3; k++) {
            rgb[k] = image->pixels[4 * i + k];
        }
        expect(rgb, yuv);
        assert_level(luma[i], yuv[0]);
    }
    for (int i = 0; i < WIDTH * HEIGHT / 4; i++) {
        int x = 2 * (i % (WIDTH / 2)), y = 2 * (i / (WIDTH / 2));
        for (int k = 0; k < 3; k++) {
            rgb[k] = 0;
            for (int row = y; row < y + 2; row++) {
                rgb[k] += channel(image, x - 1, row, k) / 8.0 + channel(image, x, row, k) / 4.0 +
                          channel(image, x + 1, row, k) / 8.0;
            }
        }
        expect(rgb, yuv);
        assert_level(blue[i], yuv[1]);
        assert_level(red[i], yuv[2]);
    }
}

static void colours_are_those_of_bt709(void **state)
{
    (void)state;
    OzImage image;
    OzRandom random = oz_random_stream(7, 0);
    assert_int_equal(oz_image_create(&image, WIDTH, HEIGHT), OZ_OK);
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
        image.pixels[i] = (uint8_t)oz_random_uniform(&random, 0, 255.999);
    }
    check(&image);
    for (int corner = 0; corner < 8; corner++) { /* black, white and pure colours */
        for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
            image.pixels[i] = corner >> i % 4 & 1 ? 255 : 0;
        }
        check(&image);
    }
    oz_image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(colours_are_those_of_bt709)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
