/* Scenes: what a good file gives, and what a bad one is told. */
#include "scene_text.h"

#include "base/file.h"
#include "scene/describe.h"
#include "scene/keys.h"

#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static void fills_in_defaults(void **state)
{
    (void)state;
    OzScene scene = parse(SMALL, NULL, 0);
    assert_string_equal(scene.name, "small");
    assert_true(scene.contact.friction == 0.3);
    assert_true(scene.contact.tangential_stiffness == 2.0 / 7.0);
    assert_true(scene.contact.tangential_damping == 2.0 / 7.0);
    assert_int_equal(scene.contact.slip, OZ_SLIP_CUT);
    assert_int_equal(scene.contact.contact_point, OZ_POINT_MIDPOINT);
    assert_true(scene.gyroscopic);
    assert_true(scene.gravity[2] == -9.81);
    assert_int_equal(scene.integrator, OZ_INTEGRATOR_SYMPLECTIC_EULER);
    assert_int_equal(scene.precision, OZ_PRECISION_FLOAT);
    assert_int_equal(scene.observe.samples_per_tap, 16);
    assert_true(scene.observe.interval == 0.01);
    assert_true(scene.observe.layer_thickness == 0.004);
    assert_false(scene.movie.present || scene.settle.present);
    assert_int_equal(scene.movie.width, 1280);
    assert_int_equal(scene.movie.view_count, 2);
    assert_int_equal(scene.movie.views[1], OZ_VIEW_CUT);
    oz_scene_free(&scene);
    oz_scene_free(&scene);
}

static void reads_an6(void **state)
{
    (void)state;
    OzScene scene;
    assert_int_equal(oz_scene_load(&scene, ORZO_SCENES "/an6.yaml", NULL, 0), OZ_OK);
    assert_true(scene.period == 1.0 / 30);
    assert_true(scene.duration == 4134 * scene.period);
    assert_true(scene.observe.interval == scene.period);
    assert_true(scene.snapshots.times[1] == 300 * scene.period);
    assert_int_equal(scene.populations[0].count, 1000);
    assert_true(scene.populations[0].fill == 0.15);
    assert_int_equal(scene.integrator, OZ_INTEGRATOR_EULER);
    assert_int_equal(scene.contact.contact_point, OZ_POINT_SURFACES);
    /* A = 2 g / (2 pi 30)^2, to the digits given here. */
    assert_true(fabs(scene.walls[0].motion.amplitude - 5.5220045e-4) < 1e-11);
    assert_true(scene.walls[1].contact.friction == 0.1);
    oz_scene_free(&scene);
}

