/* Drawing in a test, whatever the model: the renderer, pixels counted against areas, and one
 * picture from both GL back-ends. */
#ifndef TESTS_DRAW_RIG_H
#define TESTS_DRAW_RIG_H

#include "hand_folder.h"

#include "base/file.h"
#include "draw/camera.h"
#include "draw/renderer.h"

#include <sys/wait.h>

/* A child that gets no GL context leaves with this. */
enum { NO_CONTEXT = 77 };

static OzRenderer *renderer;

static inline int begin_drawing(void **state)
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

static inline int end_drawing(void **state)
{
    (void)state;
    oz_renderer_free(renderer);
    return remove_folder((const char *const[]){NULL});
}

static inline OzImage draw_states(const OzSnapshot *snapshots, int count, const OzLook *look)
{
    OzImage image;
    assert_int_equal(oz_image_create(&image, look->width, look->height), OZ_OK);
    if (oz_renderer_draw_states(renderer, snapshots, count, look, &image) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return image;
}

static inline double pixels_per_metre(const OzLook *look)
{
    OzCamera camera = oz_camera_make(look, 0);
    return camera.scale / camera.unit;
}

/* Pixels that are not white. */
static inline int count_drawn(const OzImage *image)
{
    int count = 0;
    for (int i = 0; i < image->width * image->height; i++) {
        const uint8_t *pixel = image->pixels + 4 * (size_t)i;
        count += pixel[0] < 255 || pixel[1] < 255 || pixel[2] < 255;
    }
    return count;
}

/* A pixel counts when a part of it is covered, as smoothing along rows or columns sees it: where
 * the outline passes within half a pixel of its middle. So the count may exceed the area by that
 * band about the outline, and nothing less. */
static inline void assert_area(int count, double area, double outline)
{
    if (count < area - 0.05 * outline || count > area + 0.5 * outline) {
        fail_msg("%d pixels are not the area %.1f with its outline of %.1f", count, area, outline);
    }
}

/* What such a child does: draws the picture with one back-end and writes its raw pixels. */
static inline int draw_in_child(const char *backend, const char *path, OzImage (*picture)(void))
{
    OzGlBackend kind = strcmp(backend, "egl") == 0 ? OZ_GL_EGL : OZ_GL_OSMESA;
    if (oz_renderer_create(&renderer, kind, NULL) != OZ_OK) {
        return NO_CONTEXT;
    }
    OzImage image = picture();
    FILE *file = fopen(path, "wb");
    size_t size = (size_t)image.width * (size_t)image.height * 4;
    bool good = file && fwrite(image.pixels, 1, size, file) == size;
    good = file && fclose(file) == 0 && good;
    oz_image_free(&image);
    oz_renderer_free(renderer);
    return good ? 0 : 1;
}

/* The pixels from this program started anew as a child: one process has one back-end. */
static inline char *pixels_from(const char *backend, size_t *size)
{
    char path[300], self[300], *pixels = NULL;
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
    assert_int_equal(oz_file_read(&pixels, size, path), OZ_OK);
    remove(path);
    return pixels;
}

/* Compilers may order sums differently, which moves a colour by a level and, on an outline, a
 * sample; anything more is another picture. */
static inline void back_ends_draw_the_same(void **state)
{
    (void)state;
    size_t size = 0, other = 0, far = 0;
    char *a = pixels_from("egl", &size), *b = pixels_from("osmesa", &other);
    if (!a || !b) {
        free(a);
        free(b);
        skip();
    }
    assert_int_equal(size, other);
    for (size_t i = 0; i < size; i++) {
        far += abs((uint8_t)a[i] - (uint8_t)b[i]) > 3;
    }
    assert_true(size > 0 && far < size / 1000);
    free(a);
    free(b);
}

#endif
