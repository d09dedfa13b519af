/* One grain's triangles. Knows neither where grains lie nor how they move. */
#include "model/shape.h"

#include "model/symmetry.h"
#include "model/triangulation.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Draws before a random population is refused: one in a thousand within the limits is a scene that
 * asks for something else than it gets. */
enum { DRAW_LIMIT = 1000 };

static double draw(OzRandom *random, const OzRange *range)
{
    return oz_random_uniform(random, range->low, range->high);
}

static int draw_whole(OzRandom *random, const OzRange *range)
{
    double whole = floor(oz_random_uniform(random, range->low, range->high + 1));
    return (int)fmin(whole, range->high);
}

/* A triangle on each edge of the polygon that is in the first vertices, about the last vertex;
 * joined, the centre of mass in the origin. */
static OzStatus fan(OzTriangleSet *triangle_set)
{
    int n = triangle_set->triangle_count;
    for (int i = 0; i < n; i++) {
        triangle_set->triangle[3 * i] = n;
        triangle_set->triangle[3 * i + 1] = i;
        triangle_set->triangle[3 * i + 2] = (i + 1) % n;
    }
    OzStatus status = oz_triangle_set_join(triangle_set);
    if (status == OZ_OK) {
        oz_triangle_set_centre(triangle_set);
    }
    return status;
}

static void put(OzTriangleSet *triangle_set, int vertex, double angle, double radius)
{
    triangle_set->vertex[2 * vertex] = radius * cos(angle);
    triangle_set->vertex[2 * vertex + 1] = radius * sin(angle);
}

static OzStatus make_square(OzTriangleSet *triangle_set, const OzScene *scene,
                            const OzPopulation *population, OzRandom *random)
{
    (void)scene;
    double edge = draw(random, &population->edge);
    OzStatus status = oz_triangle_set_create(triangle_set, 5, 4);
    for (int i = 0; status == OZ_OK && i < 4; i++) {
        triangle_set->vertex[2 * i] = i == 0 || i == 3 ? -edge / 2 : edge / 2;
        triangle_set->vertex[2 * i + 1] = i < 2 ? -edge / 2 : edge / 2;
    }
    return status == OZ_OK ? fan(triangle_set) : status;
}

static OzStatus make_polygon(OzTriangleSet *triangle_set, const OzScene *scene,
                             const OzPopulation *population, OzRandom *random)
{
    (void)scene;
    int n = draw_whole(random, &population->corners);
    double radius = draw(random, &population->radius), q = population->irregularity;
    OzStatus status = oz_triangle_set_create(triangle_set, n + 1, n);
    for (int i = 0; status == OZ_OK && i < n; i++) {
        double turn = 0.4 * q * PI / n * oz_random_uniform(random, -1, 1);
        double inward = 0.5 * q * oz_random_uniform(random, 0, 1);
        put(triangle_set, i, 2 * PI * i / n + turn, radius * (1 - inward));
    }
    return status == OZ_OK ? fan(triangle_set) : status;
}

static OzStatus make_star(OzTriangleSet *triangle_set, const OzScene *scene,
                          const OzPopulation *population, OzRandom *random)
{
    (void)scene;
    int n = 2 * draw_whole(random, &population->corners);
    double radius = draw(random, &population->radius);
    OzStatus status = oz_triangle_set_create(triangle_set, n + 1, n);
    for (int i = 0; status == OZ_OK && i < n; i++) {
        put(triangle_set, i, 2 * PI * i / n, i % 2 ? population->depth * radius : radius);
    }
    return status == OZ_OK ? fan(triangle_set) : status;
}

/* What a grain has least of. */
typedef struct Least {
    double length, area; /* m, m^2 */
} Least;

static Least least_of(const OzTriangleSet *triangle_set)
{
    Least least = {INFINITY, INFINITY};
    for (int k = 0; k < triangle_set->joint_count; k++) {
        least.length = fmin(least.length, oz_triangle_set_joint_length(triangle_set, k));
    }
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        least.area = fmin(least.area, oz_triangle_set_area(triangle_set, t));
    }
    return least;
}

/* Sizes a part in 1e9 below a limit meet it: a limit may be the very size of a regular grain. */
static bool is_within(const Least *least, const OzBeamValues *limits)
{
    double slack = 1 - 1e-9;
    return least->length >= slack * limits->length_min && least->area >= slack * limits->area_min;
}

/* The outline of a cut polygon with a triangle on each edge about its centre of mass, which keeps
 * every symmetry. *made stays false where that centre does not see all edges, or an element would
 * be below the limits. */
