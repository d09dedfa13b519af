/* What two-dimensional grains and their walls are made of (Poeschel and Buchholtz 1995): rigid
 * elements, each a triangle or a disc, and the beams that join a grain's triangles. Arrays by
 * element id: the elements of grain 0 first, then of grain 1, ..., then those of the walls in scene
 * order. Double, SI, a metre deep: nothing here depends on a third dimension. */
#pragma once

#include "base/status.h"

#include <stdint.h>

/* Geometry, mass and beams never change during a run; position to spin are the start, at which all
 * beams are at rest. */
typedef struct OzElements {
    int64_t grain_count;
    int64_t wall_count; /* of the scene                                                         */
    int64_t free_count; /* elements of grains; those of walls follow                              */
    int64_t count;      /* all elements                                                           */
    int64_t *first;     /* grain_count + wall_count + 1: the first element of each body           */
    int *body;          /* count: the grain, or grain_count + the wall                          */
    int *member;      /* free_count: elements by body, where they are not in order (model/pieces.h);
                         NULL:      they are                                                               */
    double *radius;   /* count: m, of a disc; 0 for a triangle                                */
    double *corner;   /* 6 x count: m, x y of three corners about the centre of mass,
                         counter-clockwise, at angle 0; zero for a disc                       */
    double *reach;    /* count: m, from the centre of mass to the farthest point              */
    double *area;     /* count: m^2                                                           */
    double *mass;     /* count: kg; 0 for walls                                               */
    double *inertia;  /* count: kg m^2 about the centre of mass; 0 for walls                  */
    double *position; /* 2 x count: m, centre of mass                                         */
    double *angle;    /* count: rad, not wrapped                                              */
    double *velocity; /* 2 x count: m/s                                                       */
    double *angular_velocity; /* count: rad/s */
    int64_t beam_count;
    int *beam_a, *beam_b; /* beam_count: elements, a < b, of one grain; ordered by a, then b */
    double *beam_length;  /* beam_count: m, at rest                                               */
    double *beam_rest_a;  /* beam_count: rad, angle of a less the direction from a to b, at rest  */
    double *beam_rest_b;  /* beam_count: rad, angle of b less the same direction, at rest         */
    int64_t outline_count;
    int *outline_element; /* outline_count: edges on the outside of grains and walls, in order of
                           elements                                                               */
    int *outline_edge;    /* outline_count: 0..2, from that corner to the next                    */
} OzElements;

/* How much there is to allocate. */
typedef struct OzElementCounts {
    int64_t grains, walls, free_elements, wall_elements, beams, outlines;
} OzElementCounts;

/* Allocates zeroed arrays of these sizes; the caller frees with oz_elements_free. */
OzStatus oz_elements_create(OzElements **elements, const OzElementCounts *counts);
void oz_elements_free(OzElements *elements); /* NULL is fine */

/* Takes a triangle's corners (x y, world, any order) as element i at angle 0: position, corner,
 * reach, area, and mass and inertia for this density (kg/m^2; 0 for walls). Fails with OZ_ERR_INPUT
 * for a triangle without area. */
OzStatus oz_elements_set_triangle(OzElements *elements, int64_t i, const double corners[6],
                                  double density);

/* The same for a disc. */
void oz_elements_set_disc(OzElements *elements, int64_t i, const double centre[2], double radius,
                          double density);

/* Rest length and angles of beam k from its elements' positions and angles now. */
void oz_elements_rest_beam(OzElements *elements, int64_t k);

/* The k-th element in the order of bodies: those of body b are k = first[b] ... first[b + 1] - 1.
 */
static inline int64_t oz_elements_at(const OzElements *elements, int64_t k)
{
    return elements->member && k < elements->free_count ? elements->member[k] : k;
}

/* Its edges on the outside of its body, as bits 0..2; a disc has none. */
int oz_elements_outer_edges(const OzElements *elements, int64_t i);

/* The world coordinates of an element's corners at a position and angle. */
void oz_elements_corners(const OzElements *elements, int64_t i, const double position[2],
                         double angle, double corners[6]);

/* How far a body has turned since the start, rad, not wrapped: the mean over its elements by mass;
 * angle is of all elements now. */
double oz_elements_turned(const OzElements *elements, int64_t body, const double *angle);

/* m^2, of a body's elements together. */
double oz_elements_body_area(const OzElements *elements, int64_t body);
