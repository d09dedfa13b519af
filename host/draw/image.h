/* A picture in memory. */
#pragma once

#include "base/status.h"

#include <stdint.h>

typedef struct OzImage {
    int width, height; /* pixels                                                        */
    uint8_t *pixels;   /* width x height x 4, RGBA, top row first, sRGB, alpha 255      */
} OzImage;

OzStatus oz_image_create(OzImage *image, int width, int height);
void oz_image_free(OzImage *image);

/* Writes a PNG under a temporary name beside path and renames it. */
OzStatus oz_image_write_png(const OzImage *image, const char *path);

/* The same in memory, faster and larger; the caller frees. */
OzStatus oz_image_png(const OzImage *image, char **bytes, size_t *length);