/* What a scene is, as text; the caller frees it. */
static char *written(const char *path, char *const *settings, int count)
{
    OzScene scene;
    char *text = NULL;
    size_t length = 0;
    if (oz_scene_load(&scene, path, settings, count) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    FILE *file = open_memstream(&text, &length);
    assert_int_equal(oz_scene_write(&scene, file), OZ_OK);
    fclose(file);
    oz_scene_free(&scene);
    return text;
}

static void extends_key_by_key(void **state)
{
    (void)state;
    char *base = written(ORZO_SCENES "/an6.yaml",
                         SETTINGS("contact.restitution=0.1", "title=an3, Pournin et al. 2005"));
    char *other = written(ORZO_SCENES "/an3.yaml", NULL, 0);
    assert_string_equal(base, other);
    free(base);
    free(other);
    base =
        written(ORZO_SCENES "/an6.yaml",
                SETTINGS("grains=[{kind: random, count: 1414, diameter: 0.523e-3, aspect: 2.83}]",
                         "title=an9, Pournin et al. 2005"));
    other = written(ORZO_SCENES "/an9.yaml", NULL, 0);
    assert_string_equal(base, other);
    free(base);
    free(other);
}

static void settings_replace(void **state)
{
    (void)state;
    OzScene scene = parse(SHAKEN, SETTINGS("time.taps=30", "walls.0.motion.amplitude=1e-3",
                                           "contact.friction=0.2", "movie=", "gravity.2=-1.6"));
    assert_true(scene.taps == 30 && scene.duration == 30 * scene.period);
    assert_true(scene.walls[0].motion.amplitude == 1e-3);
    double omega = 2 * acos(-1) * 30;
    assert_true(fabs(scene.walls[0].motion.acceleration_ratio / (1e-3 * omega * omega / 1.6) - 1) <
                1e-14); /* a few roundings */
    assert_true(scene.walls[0].contact.friction == 0.2);
    assert_true(scene.movie.present && scene.movie.speed == 1);
    oz_scene_free(&scene);
    scene = parse(SHAKEN, SETTINGS("time.taps=3", "movie.length=3", "movie=false"));
    assert_false(scene.movie.present);
    oz_scene_free(&scene);
}

static void walls_have_their_own_contact(void **state)
{
    (void)state;
    OzScene scene = parse(SHAKEN "    contact: {restitution: 0.9, tangential_stiffness: 0.5}\n"
                                 "  - {kind: cylinder, diameter: 1}\n",
                          SETTINGS("contact.friction=0.7"));
    const OzContactValues *own = &scene.walls[0].contact, *none = &scene.walls[1].contact;
    assert_true(own->restitution == 0.9 && own->friction == 0.7 && own->contact_time == 1e-3);
    assert_true(own->tangential_stiffness == 0.5 && own->tangential_damping == 0.5);
    assert_memory_equal(none, &scene.contact, sizeof *none);
    oz_scene_free(&scene);
    scene = parse(SHAKEN "    contact: {tangential_stiffness: 0.5}\n",
                  SETTINGS("contact.tangential_damping=0.1"));
    assert_true(scene.walls[0].contact.tangential_damping == 0.1);
    oz_scene_free(&scene);
}

static char *golden_of(const char *path)
{
    char name[256], *text = NULL;
    snprintf(name, sizeof name, "%.*s.expected", (int)(strlen(path) - strlen(".yaml")), path);
    if (oz_file_read(&text, NULL, name) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    text[strcspn(text, "\n") ? strlen(text) - 1 : 0] = '\0';
    return text;
}

static void tells_what_is_wrong(void **state)
{
    (void)state;
    glob_t files;
    assert_int_equal(glob("bad/*.yaml", 0, NULL, &files), 0);
    assert_true(files.gl_pathc >= 25);
    for (size_t i = 0; i < files.gl_pathc; i++) {
        OzScene scene;
        char *golden = golden_of(files.gl_pathv[i]);
        assert_int_equal(oz_scene_load(&scene, files.gl_pathv[i], NULL, 0), OZ_ERR_INPUT);
        assert_string_equal(oz_status_text(), golden);
        free(golden);
    }
    globfree(&files);
}

static void tells_what_is_wrong_with_settings(void **state)
{
    (void)state;
    expect_error(SMALL,
                 "--set contact.friction=much: contact.friction is much; expected a number "
                 "from 0 to 1e6",
                 SETTINGS("contact.friction=much"));
    expect_error(SMALL,
                 "--set contact.fricton=1: unknown key contact.fricton; did you mean "
                 "contact.friction?",
                 SETTINGS("contact.fricton=1"));
    expect_error(SHAKEN,
                 "--set walls.7.kind=plane: walls has no group 7; expected one of its 1, "
                 "counted from 0",
                 SETTINGS("walls.7.kind=plane"));
    expect_error(SHAKEN,
                 "--set walls.=1: walls has no entry ; expected one of its 1, counted from 0",
                 SETTINGS("walls.=1")); /* which once put the list into itself */
    expect_error(SHAKEN,
                 "--set walls..0.kind=plane: walls has no group ; expected one of its 1, "
                 "counted from 0",
                 SETTINGS("walls..0.kind=plane"));
    expect_error(SHAKEN,
                 "--set time.taps=3: time.taps contradicts duration; expected one of the two",
                 SETTINGS("time.duration=3", "time.taps=3"));
    expect_error(SMALL, "--set friction: no key and value; expected --set key=value",
                 SETTINGS("friction"));
    expect_error(SMALL,
                 "--set extends=a.yaml: extends cannot be set; expected it in the scene file",
                 SETTINGS("extends=a.yaml"));
    expect_error(SMALL "seed: x\n",
                 "small.yaml:5: seed is x; expected a whole number from 0 to 9.2e18\n"
                 "--set time.step=0: time.step is 0; expected a number from 1e-12 to 1 s",
                 SETTINGS("time.step=0"));
}

/* The hint says what is missing; where it says another thing, both lines stand. */
static void names_a_misspelt_key_once(void **state)
{
    (void)state;
    static const char head[] = "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                               "contact: {contact_time: 1e-3, restitution: 0.5}\n";
    char text[512];
    snprintf(text, sizeof text, "%sgrains:\n  - {kind: random, cont: 3, diameter: 1}\n%s", head,
             "  - {kind: random, diameter: 1}\n");
    expect_error(text,
                 "small.yaml:5: unknown key grains.0.cont; did you mean grains[].count?\n"
                 "small.yaml:6: grains.1.count is missing; expected a whole number from 0 to 1e18",
                 NULL, 0);
    expect_error("model: rods\ntime: {step: 1e-5, tap: 1}\ngrains: []\n"
                 "contact: {contact_time: 1e-3, restitution: 0.5}\n",
                 "small.yaml:2: unknown key time.tap; did you mean time.taps?", NULL, 0);
}

static void names_corners_as_written(void **state)
{
    (void)state;
    expect_error("model: trigrains\ntime: {step: 1e-6, duration: 1}\ngrains:\n"
                 "  - {kind: random, count: 3, shape: polygon, radius: 1e-3, corners: 4.5}\n",
                 "small.yaml:4: grains.0.corners is 4.5; expected a whole number", NULL, 0);
}

static char *repeat(const char *head, const char *part, size_t count)
{
    size_t length = strlen(part);
    char *text = malloc(strlen(head) + count * length + 1);
    assert_non_null(text);
    strcpy(text, head);
    char *end = text + strlen(head);
    for (size_t i = 0; i < count; i++) {
        memcpy(end + i * length, part, length + 1);
    }
    return text;
}

static void expect_refusal(char *text, const char *message)
{
    OzScene scene;
    assert_int_equal(oz_scene_parse(&scene, "huge.yaml", text, NULL, 0), OZ_ERR_INPUT);
    if (!strstr(oz_status_text(), message)) {
        fail_msg("%.300s", oz_status_text());
    }
    free(text);
}

/* All that walks a tree recurses: a path of 60000 groups once ended the program. */
static void refuses_deep_settings(void **state)
{
    (void)state;
    char *setting = repeat("", "a.", 60000);
    setting[strlen(setting) - 1] = '=';
    OzScene scene;
    assert_int_equal(oz_scene_parse(&scene, "deep.yaml", SMALL, &setting, 1), OZ_ERR_INPUT);
    assert_non_null(strstr(oz_status_text(), ".a....: a.a."));
    assert_non_null(strstr(oz_status_text(), "names more than 32 groups; expected a key"));
    free(setting);
}

static void refuses_huge_files(void **state)
{
    (void)state;
    expect_refusal(repeat("", "# filler\n", 1000000), "huge.yaml:1: the file has 9000000 bytes");
    expect_refusal(repeat("a: ", "[", 100000), "nested deeper than 32");
    expect_refusal(repeat("", "{a: ", 100000), "nested deeper than 32");
    expect_refusal(repeat(SMALL, "seed: 1\n", 100000), "... and 99899 more");
    expect_refusal(repeat(SMALL "title: [", "a, ", 100000), "expected valid YAML");
    expect_refusal(repeat(SMALL "walls:\n", "- {kind: plane}\n", 10001),
                   "walls is a list of 10001");
    char *keys = repeat(SMALL, "k0000: 1\n", 1100);
    for (int i = 0; i < 1100; i++) {
        char *digits = keys + strlen(SMALL) + 9 * (size_t)i + 1;
        digits[0] = (char)('0' + i / 1000), digits[1] = (char)('0' + i / 100 % 10);
        digits[2] = (char)('0' + i / 10 % 10), digits[3] = (char)('0' + i % 10);
    }
    expect_refusal(keys, "more than 1000 keys in one group");
}

static void rows_are_complete(void **state)
{
    (void)state;
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_true(oz_describe_keys(NULL, file));
    fclose(file);
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        for (int model = 0; model < 2; model++) {
            assert_true(!oz_keys_serves(key, model) ||
                        oz_keys_of_kind(key->path, model, key->kinds) == key);
        }
        assert_non_null(key->help);
        assert_non_null(key->unit);
        assert_true(!key->rival || key->write != OZ_WRITE_ALWAYS);
        assert_true(!key->inherits || oz_keys_find(key->inherits));
        assert_non_null(strstr(text, key->path));
        bool has_default = key->fallback || key->fallback_help || key->inherits;
        assert_false(has_default && key->required);
    }
    free(text);
    assert_string_equal(oz_keys_choice_name("integrator", OZ_INTEGRATOR_VELOCITY_VERLET),
                        "velocity-verlet");
    assert_string_equal(oz_keys_choice_name("integrator", OZ_INTEGRATOR_GEAR4), "gear4");
    assert_string_equal(oz_keys_choice_name("integrator", 99), "?");
    assert_string_equal(oz_keys_choice_name("seed", 0), "?");
}

/* The words between two headings, or after the last. */
static const char *section(char *text, const char *heading, const char *next)
{
    char *start = strstr(text, heading), *end = next ? strstr(text, next) : NULL;
    assert_non_null(start);
    if (end) {
        end[-1] = '\0';
    }
    return start;
}

static void lists_each_key_once_by_model(void **state)
{
    (void)state;
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_true(oz_describe_keys(NULL, file));
    fclose(file);
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        char line[128];
        snprintf(line, sizeof line, "\n%s\n", key->path);
        const char *found = strstr(text, line);
        assert_non_null(found);
        assert_null(strstr(found + 1, line));
    }
    const char *flat = section(text, "== only of model trigrains\n", NULL);
    const char *solid = section(text, "== only of model rods\n", "== only of model trigrains\n");
    const char *all = section(text, "== of every model\n", "== only of model rods\n");
    assert_true(strstr(all, "\nseed\n") && strstr(solid, "\ngyroscopic\n") &&
                strstr(flat, "\nbeams.stiffness\n"));
    assert_non_null(strstr(all, "\ngravity\n    acceleration of free fall\n"
                                "    model rods: a list of 3 numbers from -1e6 to 1e6 m/s^2; "
                                "default [0, 0, -9.81]\n"
                                "    model trigrains: a list of 2 numbers from -1e6 to 1e6 m/s^2; "
                                "default [0, -9.81]\n"));
    assert_non_null(strstr(all, "\nintegrator\n    model rods: how a step is made\n"
                                "        one of euler, "));
    free(text);
}

