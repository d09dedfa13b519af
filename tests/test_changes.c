/* What differs between two scenes, in words, and what of it cannot be while one of them runs. */
#include "scene/changes.h"
#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char text[] = "model: rods\n"
                           "time: {step: 1e-5, taps: 4}\n"
                           "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\n"
                           "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 1e-2]}]\n"
                           "walls:\n"
                           "  - {kind: plane, motion: {frequency: 25, acceleration_ratio: 2}}\n"
                           "  - {kind: cylinder, diameter: 5e-2, contact: {friction: 0.1}}\n";

static void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

static OzScene running;

static int open_running(void **state)
{
    (void)state;
    return oz_scene_parse(&running, "running.yaml", text, NULL, 0) == OZ_OK ? 0 : -1;
}

static int close_running(void **state)
{
    (void)state;
    oz_scene_free(&running);
    return 0;
}

/* The changes that settings make, as "path: old -> now" lines; and that the running scene with
 * these changes as its settings is the scene that was asked for. */
static void assert_changes(const char *expected, char *const *settings, int count)
{
    OzScene next, again;
    OzChanges changes, none;
    char told[1024] = "", **own = NULL;
    must(oz_scene_parse(&next, "running.yaml", text, settings, count));
    must(oz_changes_find(&changes, &running, &next));
    for (int i = 0; i < changes.count; i++) {
        const OzChange *c = &changes.rows[i];
        size_t used = strlen(told);
        snprintf(told + used, sizeof told - used, "%s: %s -> %s\n", c->path, c->old, c->now);
    }
    assert_string_equal(told, expected);
    must(oz_changes_settings(&own, &changes));
    must(oz_scene_change(&again, &running, own, changes.count));
    must(oz_changes_find(&none, &again, &next));
    assert_int_equal(none.count, 0);
    for (int i = 0; i < changes.count; i++) {
        free(own[i]);
    }
    free(own);
    oz_changes_free(&changes);
    oz_changes_free(&none);
    oz_scene_free(&next);
    oz_scene_free(&again);
}

#define ASSERT_CHANGES(expected, ...)                                                              \
    do {                                                                                           \
        char *settings[] = {__VA_ARGS__};                                                          \
        assert_changes(expected, settings, sizeof settings / sizeof *settings);                    \
    } while (0)

/* A wall that takes the scene's value follows without a word; one with its own value does not. Of
 * two rivals one goes and the other comes. */
static void test_found(void **state)
{
    (void)state;
    ASSERT_CHANGES("", "contact.friction=0.4");
    ASSERT_CHANGES("contact.friction: 0.4 -> 0.3\n", "contact.friction=0.3");
    ASSERT_CHANGES("contact.friction: 0.4 -> 0.1\nwalls.1.contact.friction: 0.1 -> 0.2\n",
                   "contact.friction=0.1", "walls.1.contact.friction=0.2");
    ASSERT_CHANGES("time.duration:  -> 0.5\ntime.taps: 4 -> \n", "time.duration=0.5");
    ASSERT_CHANGES("walls.0.motion.acceleration_ratio: 2 -> \n"
                   "walls.0.motion.amplitude:  -> 0.001\n",
                   "walls.0.motion.amplitude=1e-3");
    ASSERT_CHANGES("gravity: [0, 0, -9.81] -> [0, 0, -20]\n", "gravity.2=-20");
    ASSERT_CHANGES("title:  -> \"a: b\"\n", "title=\"a: b\"");
}

/* Another law has other keys: those of the old one go. */
static void test_law(void **state)
{
    (void)state;
    OzScene next;
    char *settings[] = {"contact.law=hertz",
                        "contact.hertz_stiffness=1e6",
                        "contact.normal_damping_rate=500",
                        "contact.tangential_damping_rate=100",
                        "-contact.contact_time",
                        "-contact.restitution"};
    must(oz_scene_change(&next, &running, settings, 6));
    assert_int_equal(next.contact.law, OZ_LAW_HERTZ);
    oz_scene_free(&next);
    assert_int_equal(oz_scene_change(&next, &running, settings, 5), OZ_ERR_INPUT);
}

static void assert_refused(const char *setting, const char *expected)
{
    OzScene next;
    char *settings[] = {(char *)(uintptr_t)setting};
    assert_int_equal(oz_scene_change(&next, &running, settings, 1), OZ_ERR_INPUT);
    assert_string_equal(oz_status_text(), expected);
}

