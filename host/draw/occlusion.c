/* Depths of pixels, at their middles. What a body covers is taken a little
 * smaller than it is, where it may show a little larger, and its depth is that
 * of its axis against the nearest point of others, so that errors leave too
 * much in the picture. Knows no GL. */
#include "draw/occlusion.h"

#include "base/memory.h"
#include "draw/stadium.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float FAR = 1e9f; /* view units */

enum { PIECES_MOST = 4 }; /* of an axis: boxes about these are hardly larger than the rod */

/* A piece of a body, pixels of the box. */
typedef struct Piece {
    double ends[2][2], radius[2]; /* in the plane of each end */
    double far, near;             /* z of the end that lies further back, of the nearest point */
} Piece;

static double least(double a, double b)
{
    return a < b ? a : b;
}

static double most(double a, double b)
{
    return a > b ? a : b;
}

OzStatus oz_occlusion_begin(OzOcclusion *occlusion, const OzCamera *camera, int panel,
                            const OzBox *box)
{
    *occlusion = (OzOcclusion){.camera = camera, .columns = box->width, .rows = box->height};
    occlusion->middle[0] = (double)lround(camera->panels[panel].middle_x) - box->x;
    occlusion->middle[1] = (double)lround(camera->panels[panel].middle_y) - box->y;
    size_t count = (size_t)occlusion->columns * (size_t)occlusion->rows;
    OZ_PASS(OZ_NEW(&occlusion->nearest, count));
    for (size_t i = 0; i < count; i++) {
        occlusion->nearest[i] = -FAR;
    }
    return OZ_OK;
}

void oz_occlusion_free(OzOcclusion *occlusion)
{
    free(occlusion->nearest);
    memset(occlusion, 0, sizeof *occlusion);
}

static Piece piece_of(const OzOcclusion *occlusion, const OzBody *body, double from, double to)
{
    const OzCamera *camera = occlusion->camera;
    Piece piece = {.far = 1e9, .near = -1e9};
    for (int e = 0; e < 2; e++) {
        double at = e ? to : from, point[3];
        for (int k = 0; k < 3; k++) {
            point[k] = (double)body->centre[k] + at * (double)body->axis[k];
        }
        double nearer = camera->distance / most(camera->distance - point[2], 1e-6);
        double scale = camera->scale * nearer;
        piece.ends[e][0] = occlusion->middle[0] + scale * point[0];
        piece.ends[e][1] = occlusion->middle[1] - scale * point[1];
        piece.radius[e] = scale * (double)body->radius;
        piece.far = least(piece.far, point[2]);
        piece.near = most(piece.near, point[2] + (double)body->radius);
    }
    return piece;
}

/* A sphere looks a little larger than its disc, off the picture's middle most.
 */
static bool shows(const OzOcclusion *occlusion, const Piece *piece)
{
    double radius = 1.02 * most(piece->radius[0], piece->radius[1]) + 0.05;
    OzStadium stadium = oz_stadium_make(piece->ends[0], piece->ends[1], radius);
    OzStadiumSpan rows = oz_stadium_rows(&stadium, occlusion->rows);
    float near = (float)piece->near;
    for (int y = rows.first; y < rows.end; y++) {
        const float *row = occlusion->nearest + (size_t)y * (size_t)occlusion->columns;
        OzStadiumSpan span = oz_stadium_row(&stadium, y, occlusion->columns);
        int open = 0;
        for (int x = span.first; x < span.end; x++) {
            open |= row[x] < near;
        }
        if (open) {
            return true;
        }
    }
    return false;
}

static void cover(OzOcclusion *occlusion, const Piece *piece)
{
    double radius = 0.99 * least(piece->radius[0], piece->radius[1]) - 0.02;
    OzStadium stadium = oz_stadium_make(piece->ends[0], piece->ends[1], radius);
    OzStadiumSpan rows = oz_stadium_rows(&stadium, occlusion->rows);
    float far = (float)piece->far;
    for (int y = rows.first; y < rows.end && radius > 0; y++) {
        float *row = occlusion->nearest + (size_t)y * (size_t)occlusion->columns;
        OzStadiumSpan span = oz_stadium_row(&stadium, y, occlusion->columns);
        for (int x = span.first; x < span.end; x++) {
            row[x] = row[x] > far ? row[x] : far;
        }
    }
}

/* Each piece has one depth: as many as a slanting axis is deep in diameters. */
static int pieces_of(const OzBody *body, double length)
{
    double deep = fabs((double)body->axis[2]) * length / (2 * (double)body->radius);
    int pieces = (int)least(ceil(deep), PIECES_MOST);
    return pieces < 1 ? 1 : pieces;
}

/* A box about a body, which is found to be hidden sooner; deep in a bed most are. */
static bool box_shows(const OzOcclusion *occlusion, const Piece *piece)
{
    double radius = 1.02 * most(piece->radius[0], piece->radius[1]) + 0.05;
    const double *a = piece->ends[0], *b = piece->ends[1];
    int left = oz_stadium_first(least(a[0], b[0]) - radius),
        top = oz_stadium_first(least(a[1], b[1]) - radius);
    int right = oz_stadium_end(most(a[0], b[0]) + radius, occlusion->columns);
    int bottom = oz_stadium_end(most(a[1], b[1]) + radius, occlusion->rows);
    float near = (float)piece->near;
    for (int y = top; y < bottom; y++) {
        const float *row = occlusion->nearest + (size_t)y * (size_t)occlusion->columns;
        int open = 0;
        for (int x = left; x < right; x++) {
            open |= row[x] < near;
        }
        if (open) {
            return true;
        }
    }
    return false;
}

bool oz_occlusion_hides(const OzOcclusion *occlusion, const OzBody *body)
{
    double half = (double)body->half_shaft;
    Piece whole = piece_of(occlusion, body, -half, half);
    if (!box_shows(occlusion, &whole)) {
        return true;
    }
    int pieces = pieces_of(body, 2 * half);
    for (int i = 0; i < pieces; i++) {
        Piece piece = piece_of(occlusion, body, half * (2.0 * i / pieces - 1),
                               half * (2.0 * (i + 1) / pieces - 1));
        if (shows(occlusion, &piece)) {
            return false;
        }
    }
    return true;
}

void oz_occlusion_add(OzOcclusion *occlusion, const OzBody *body, double from, double to)
{
    if (from > to) {
        return;
    }
    int pieces = pieces_of(body, to - from);
    for (int i = 0; i < pieces; i++) {
        Piece piece = piece_of(occlusion, body, from + (to - from) * i / pieces,
                               from + (to - from) * (i + 1) / pieces);
        cover(occlusion, &piece);
    }
}
