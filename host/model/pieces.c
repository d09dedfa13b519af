/* Arrays of pieces, and a piece's geometry. */
#include "model/pieces.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

OzStatus oz_pieces_create(OzPieces **out, const OzPieceCounts *counts)
{
    OzStatus status = OZ_OK;
    OzPieces *pieces = NULL;
    int64_t count = counts->free_pieces + counts->wall_pieces;
    *out = NULL;
    OZ_TRY(OZ_NEW(&pieces, 1));
    pieces->grain_count = counts->grains;
    pieces->wall_count = counts->walls;
    pieces->free_count = counts->free_pieces;
    pieces->count = count;
    pieces->beam_count = counts->beams;
    pieces->outline_count = counts->outlines;
    OZ_TRY(OZ_NEW(&pieces->first, counts->grains + counts->walls + 1));
    OZ_TRY(OZ_NEW(&pieces->body, count));
    OZ_TRY(OZ_NEW(&pieces->radius, count));
    OZ_TRY(OZ_NEW(&pieces->corner, 6 * count));
    OZ_TRY(OZ_NEW(&pieces->reach, count));
    OZ_TRY(OZ_NEW(&pieces->area, count));
    OZ_TRY(OZ_NEW(&pieces->mass, count));
    OZ_TRY(OZ_NEW(&pieces->inertia, count));
    OZ_TRY(OZ_NEW(&pieces->position, 2 * count));
    OZ_TRY(OZ_NEW(&pieces->angle, count));
    OZ_TRY(OZ_NEW(&pieces->velocity, 2 * count));
    OZ_TRY(OZ_NEW(&pieces->spin, count));
    OZ_TRY(OZ_NEW(&pieces->beam_a, counts->beams));
    OZ_TRY(OZ_NEW(&pieces->beam_b, counts->beams));
    OZ_TRY(OZ_NEW(&pieces->beam_length, counts->beams));
    OZ_TRY(OZ_NEW(&pieces->beam_rest_a, counts->beams));
    OZ_TRY(OZ_NEW(&pieces->beam_rest_b, counts->beams));
    OZ_TRY(OZ_NEW(&pieces->outline_piece, counts->outlines));
    OZ_TRY(OZ_NEW(&pieces->outline_edge, counts->outlines));
    *out = pieces;
    pieces = NULL;
done:
    oz_pieces_free(pieces);
    return status;
}

void oz_pieces_free(OzPieces *pieces)
{
    if (!pieces) {
        return;
    }
    free(pieces->first);
    free(pieces->body);
    free(pieces->radius);
    free(pieces->corner);
    free(pieces->reach);
    free(pieces->area);
    free(pieces->mass);
    free(pieces->inertia);
    free(pieces->position);
    free(pieces->angle);
    free(pieces->velocity);
    free(pieces->spin);
    free(pieces->beam_a);
    free(pieces->beam_b);
    free(pieces->beam_length);
    free(pieces->beam_rest_a);
    free(pieces->beam_rest_b);
    free(pieces->outline_piece);
    free(pieces->outline_edge);
    free(pieces);
}

/* Twice the signed area, > 0 counter-clockwise. */
static double twice_area(const double c[6])
{
    return (c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]);
}

/* About its centre of mass a triangle of mass m has m (a^2 + b^2 + c^2) / 36 with its edges'
 * lengths, which is m / 12 times the sum of its corners' squared distances. */
static double triangle_inertia(const double corner[6], double mass)
{
    double sum = 0;
    for (int i = 0; i < 6; i++) {
        sum += corner[i] * corner[i];
    }
    return mass * sum / 12;
}

OzStatus oz_pieces_set_triangle(OzPieces *pieces, int64_t i, const double corners[6],
                                double density)
{
    double turned[6], *corner = pieces->corner + 6 * i, *position = pieces->position + 2 * i;
    memcpy(turned, corners, sizeof turned);
    if (twice_area(corners) < 0) {
        memcpy(turned + 2, corners + 4, 2 * sizeof(double));
        memcpy(turned + 4, corners + 2, 2 * sizeof(double));
    }
    pieces->area[i] = 0.5 * twice_area(turned);
    if (!(pieces->area[i] > 0)) {
        return oz_status_fail(
            OZ_ERR_INPUT, "a triangle with corners (%g, %g), (%g, %g), (%g, %g) m has no area",
            corners[0], corners[1], corners[2], corners[3], corners[4], corners[5]);
    }
    position[0] = (turned[0] + turned[2] + turned[4]) / 3;
    position[1] = (turned[1] + turned[3] + turned[5]) / 3;
    pieces->reach[i] = 0;
    for (int c = 0; c < 3; c++) {
        corner[2 * c] = turned[2 * c] - position[0];
        corner[2 * c + 1] = turned[2 * c + 1] - position[1];
        pieces->reach[i] = fmax(pieces->reach[i], hypot(corner[2 * c], corner[2 * c + 1]));
    }
    pieces->angle[i] = 0;
    pieces->radius[i] = 0;
    pieces->mass[i] = density * pieces->area[i];
    pieces->inertia[i] = triangle_inertia(corner, pieces->mass[i]);
    return OZ_OK;
}

void oz_pieces_set_disc(OzPieces *pieces, int64_t i, const double centre[2], double radius,
                        double density)
{
    memset(pieces->corner + 6 * i, 0, 6 * sizeof(double));
    memcpy(pieces->position + 2 * i, centre, 2 * sizeof(double));
    pieces->angle[i] = 0;
    pieces->radius[i] = pieces->reach[i] = radius;
    pieces->area[i] = PI * radius * radius;
    pieces->mass[i] = density * pieces->area[i];
    pieces->inertia[i] = 0.5 * pieces->mass[i] * radius * radius;
}

void oz_pieces_rest_beam(OzPieces *pieces, int64_t k)
{
    int a = pieces->beam_a[k], b = pieces->beam_b[k];
    double x = pieces->position[2 * b] - pieces->position[2 * a];
    double y = pieces->position[2 * b + 1] - pieces->position[2 * a + 1];
    double direction = atan2(y, x);
    pieces->beam_length[k] = hypot(x, y);
    pieces->beam_rest_a[k] = pieces->angle[a] - direction;
    pieces->beam_rest_b[k] = pieces->angle[b] - direction;
}

void oz_pieces_corners(const OzPieces *pieces, int64_t i, const double position[2], double angle,
                       double corners[6])
{
    double c = cos(angle), s = sin(angle);
    const double *corner = pieces->corner + 6 * i;
    for (int k = 0; k < 3; k++) {
        corners[2 * k] = position[0] + c * corner[2 * k] - s * corner[2 * k + 1];
        corners[2 * k + 1] = position[1] + s * corner[2 * k] + c * corner[2 * k + 1];
    }
}
