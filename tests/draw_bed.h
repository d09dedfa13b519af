/* Rods and spheres of a hand-written bed, drawn large and bare. */
#ifndef TESTS_DRAW_BED_H
#define TESTS_DRAW_BED_H

#include "draw_rig.h"
#include "hand_bed.h"

#include "draw/palette.h"

/* 4 mm framed in 600 pixels, seen level, grains alone. */
static inline OzLook plain_look(OzView view)
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

static inline void place(Bed *bed, int64_t i, double x, double y, double z, const double axis[3])
{
    put(bed, i, z, axis[0], axis[1], axis[2]);
    bed->snapshot.position[3 * i] = x;
    bed->snapshot.position[3 * i + 1] = y;
}

static inline OzImage draw(const Bed *bed, const OzLook *look)
{
    return draw_states(&bed->snapshot, 1, look);
}

static inline const uint8_t *pixel(const OzImage *image, int x, int y)
{
    return image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static inline bool same_colour(const uint8_t *a, const uint8_t *b, int tolerance)
{
    return abs(a[0] - b[0]) <= tolerance && abs(a[1] - b[1]) <= tolerance &&
           abs(a[2] - b[2]) <= tolerance;
}

static inline int drawn_by_one(OzLook look, double y, double diameter, double length,
                               const double axis[3])
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

#endif
