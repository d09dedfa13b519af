/* Flat grains written by hand for tests of what looks at snapshots: squares of four triangles, then
 * discs, and one wall of triangles. */
#ifndef TESTS_HAND_HEAP_H
#define TESTS_HAND_HEAP_H

#include "hand_folder.h"

#include "model/snapshot.h"

static const double HEAP_DENSITY = 4; /* kg/m^2 */

typedef struct Heap {
    OzWall wall;
    OzScene scene;
    OzGrains grains;
    OzSnapshot snapshot;
    int64_t squares, discs, beams_set, outlines_set;
} Heap;

static inline void heap_create(Heap *heap, int64_t squares, int64_t discs, int64_t wall_triangles)
{
    OzElementCounts counts = {.grains = squares + discs,
                              .walls = wall_triangles > 0,
                              .free_elements = 4 * squares + discs,
                              .wall_elements = wall_triangles,
                              .beams = 4 * squares,
                              .outlines = 4 * squares};
    memset(heap, 0, sizeof *heap);
    heap->squares = squares;
    heap->discs = discs;
    heap->scene.model = OZ_MODEL_TRIGRAINS;
    heap->scene.walls = &heap->wall;
    heap->scene.wall_count = wall_triangles > 0;
    heap->scene.duration = 1;
    heap->scene.step = 1e-3;
    heap->wall.kind = OZ_WALL_FLOOR;
    assert_int_equal(oz_grains_create(&heap->grains, squares + discs), OZ_OK);
    assert_int_equal(oz_elements_create(&heap->grains.elements, &counts), OZ_OK);
    OzElements *elements = heap->grains.elements;
    for (int64_t g = 0, next = 0; g <= elements->grain_count + elements->wall_count; g++) {
        elements->first[g] = next;
        next += g < squares ? 4 : g < squares + discs ? 1 : wall_triangles;
        for (int64_t i = elements->first[g]; i < next && i < elements->count; i++) {
            elements->body[i] = (int)g;
        }
    }
    assert_int_equal(oz_snapshot_create(&heap->snapshot, &heap->scene, &heap->grains), OZ_OK);
}

static inline void heap_free(Heap *heap)
{
    oz_snapshot_free(&heap->snapshot);
    oz_grains_free(&heap->grains);
}

/* Square g about (x, y), turned by angle: its triangles look down, right, up and left at angle 0.
 */
static inline void heap_put_square(Heap *heap, int64_t g, double x, double y, double edge,
                                   double angle)
{
    OzElements *elements = heap->grains.elements;
    double corner[4][2], half = edge / sqrt(2);
    for (int c = 0; c < 4; c++) {
        double turn = angle + (c - 2) * 3.14159265358979323846 / 2 - 3.14159265358979323846 / 4 +
                      3.14159265358979323846 / 2;
        corner[c][0] = x + half * cos(turn);
        corner[c][1] = y + half * sin(turn);
    }
    for (int64_t k = 0; k < 4; k++) {
        const double *from = corner[k], *to = corner[(k + 1) % 4];
        const double corners[6] = {x, y, from[0], from[1], to[0], to[1]};
        assert_int_equal(oz_elements_set_triangle(elements, 4 * g + k, corners, HEAP_DENSITY),
                         OZ_OK);
        elements->outline_element[heap->outlines_set] = (int)(4 * g + k);
        elements->outline_edge[heap->outlines_set++] = 1;
        elements->beam_a[heap->beams_set] = (int)(4 * g + (k < 3 ? k : 0));
        elements->beam_b[heap->beams_set++] = (int)(4 * g + (k < 3 ? k + 1 : 3));
    }
    heap->grains.diameter[g] = 2 * half;
    heap->grains.mass[g] = HEAP_DENSITY * edge * edge;
}

static inline void heap_put_disc(Heap *heap, int64_t g, double x, double y, double radius)
{
    int64_t i = heap->grains.elements->first[g];
    oz_elements_set_disc(heap->grains.elements, i, (const double[2]){x, y}, radius, HEAP_DENSITY);
    heap->grains.diameter[g] = 2 * radius;
    heap->grains.mass[g] = heap->grains.elements->mass[i];
}

static inline void heap_put_wall(Heap *heap, int64_t k, const double corners[6])
{
    OzElements *elements = heap->grains.elements;
    assert_int_equal(oz_elements_set_triangle(elements, elements->free_count + k, corners, 0),
                     OZ_OK);
}

/* The snapshot of the elements' start. */
static inline void heap_start(Heap *heap)
{
    const OzElements *elements = heap->grains.elements;
    OzSnapshot *s = &heap->snapshot;
    memcpy(s->element_position, elements->position, (size_t)(2 * elements->count) * sizeof(double));
    memcpy(s->element_angle, elements->angle, (size_t)elements->count * sizeof(double));
    memcpy(s->element_velocity, elements->velocity, (size_t)(2 * elements->count) * sizeof(double));
    memcpy(s->element_angular_velocity, elements->angular_velocity,
           (size_t)elements->count * sizeof(double));
    oz_snapshot_join_elements(s);
}

/* Moves grain g as a rigid body: from where it is by (x, y), turned by angle about its centre. */
static inline void heap_move(Heap *heap, int64_t g, double x, double y, double angle)
{
    OzSnapshot *s = &heap->snapshot;
    const OzElements *elements = heap->grains.elements;
    double centre[2] = {s->position[3 * g], s->position[3 * g + 1]};
    for (int64_t i = elements->first[g]; i < elements->first[g + 1]; i++) {
        double *p = s->element_position + 2 * i, dx = p[0] - centre[0], dy = p[1] - centre[1];
        p[0] = centre[0] + x + cos(angle) * dx - sin(angle) * dy;
        p[1] = centre[1] + y + sin(angle) * dx + cos(angle) * dy;
        s->element_angle[i] += angle;
    }
    oz_snapshot_join_elements(s);
}

/* Gives grain g a rigid body's velocity. */
static inline void heap_push(Heap *heap, int64_t g, double vx, double vy, double angular_velocity)
{
    OzSnapshot *s = &heap->snapshot;
    const OzElements *elements = heap->grains.elements;
    for (int64_t i = elements->first[g]; i < elements->first[g + 1]; i++) {
        s->element_velocity[2 * i] =
            vx - angular_velocity * (s->element_position[2 * i + 1] - s->position[3 * g + 1]);
        s->element_velocity[2 * i + 1] =
            vy + angular_velocity * (s->element_position[2 * i] - s->position[3 * g]);
        s->element_angular_velocity[i] = angular_velocity;
    }
    oz_snapshot_join_elements(s);
}

#endif