static void test_refused(void **state)
{
    (void)state;
    assert_refused("precision=double", "--set precision=double: precision runs with float, which "
                                       "cannot change: the grains' state is kept in it");
    assert_refused("grains.0.diameter=2e-3",
                   "--set grains.0.diameter=2e-3: grains.0.diameter runs with 0.001, which cannot "
                   "change: grains are made before the first step");
    assert_refused(
        "walls=[{kind: plane, motion: {frequency: 25, acceleration_ratio: 2}}]",
        "--set walls=[{kind: plane, motion: {frequency: 25, acceleration_ratio: 2}}]: "
        "walls has 1 entries and runs with 2, which cannot change: walls are made before "
        "the first step, and one that jumped would throw grains");
    assert_refused("contact.friction=-1",
                   "--set contact.friction=-1: contact.friction is -1; expected a number from 0 to "
                   "1e6");
}

/* File and line of what was refused. */
static void test_refused_at_its_line(void **state)
{
    (void)state;
    char path[] = "/tmp/orzo-changes-XXXXXX", expected[256];
    int file = mkstemp(path);
    OzScene next;
    assert_true(file >= 0 && write(file, "seed: 2\n", 8) == 8 &&
                write(file, text, sizeof text - 1) == (ssize_t)(sizeof text - 1));
    close(file);
    assert_int_equal(oz_scene_reload(&next, &running, path, NULL, 0), OZ_ERR_INPUT);
    snprintf(expected, sizeof expected,
             "%s:1: seed runs with 1, which cannot change: its numbers have been drawn", path);
    assert_string_equal(oz_status_text(), expected);
    unlink(path);
}

/* Swept keys are the members' own. */
static void test_swept(void **state)
{
    (void)state;
    OzScene swept, next;
    char *settings[] = {"sweep={contact.friction: [0.1, 0.2]}", "contact.friction=0.3"};
    must(oz_scene_parse(&swept, "running.yaml", text, settings, 1));
    char path[] = "/tmp/orzo-changes-XXXXXX";
    int file = mkstemp(path);
    assert_true(write(file, text, sizeof text - 1) == (ssize_t)(sizeof text - 1));
    close(file);
    assert_int_equal(oz_scene_reload(&next, &swept, path, settings, 2), OZ_ERR_INPUT);
    assert_string_equal(oz_status_text(),
                        "--set contact.friction=0.3: contact.friction runs with 0.4, which cannot "
                        "change: members differ in it");
    must(oz_scene_reload(&next, &swept, path, settings, 1));
    oz_scene_free(&next);
    oz_scene_free(&swept);
    unlink(path);
}

/* A copy shares nothing: it outlives the scene, and says the same. */
static void test_copy(void **state)
{
    (void)state;
    OzScene scene, copy;
    OzChanges changes;
    char *settings[] = {"title=t", "snapshots={taps: [1, 2]}"};
    must(oz_scene_parse(&scene, "running.yaml", text, settings, 2));
    must(oz_scene_copy(&copy, &scene));
    must(oz_changes_find(&changes, &copy, &scene));
    assert_int_equal(changes.count, 0);
    oz_scene_free(&scene);
    assert_string_equal(copy.title, "t");
    assert_true(copy.snapshots.times[1] == 2.0 / 25);
    assert_true(copy.walls[1].diameter == 5e-2);
    oz_scene_free(&copy);
}

/* Rows of the other model are nobody's. */
static void test_trigrains(void **state)
{
    (void)state;
    OzScene one, other;
    OzChanges changes;
    const char *dice = "model: trigrains\ntime: {step: 1e-6, duration: 1}\n"
                       "grains: [{kind: single, shape: square, edge: 1e-3, position: [0, 1]}]\n"
                       "walls: [{kind: drum, diameter: 5, motion: {angular_velocity: 2}}]\n"
                       "movie: {}\nsnapshots: {times: [0.5]}\n";
    char *settings[] = {"walls.0.motion.angular_velocity=3", "beams.damping=0.01"};
    must(oz_scene_parse(&one, "dice.yaml", dice, NULL, 0));
    must(oz_scene_change(&other, &one, settings, 2));
    must(oz_changes_find(&changes, &one, &other));
    assert_int_equal(changes.count, 2);
    assert_string_equal(changes.rows[0].path, "beams.damping");
    assert_string_equal(changes.rows[1].now, "3");
    oz_changes_free(&changes);
    oz_scene_free(&one);
    oz_scene_free(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_found),     cmocka_unit_test(test_law),
        cmocka_unit_test(test_refused),   cmocka_unit_test(test_refused_at_its_line),
        cmocka_unit_test(test_swept),     cmocka_unit_test(test_copy),
        cmocka_unit_test(test_trigrains),
    };
    return cmocka_run_group_tests(tests, open_running, close_running);
}
