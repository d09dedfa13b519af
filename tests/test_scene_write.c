/* Scenes written back load to the same scene, field by field, whatever was in them; and no text
 * whatever brings the reader down. */
#include "base/file.h"
#include "base/random.h"
#include "scene/scene.h"

#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define SMALL                                                                                      \
    "model: rods\n"                                                                                \
    "time: {step: 1e-5, duration: 1}\n"                                                            \
    "contact: {contact_time: 1e-3, restitution: 0.5}\n"                                            \
    "grains: []\n"

#define SHAKEN SMALL "walls:\n  - kind: plane\n    motion: {frequency: 30, acceleration_ratio: 2}\n"

/* The arguments `settings, setting_count`. */
#define SETTINGS(...)                                                                              \
    (char *[]){__VA_ARGS__}, (int)(sizeof((char *[]){__VA_ARGS__}) / sizeof(char *))

static OzScene parse(const char *text, char *const *settings, int count)
{
    OzScene scene;
    if (oz_scene_parse(&scene, "scenes/small.yaml", text, settings, count) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return scene;
}

#define SAME(field) assert_memory_equal(&a->field, &b->field, sizeof a->field)

static void assert_same_text(const char *a, const char *b)
{
    assert_int_equal(a == NULL, b == NULL);
    if (a) {
        assert_string_equal(a, b);
    }
}

static void assert_same_contact(const OzContactValues *a, const OzContactValues *b)
{
    SAME(law);
    SAME(contact_time);
    SAME(restitution);
    SAME(friction);
    SAME(tangential_stiffness);
    SAME(tangential_damping);
    SAME(slip);
    SAME(attraction);
    SAME(damping);
    SAME(parallel);
    SAME(contact_point);
    SAME(restitution_at);
    SAME(restitution_calibration);
    SAME(hertz_stiffness);
    SAME(normal_damping_rate);
    SAME(tangential_damping_rate);
    SAME(youngs_modulus);
    SAME(poisson_ratio);
}

static void assert_same_wall(const OzWall *a, const OzWall *b)
{
    SAME(kind);
    SAME(point);
    SAME(normal);
    SAME(diameter);
    SAME(from);
    SAME(to);
    SAME(width);
    SAME(height);
    SAME(opening);
    SAME(slope);
    SAME(tooth_count);
    SAME(tooth_depth);
    SAME(thickness);
    assert_true(a->since == b->since && a->until == b->until);
    SAME(motion.present);
    SAME(motion.angular_velocity);
    SAME(motion.frequency);
    SAME(motion.acceleration_ratio);
    SAME(motion.amplitude);
    assert_same_contact(&a->contact, &b->contact);
}

static void assert_same_population(const OzPopulation *a, const OzPopulation *b)
{
    SAME(kind);
    SAME(count);
    SAME(diameter);
    SAME(aspect);
    SAME(density);
    SAME(fill);
    SAME(cells);
    SAME(spacing);
    SAME(position);
    SAME(axis);
    SAME(velocity);
    SAME(angular_velocity);
    SAME(shape);
    SAME(edge);
    SAME(radius);
    SAME(corners);
    SAME(irregularity);
    SAME(depth);
    SAME(angle);
    SAME(vertex_count);
    for (int i = 0; i < a->vertex_count; i++) {
        assert_true(a->vertices[i] == b->vertices[i]);
    }
    assert_same_text(a->path, b->path);
}

static void assert_same_outputs(const OzScene *a, const OzScene *b)
{
    SAME(settle.present);
    SAME(settle.drag);
    SAME(settle.threshold);
    SAME(settle.rest_time);
    SAME(settle.time_max);
    SAME(observe.interval);
    SAME(observe.samples_per_tap);
    SAME(observe.at);
    SAME(observe.layer_thickness);
    SAME(observe.ledger);
    SAME(observe.outlet);
    SAME(observe.has_outlet);
    SAME(movie.outlines);
    SAME(movie.beams);
    SAME(snapshots.strobe);
    SAME(movie.present);
    SAME(movie.width);
    SAME(movie.height);
    SAME(movie.fps);
    SAME(movie.view_count);
    SAME(movie.views);
    SAME(movie.colour);
    SAME(movie.speed);
    SAME(movie.length);
    SAME(snapshots.count);
    SAME(snapshots.tap_count);
    for (int i = 0; i < a->snapshots.count; i++) {
        assert_true(a->snapshots.times[i] == b->snapshots.times[i]);
    }
}

static void assert_same(const OzScene *a, const OzScene *b)
{
    assert_same_text(a->title, b->title);
    SAME(model);
    SAME(seed);
    SAME(gravity);
    SAME(step);
    SAME(duration);
    SAME(taps);
    SAME(period);
    SAME(integrator);
    SAME(precision);
    SAME(broadphase);
    SAME(skin);
    SAME(gyroscopic);
    SAME(triangles);
    SAME(beams.stiffness);
    SAME(beams.second_moment);
    SAME(beams.damping);
    SAME(beams.damping_shear);
    SAME(beams.substeps);
    SAME(beams.length_min);
    SAME(beams.area_min);
    assert_same_contact(&a->contact, &b->contact);
    SAME(population_count);
    for (int i = 0; i < a->population_count; i++) {
        assert_same_population(&a->populations[i], &b->populations[i]);
    }
    SAME(wall_count);
    for (int i = 0; i < a->wall_count; i++) {
        assert_same_wall(&a->walls[i], &b->walls[i]);
    }
    assert_same_outputs(a, b);
}

static void assert_written_back(const OzScene *scene)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_int_equal(oz_scene_write(scene, file), OZ_OK);
    fclose(file);
    OzScene again;
    if (oz_scene_parse(&again, "elsewhere/again.yaml", text, NULL, 0) != OZ_OK) {
        fail_msg("%s\n%s", oz_status_text(), text);
    }
    assert_same(scene, &again);
    oz_scene_free(&again);
    free(text);
}

