/* Arrays of elements, and an element's geometry. */
#include "model/elements.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

OzStatus oz_elements_create(OzElements **out, const OzElementCounts *counts)
{
    OzStatus status = OZ_OK;
    OzElements *elements = NULL;
    int64_t count = counts->free_elements + counts->wall_elements;
    *out = NULL;
    OZ_TRY(OZ_NEW(&elements, 1));
    elements->grain_count = counts->grains;
    elements->wall_count = counts->walls;
    elements->free_count = counts->free_elements;
    elements->count = count;
    elements->beam_count = counts->beams;
    elements->outline_count = counts->outlines;
    OZ_TRY(OZ_NEW(&elements->first, counts->grains + counts->walls + 1));
    OZ_TRY(OZ_NEW(&elements->body, count));
    OZ_TRY(OZ_NEW(&elements->radius, count));
    OZ_TRY(OZ_NEW(&elements->corner, 6 * count));
    OZ_TRY(OZ_NEW(&elements->reach, count));
    OZ_TRY(OZ_NEW(&elements->area, count));
    OZ_TRY(OZ_NEW(&elements->mass, count));
    OZ_TRY(OZ_NEW(&elements->inertia, count));
    OZ_TRY(OZ_NEW(&elements->position, 2 * count));
    OZ_TRY(OZ_NEW(&elements->angle, count));
    OZ_TRY(OZ_NEW(&elements->velocity, 2 * count));
    OZ_TRY(OZ_NEW(&elements->angular_velocity, count));
    OZ_TRY(OZ_NEW(&elements->beam_a, counts->beams));
    OZ_TRY(OZ_NEW(&elements->beam_b, counts->beams));
    OZ_TRY(OZ_NEW(&elements->beam_length, counts->beams));
    OZ_TRY(OZ_NEW(&elements->beam_rest_a, counts->beams));
    OZ_TRY(OZ_NEW(&elements->beam_rest_b, counts->beams));
    OZ_TRY(OZ_NEW(&elements->outline_element, counts->outlines));
    OZ_TRY(OZ_NEW(&elements->outline_edge, counts->outlines));
    *out = elements;
    elements = NULL;
done:
    oz_elements_free(elements);
    return status;
}

void oz_elements_free(OzElements *elements)
{
    if (!elements) {
        return;
    }
    free(elements->first);
    free(elements->body);
    free(elements->member);
    free(elements->radius);
    free(elements->corner);
    free(elements->reach);
    free(elements->area);
    free(elements->mass);
    free(elements->inertia);
    free(elements->position);
    free(elements->angle);
    free(elements->velocity);
    free(elements->angular_velocity);
    free(elements->beam_a);
    free(elements->beam_b);
    free(elements->beam_length);
    free(elements->beam_rest_a);
    free(elements->beam_rest_b);
    free(elements->outline_element);
    free(elements->outline_edge);
    free(elements);
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

OzStatus oz_elements_set_triangle(OzElements *elements, int64_t i, const double corners[6],
                                  double density)
{
    double turned[6], *corner = elements->corner + 6 * i, *position = elements->position + 2 * i;
    memcpy(turned, corners, sizeof turned);
    if (twice_area(corners) < 0) {
        memcpy(turned + 2, corners + 4, 2 * sizeof(double));
        memcpy(turned + 4, corners + 2, 2 * sizeof(double));
    }
    elements->area[i] = 0.5 * twice_area(turned);
    if (!(elements->area[i] > 0)) {
        return oz_status_fail(
            OZ_ERR_INPUT, "a triangle with corners (%g, %g), (%g, %g), (%g, %g) m has no area",
            corners[0], corners[1], corners[2], corners[3], corners[4], corners[5]);
    }
    position[0] = (turned[0] + turned[2] + turned[4]) / 3;
    position[1] = (turned[1] + turned[3] + turned[5]) / 3;
    elements->reach[i] = 0;
    for (int c = 0; c < 3; c++) {
        corner[2 * c] = turned[2 * c] - position[0];
        corner[2 * c + 1] = turned[2 * c + 1] - position[1];
        elements->reach[i] = fmax(elements->reach[i], hypot(corner[2 * c], corner[2 * c + 1]));
    }
    elements->angle[i] = 0;
    elements->radius[i] = 0;
    elements->mass[i] = density * elements->area[i];
    elements->inertia[i] = triangle_inertia(corner, elements->mass[i]);
    return OZ_OK;
}

void oz_elements_set_disc(OzElements *elements, int64_t i, const double centre[2], double radius,
                          double density)
{
    memset(elements->corner + 6 * i, 0, 6 * sizeof(double));
    memcpy(elements->position + 2 * i, centre, 2 * sizeof(double));
    elements->angle[i] = 0;
    elements->radius[i] = elements->reach[i] = radius;
    elements->area[i] = PI * radius * radius;
    elements->mass[i] = density * elements->area[i];
    elements->inertia[i] = 0.5 * elements->mass[i] * radius * radius;
}

void oz_elements_rest_beam(OzElements *elements, int64_t k)
{
    int a = elements->beam_a[k], b = elements->beam_b[k];
    double x = elements->position[2 * b] - elements->position[2 * a];
    double y = elements->position[2 * b + 1] - elements->position[2 * a + 1];
    double direction = atan2(y, x);
    elements->beam_length[k] = hypot(x, y);
    elements->beam_rest_a[k] = elements->angle[a] - direction;
    elements->beam_rest_b[k] = elements->angle[b] - direction;
}

int oz_elements_outer_edges(const OzElements *elements, int64_t i)
{
    int64_t first = 0, end = elements->outline_count;
    int edges = 0;
    while (first < end) {
        int64_t middle = first + (end - first) / 2;
        bool before = elements->outline_element[middle] < i;
        first = before ? middle + 1 : first;
        end = before ? end : middle;
    }
    for (; first < elements->outline_count && elements->outline_element[first] == i; first++) {
        edges |= 1 << elements->outline_edge[first];
    }
    return edges;
}

void oz_elements_corners(const OzElements *elements, int64_t i, const double position[2],
                         double angle, double corners[6])
{
    double c = cos(angle), s = sin(angle);
    const double *corner = elements->corner + 6 * i;
    for (int k = 0; k < 3; k++) {
        corners[2 * k] = position[0] + c * corner[2 * k] - s * corner[2 * k + 1];
        corners[2 * k + 1] = position[1] + s * corner[2 * k] + c * corner[2 * k + 1];
    }
}

double oz_elements_turned(const OzElements *elements, int64_t body, const double *angle)
{
    double turn = 0, mass = 0;
    for (int64_t k = elements->first[body]; k < elements->first[body + 1]; k++) {
        int64_t i = oz_elements_at(elements, k);
        mass += elements->mass[i];
        turn += elements->mass[i] * (angle[i] - elements->angle[i]);
    }
    return turn / mass;
}

double oz_elements_body_area(const OzElements *elements, int64_t body)
{
    double area = 0;
    for (int64_t k = elements->first[body]; k < elements->first[body + 1]; k++) {
        area += elements->area[oz_elements_at(elements, k)];
    }
    return area;
}
