/* Pictures in memory and as PNG files. Knows nothing of what is drawn. */
#include "draw/image.h"

#include "base/memory.h"

#include <png.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LARGEST_SIDE = 1 << 15 };

OzStatus oz_image_create(OzImage *image, int width, int height)
{
    memset(image, 0, sizeof *image);
    if (width < 1 || height < 1 || width > LARGEST_SIDE || height > LARGEST_SIDE) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "a picture of %d x %d pixels cannot be made; 1 to %d a side can",
                              width, height, LARGEST_SIDE);
    }
    OzStatus status =
        oz_memory_new((void **)&image->pixels, (size_t)width * (size_t)height, 4, "picture");
    if (status == OZ_OK) {
        image->width = width;
        image->height = height;
    }
    return status;
}

void oz_image_free(OzImage *image)
{
    free(image->pixels);
    memset(image, 0, sizeof *image);
}

/* The pixels without their alpha, which says nothing. */
static OzStatus without_alpha(uint8_t **rgb, const OzImage *image)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    OzStatus status = oz_memory_new((void **)rgb, count, 3, "picture to write");
    for (size_t i = 0; status == OZ_OK && i < count; i++) {
        memcpy(*rgb + 3 * i, image->pixels + 4 * i, 3);
    }
    return status;
}

/* libpng's simplified interface tags 8-bit pictures as sRGB by itself. */
static OzStatus write_file(const OzImage *image, const uint8_t *rgb, const char *path)
{
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)image->width,
                     .height = (png_uint_32)image->height,
                     .format = PNG_FORMAT_RGB};
    OzStatus status = OZ_OK;
    FILE *file = fopen(path, "wb");
    if (!file) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    if (!png_image_write_to_stdio(&png, file, 0, rgb, 0, NULL)) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: libpng: %s", path, png.message);
    }
    if (fclose(file) != 0 && status == OZ_OK) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    return status;
}

OzStatus oz_image_write_png(const OzImage *image, const char *path)
{
    OzStatus status = OZ_OK;
    uint8_t *rgb = NULL;
    char *part = NULL;
    OZ_TRY(oz_memory_new((void **)&part, strlen(path) + sizeof ".part", 1, "file name"));
    sprintf(part, "%s.part", path);
    OZ_TRY(without_alpha(&rgb, image));
    OZ_TRY(write_file(image, rgb, part));
    if (rename(part, path) != 0) {
        status =
            oz_status_fail(OZ_ERR_FILE, "cannot rename %s to %s: %s", part, path, strerror(errno));
    }
done:
    if (status != OZ_OK && part) {
        remove(part);
    }
    free(part);
    free(rgb);
    return status;
}

OzStatus oz_image_png(const OzImage *image, char **bytes, size_t *length)
{
    OzStatus status = OZ_OK;
    uint8_t *rgb = NULL;
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)image->width,
                     .height = (png_uint_32)image->height,
                     .format = PNG_FORMAT_RGB,
                     .flags = PNG_IMAGE_FLAG_FAST};
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    *bytes = NULL;
    OZ_TRY(without_alpha(&rgb, image));
    OZ_TRY(OZ_NEW(bytes, size));
    if (!png_image_write_to_memory(&png, *bytes, &size, 0, rgb, 0, NULL)) {
        status = oz_status_fail(OZ_ERR_FILE, "a picture in memory: libpng: %s", png.message);
        free(*bytes);
        *bytes = NULL;
    }
    *length = size;
done:
    free(rgb);
    return status;
}