static void writes_what_it_read(void **state)
{
    (void)state;
    glob_t files;
    assert_int_equal(glob(ORZO_SCENES "/*.yaml", 0, NULL, &files), 0);
    assert_true(files.gl_pathc >= 10);
    for (size_t i = 0; i < files.gl_pathc; i++) {
        OzScene scene;
        if (oz_scene_load(&scene, files.gl_pathv[i], NULL, 0) != OZ_OK) {
            fail_msg("%s", oz_status_text());
        }
        assert_written_back(&scene);
        oz_scene_free(&scene);
    }
    globfree(&files);
}

static void writes_settings_and_odd_values(void **state)
{
    (void)state;
    OzScene scene = parse(
        SHAKEN "  - {kind: plane, normal: [1, 2, 3], motion: {frequency: 7, amplitude: 1e-3}}\n"
               "  - {kind: cylinder, diameter: 1, from: 0.1, until: 0.7, contact: "
               "{tangential_stiffness: 1/3, restitution: 0.25}}\n",
        SETTINGS(
            "time.taps=30", "title=\"a \\\"b\\\" \\\\ #: \\x01\\u0085 Pösch\\ufeffel\\n\"",
            "grains=[{kind: single, diameter: 1/3, position: [0.1, -0.2, 0.3], axis: [3, 1, 2]},"
            " {kind: random, count: 3, diameter: [1e-3, 2e-3], aspect: [0, 5]},"
            " {kind: lattice, cells: [1, 2, 3], spacing: [1, 1, 0.7], position: [0, 0, 1],"
            " diameter: 0.1, spin: [1e-300, 0, -5e-324]}]",
            "snapshots.taps=[3, 1/7, 1, 3]", "movie.views=cut", "movie.speed=1/7", "skin=1e-4",
            "seed=9007199254740993", "settle.drag=1/9", "walls.0.motion.acceleration_ratio=0"));
    assert_true(scene.seed == 9007199254740993u && scene.snapshots.count == 3);
    assert_written_back(&scene);
    oz_scene_free(&scene);
    scene = parse(SMALL, SETTINGS("time.step=1e-3", "time.duration=1e-2"));
    assert_true(scene.observe.interval == scene.step); /* not a hundredth */
    assert_written_back(&scene);
    oz_scene_free(&scene);
}