static OzStatus cut_about_centre(OzTriangleSet *triangle_set, const OzTriangleSet *cut,
                                 const OzBeamValues *limits, bool *made)
{
    int n = cut->vertex_count;
    *made = true;
    for (int i = 0; i < n; i++) {
        const double *a = cut->vertex + 2 * i, *b = cut->vertex + 2 * ((i + 1) % n);
        *made &= a[0] * b[1] - a[1] * b[0] > 0;
    }
    if (!*made) {
        return OZ_OK;
    }
    OZ_PASS(oz_triangle_set_create(triangle_set, n + 1, n));
    memcpy(triangle_set->vertex, cut->vertex, (size_t)(2 * n) * sizeof *cut->vertex);
    OZ_PASS(fan(triangle_set));
    Least least = least_of(triangle_set);
    *made = is_within(&least, limits);
    return OZ_OK;
}

/* Into as few triangles as there can be, or where those are less symmetric than the outline about
 * its middle if that can be. */
static OzStatus make_vertices(OzTriangleSet *triangle_set, const OzScene *scene,
                              const OzPopulation *population, OzRandom *random)
{
    (void)random;
    OzStatus status = OZ_OK;
    OzTriangleSet about = {0};
    bool made = false;
    char where[1024];
    snprintf(where, sizeof where, "%s:%d", scene->path, population->line);
    OZ_TRY(oz_triangulation_make(triangle_set, population->vertices, population->vertex_count / 2,
                                 where));
    oz_triangle_set_centre(triangle_set);
    if (!oz_symmetry_is_kept(triangle_set)) {
        OZ_TRY(cut_about_centre(&about, triangle_set, &scene->beams, &made));
    }
    if (made) {
        oz_triangle_set_free(triangle_set);
        *triangle_set = about;
        about = (OzTriangleSet){0};
    }
done:
    oz_triangle_set_free(&about);
    return status;
}

bool oz_shape_keeps_symmetry(const OzScene *scene, const OzPopulation *population)
{
    OzTriangleSet triangle_set = {0};
    bool kept = population->shape != OZ_SHAPE_VERTICES ||
                make_vertices(&triangle_set, scene, population, NULL) != OZ_OK ||
                triangle_set.vertex_count > population->vertex_count / 2 ||
                oz_symmetry_is_kept(&triangle_set);
    oz_triangle_set_free(&triangle_set);
    return kept;
}

static OzStatus make_disc(OzTriangleSet *triangle_set, const OzScene *scene,
                          const OzPopulation *population, OzRandom *random)
{
    (void)scene;
    oz_triangle_set_set_disc(triangle_set, draw(random, &population->radius));
    return OZ_OK;
}

#define ROW(NAME, name, choice) [OZ_SHAPE_##NAME] = make_##name,
static OzStatus (*const makers[])(OzTriangleSet *triangle_set, const OzScene *scene,
                                  const OzPopulation *population,
                                  OzRandom *random) = {OZ_SHAPES(ROW)};
#undef ROW

static bool is_open(const OzPopulation *population)
{
    const OzRange *edge = &population->edge, *radius = &population->radius,
                  *corners = &population->corners;
    return population->shape != OZ_SHAPE_VERTICES &&
           (edge->low < edge->high || radius->low < radius->high || corners->low < corners->high ||
            population->irregularity > 0);
}

static OzStatus refuse(const OzScene *scene, const OzPopulation *population, const Least *least)
{
    const OzBeamValues *limits = &scene->beams;
    char draws[64] = "";
    if (is_open(population)) {
        snprintf(draws, sizeof draws, ", the last of %d drawn,", DRAW_LIMIT);
    }
    if (least->length < limits->length_min) {
        return oz_status_fail(
            OZ_ERR_INPUT,
            "%s:%d: a grain%s has a beam of %.3g m, below beams.length_min %g m: its bending "
            "stiffness 12 E I / L^3 and damping gamma I / L would need tiny steps; expected larger "
            "grains, fewer corners, or a lower beams.length_min with a smaller second_moment",
            scene->path, population->line, draws, least->length, limits->length_min);
    }
    return oz_status_fail(
        OZ_ERR_INPUT,
        "%s:%d: a grain%s has a triangle of %.3g m^2, below beams.area_min %g m^2: so light an "
        "element would need tiny steps; expected larger grains, fewer corners, or a lower "
        "beams.area_min",
        scene->path, population->line, draws, least->area, limits->area_min);
}

OzStatus oz_shape_make(OzTriangleSet *triangle_set, const OzScene *scene,
                       const OzPopulation *population, OzRandom *random)
{
    OzStatus status = OZ_OK;
    Least least = {0, 0};
    for (int i = 0; i < (is_open(population) ? DRAW_LIMIT : 1); i++) {
        *triangle_set = (OzTriangleSet){0};
        OZ_TRY(makers[population->shape](triangle_set, scene, population, random));
        least = least_of(triangle_set);
        if (is_within(&least, &scene->beams)) {
            return OZ_OK;
        }
        oz_triangle_set_free(triangle_set);
    }
    status = refuse(scene, population, &least);
done:
    oz_triangle_set_free(triangle_set);
    return status;
}