/* What `orzo keys PART` prints of one part; NULL when nothing holds it. The caller frees it. */
static char *keys_of(const char *part)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    bool any = oz_describe_keys(part, file);
    fclose(file);
    if (!any) {
        free(text);
        text = NULL;
    }
    return text;
}

static void finds_keys_by_path_else_by_text(void **state)
{
    (void)state;
    char *contact = keys_of("contact."), *drum = keys_of("Drum");
    assert_non_null(strstr(contact, "\ncontact.friction\n"));
    assert_null(strstr(contact, "\ngravity\n"));
    assert_non_null(strstr(drum, "walls[].kind\n")); /* no path holds drum */
    assert_null(strstr(drum, "\ngravity\n"));
    assert_null(keys_of("no such word"));
    free(contact);
    free(drum);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fills_in_defaults),
        cmocka_unit_test(reads_an6),
        cmocka_unit_test(extends_key_by_key),
        cmocka_unit_test(settings_replace),
        cmocka_unit_test(walls_have_their_own_contact),
        cmocka_unit_test(tells_what_is_wrong),
        cmocka_unit_test(tells_what_is_wrong_with_settings),
        cmocka_unit_test(names_a_misspelt_key_once),
        cmocka_unit_test(names_corners_as_written),
        cmocka_unit_test(refuses_huge_files),
        cmocka_unit_test(refuses_deep_settings),
        cmocka_unit_test(rows_are_complete),
        cmocka_unit_test(lists_each_key_once_by_model),
        cmocka_unit_test(finds_keys_by_path_else_by_text),
    };
    if (chdir(ORZO_TESTS) != 0) {
        return 1;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