/* Any double must survive, not only those that are short in decimal. */
static void writes_every_bit(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(1, 0);
    for (int i = 0; i < 200; i++) {
        char setting[64], axis[160];
        snprintf(setting, sizeof setting, "contact.friction=%.17g",
                 oz_random_uniform(&random, 0, 1));
        double vector[3];
        oz_random_direction(&random, vector);
        snprintf(axis, sizeof axis,
                 "grains=[{kind: single, diameter: 1, position: [0, 0, 0], "
                 "axis: [%.17g, %.17g, %.17g]}]",
                 3 * vector[0], 3 * vector[1], 3 * vector[2]);
        OzScene scene = parse(SMALL, SETTINGS(setting, axis));
        assert_written_back(&scene);
        oz_scene_free(&scene);
    }
}

#define FLAT "model: trigrains\ntime: {step: 1e-6, duration: 1}\n"

static void writes_trigrains(void **state)
{
    (void)state;
    OzScene scene = parse(
        FLAT "contact: {restitution: 0, contact_time: 1e-4, tangential_damping: 0.5}\n"
             "grains:\n"
             "  - {kind: random, count: 3, shape: polygon, radius: [1e-3, 1/3], corners: [3, 6],"
             " irregularity: 1/7}\n"
             "  - {kind: single, shape: star, radius: 1, corners: 5, depth: 0.3, position: [1, 2],"
             " velocity: [0.1, 0], spin: -3, angle: -0.1}\n"
             "  - {kind: lattice, shape: vertices, vertices: [0, 0, 1/3, 0, 0, 1], cells: [2, 3],"
             " spacing: [2, 2], position: [0, 0]}\n"
             "  - {kind: random, count: 1, shape: disc, radius: 0.1, fill: 0.2}\n"
             "walls:\n"
             "  - {kind: segment, from: [0, 1], to: [1, 0], until: 0.3, thickness: 1/9}\n"
             "  - {kind: hopper, width: 1, height: 2, opening: 0, slope: 33.3, teeth: 3,"
             " tooth_depth: 0.01, motion: {frequency: 30, amplitude: 0}}\n"
             "  - {kind: drum, diameter: 1, motion: {angular_velocity: 0}}\n"
             "  - {kind: floor, width: 1, motion: {frequency: 7, acceleration_ratio: 2,"
             " angular_velocity: 1}}\n"
             "observe: {outlet: 0}\nmovie: {outlines: false, beams: true, colour: grey}\n",
        SETTINGS("snapshots.strobe=1/7", "beams.substeps=3", "integrator=velocity-verlet",
                 "beams.damping_shear=balanced", "triangles.force_point=midpoint",
                 "triangles.overlap=field"));
    assert_true(scene.observe.has_outlet && scene.gravity[1] == -9.81 && scene.gravity[2] == 0);
    assert_true(scene.populations[1].angular_velocity[2] == -3 && scene.populations[2].count == 6);
    /* degrees to rad: a product's rounding */
    assert_true(fabs(scene.walls[1].slope - 33.3 * acos(-1) / 180) < 1e-15);
    assert_true(scene.walls[2].contact.contact_time == 1e-4);
    assert_int_equal(scene.precision, OZ_PRECISION_DOUBLE);
    assert_written_back(&scene);
    oz_scene_free(&scene);
    /* Without discs contacts are not asked for; an angle keeps every bit through degrees. */
    OzRandom random = oz_random_stream(2, 0);
    for (int i = 0; i < 500; i++) {
        char angle[64];
        snprintf(angle, sizeof angle, "grains.0.angle=%.17g",
                 oz_random_uniform(&random, -360, 360));
        scene = parse(FLAT "grains: [{kind: single, shape: square, edge: 1, position: [0, 0]}]\n",
                      SETTINGS(angle));
        assert_false(scene.observe.has_outlet);
        assert_written_back(&scene);
        oz_scene_free(&scene);
    }
}

