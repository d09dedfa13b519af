/* Pictures of obstacles: what of their bodies is seen, against closed forms. */
#include "rig.h"

#include "draw/container.h"
#include "draw/framing.h"

static const double PI = 3.14159265358979323846;

/* In a box of 36 x 24 x 40 mm. */
#define IN_BOX                                                                                     \
    "model: rods\ntime: {step: 1e-5, duration: 1}\n"                                               \
    "contact: {contact_time: 3e-4, restitution: 0.5}\n"                                            \
    "grains: [{kind: single, diameter: 1e-3, position: [0, 10e-3, 30e-3]}]\n"                      \
    "walls:\n  - {kind: box, size: [36e-3, 24e-3, 40e-3]}\n  - {side: outside, %s}\n"

/* Chords of 96 corners lie 5.4e-4 radii within a ball, along both its angles; where a plane meets
 * it at 37 degrees from upright they take 2e-3 of the section. */
static const double polygons = 3e-3;

static void assert_near(double a, double b)
{
    if (!(fabs(a - b) <= polygons * fabs(b))) {
        fail_msg("%.9g is not %.9g within %g of it", a, b, polygons);
    }
}

static OzContainer container_of(const char *wall, OzView view, OzCamera *camera)
{
    Rig rig;
    OzContainer container = {.high = 0};
    rig_open(&rig, IN_BOX, wall);
    rig_start(&rig);
    OzLook look = oz_framing_look(&rig.scene, &rig.now);
    *camera = oz_camera_make(&look, 0);
    must(oz_container_build(&container, &rig.now, &look, camera, view));
    rig_close(&rig);
    return container;
}

/* Twice a triangle's area as a vector. */
static void area_of(const OzCorner *corners, double area[3])
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)corners[1].place[k] - (double)corners[0].place[k];
        b[k] = (double)corners[2].place[k] - (double)corners[0].place[k];
    }
    cross3(a, b, area);
}

/* m^2, of all triangles in the one colour of sections. */
static double section_of(const char *wall)
{
    OzCamera camera;
    OzContainer container = container_of(wall, OZ_VIEW_CUT, &camera);
    const OzMesh *mesh = &container.meshes[OZ_CONTAINER_OBSTACLES];
    double sum = 0;
    for (size_t i = 0; i < mesh->count; i += 3) {
        double area[3];
        bool is_section = fabsf(mesh->corners[i].rgba[0] - 0.80f) < 1e-6f &&
                          fabsf(mesh->corners[i].rgba[2] - 0.85f) < 1e-6f;
        area_of(mesh->corners + i, area);
        sum += is_section ? sqrt(dot3(area, area)) / 2 : 0;
    }
    oz_container_free(&container);
    return sum * camera.unit * camera.unit;
}

/* Of a ball in its middle, beside it, and where the bottom leaves a part of the circle; of pillars
 * and bars along and across the cut, within the box; nothing of what lies behind it. */
static void cuts_show_sections(void **state)
{
    (void)state;
    const double r = 5e-3, d = 3e-3;
    double angle = acos(d / r), below = r * r * angle - d * sqrt(r * r - d * d);
    assert_near(section_of("kind: sphere, diameter: 10e-3, point: [2e-3, 0, 9e-3]"), PI * r * r);
    assert_near(section_of("kind: sphere, diameter: 10e-3, point: [2e-3, 3e-3, 9e-3]"),
                PI * (r * r - d * d));
    assert_near(section_of("kind: sphere, diameter: 10e-3, point: [-2e-3, 0, 3e-3]"),
                PI * r * r - below);
    assert_near(section_of("kind: cylinder, ends: closed, diameter: 6e-3, length: 9e-3,"
                           " point: [1e-3, 0, 7e-3]"),
                6e-3 * 9e-3);
    assert_near(section_of("kind: cylinder, diameter: 4e-3, axis: [1, 0, 0], point: [0, 0, 9e-3]"),
                4e-3 * 36e-3);
    assert_near(section_of("kind: cylinder, diameter: 4e-3, axis: [0, 1, 0], point: [0, 0, 9e-3]"),
                PI * 2e-3 * 2e-3);
    assert_true(section_of("kind: sphere, diameter: 6e-3, point: [0, 4e-3, 9e-3]") == 0);
}

/* What the eye sees of a body covers its shadow once: triangles' areas in the picture, those that
 * turn away taken off, add up to a disc of radius d / sqrt(a^2 - d^2) at a distance a of the eye,
 * which is 1 / sqrt(1 - (off / a)^2 + ...) longer where the ball is off the middle: a hundredth. */
static void bodies_cover_their_shadows(void **state)
{
    (void)state;
    OzCamera camera;
    OzContainer container = container_of("kind: sphere, diameter: 10e-3, point: [0, 0, 9e-3]",
                                         OZ_VIEW_LATERAL, &camera);
    const OzMesh *mesh = &container.meshes[OZ_CONTAINER_OBSTACLES];
    const double middle[3] = {0, 0, 9e-3};
    double sum = 0, seen[3], radius = 5e-3 / camera.unit;
    oz_camera_see(&camera, middle, seen);
    for (size_t i = 0; i < mesh->count; i += 3) {
        OzCorner corners[3];
        double area[3];
        for (int c = 0; c < 3; c++) {
            corners[c] = mesh->corners[i + (size_t)c];
            float gap = (float)camera.distance - corners[c].place[2];
            for (int k = 0; k < 3; k++) {
                corners[c].place[k] = k < 2 ? corners[c].place[k] / gap : 0;
            }
        }
        area_of(corners, area);
        sum += area[2] / 2;
    }
    double away[3] = {seen[0], seen[1], camera.distance - seen[2]};
    double disc = PI * radius * radius / (dot3(away, away) - radius * radius);
    assert_true(fabs(fabs(sum) - disc) < 0.03 * disc);
    oz_container_free(&container);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_show_sections),
        cmocka_unit_test(bodies_cover_their_shadows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