static void finds_files_beside_the_scene(void **state)
{
    (void)state;
    OzScene scene;
    const char *text = "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                       "contact: {contact_time: 1e-3, restitution: 0.5}\n"
                       "grains: [{kind: file, path: test_scene.c}]\n";
    assert_int_equal(oz_scene_parse(&scene, "../tests/x.yaml", text, NULL, 0), OZ_OK);
    assert_true(scene.populations[0].path[0] == '/' && oz_file_exists(scene.populations[0].path));
    assert_int_equal(scene.populations[0].count, -1);
    assert_written_back(&scene);
    oz_scene_free(&scene);
}

static const char *const TOKENS[] = {"grains:",
                                     "- ",
                                     "[",
                                     "]",
                                     "{",
                                     "}",
                                     ": ",
                                     "\n",
                                     "  ",
                                     "&a ",
                                     "*a",
                                     "<<: ",
                                     "!!int ",
                                     "\"",
                                     "'",
                                     "|",
                                     ">",
                                     "#",
                                     "nan",
                                     "1e99",
                                     "-",
                                     "movie: ",
                                     "null",
                                     "false",
                                     "taps: ",
                                     "---\n",
                                     "\xff",
                                     "extends: an6.yaml\n",
                                     "kind: file\n",
                                     "%YAML 1.1\n",
                                     "? ",
                                     "\t",
                                     "\"\\0\"",
                                     "0.5",
                                     "single"};

static size_t below(OzRandom *random, size_t limit)
{
    return (size_t)(oz_random_bits(random) % (limit ? limit : 1));
}

/* Flips a bit, deletes, doubles or inserts: *text is replaced. */
static void mutate(char **text, OzRandom *random)
{
    size_t length = strlen(*text), start = below(random, length);
    size_t part = below(random, length - start < 60 ? length - start : 60);
    const char *token = TOKENS[below(random, sizeof TOKENS / sizeof *TOKENS)];
    char *made = NULL;
    switch (below(random, 4)) {
    case 0:
        (*text)[start] = (char)((*text)[start] ^ (1 << below(random, 8)));
        return;
    case 1:
        assert_true(asprintf(&made, "%.*s%s", (int)start, *text, *text + start + part) >= 0);
        break;
    case 2:
        assert_true(asprintf(&made, "%.*s%s", (int)(start + part), *text, *text + start) >= 0);
        break;
    default:
        assert_true(asprintf(&made, "%.*s%s%s", (int)start, *text, token, *text + start) >= 0);
        break;
    }
    free(*text);
    *text = made;
}

static void check_noise(const char *path, const char *text, int *good)
{
    OzScene scene;
    OzStatus status = oz_scene_parse(&scene, path, text, NULL, 0);
    if (status == OZ_OK) {
        (*good)++;
        assert_written_back(&scene);
        oz_scene_free(&scene);
        return;
    }
    assert_int_equal(status, OZ_ERR_INPUT);
    assert_true(strstr(oz_status_text(), ".yaml:") || strstr(oz_status_text(), ".csv:"));
    assert_non_null(strstr(oz_status_text(), "; "));
}

static void survives_noise(void **state)
{
    (void)state;
    glob_t files;
    OzRandom random = oz_random_stream(7, 0);
    int good = 0, rounds = 400;
    assert_int_equal(glob(ORZO_SCENES "/*.yaml", 0, NULL, &files), 0);
    for (size_t i = 0; i < files.gl_pathc; i++) {
        char *original = NULL;
        assert_int_equal(oz_file_read(&original, NULL, files.gl_pathv[i]), OZ_OK);
        for (int round = 0; round < rounds; round++) {
            char *text = strdup(original);
            for (size_t n = 1 + below(&random, 4); n > 0; n--) {
                mutate(&text, &random);
            }
            check_noise(files.gl_pathv[i], text, &good);
            free(text);
        }
        free(original);
    }
    /* Noise that is always refused at the door would test nothing behind it. */
    assert_true(good > rounds / 2);
    globfree(&files);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(writes_what_it_read),
        cmocka_unit_test(writes_settings_and_odd_values),
        cmocka_unit_test(writes_every_bit),
        cmocka_unit_test(writes_trigrains),
        cmocka_unit_test(finds_files_beside_the_scene),
        cmocka_unit_test(survives_noise),
    };
    if (chdir(ORZO_TESTS) != 0) {
        return 1;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
