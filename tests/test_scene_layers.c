/* Scenes over scenes and settings over both: what `false` leaves out, what replaces what. */
#include "scene_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The keys of an6 with others over them, as in a file beside it. */
static OzScene parse_beside_an6(const char *text, char *const *settings, int count)
{
    OzScene scene;
    if (oz_scene_parse(&scene, ORZO_SCENES "/mine.yaml", text, settings, count) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return scene;
}

/* `false` leaves out what a scene can do without, whoever wrote it. */
static void leaves_out_what_is_false(void **state)
{
    (void)state;
    static const char full[] =
        SHAKEN "    contact: {friction: 0.1}\n"
               "  - {kind: plane, normal: [0, 0, -1], point: [0, 0, 1]}\n"
               "title: full\nskin: 1e-4\nsettle: {drag: 70}\nmovie: {length: 3}\n"
               "snapshots: {taps: [1]}\nsweep: {seed: [1, 2]}\nobserve: {interval_taps: 2}\n";
    OzScene scene = parse(full, SETTINGS("snapshots=false", "sweep=false", "title=false",
                                         "skin=false", "settle=false", "movie=false",
                                         "observe.interval_taps=false", "walls.0.contact=false"));
    assert_int_equal(scene.snapshots.count + scene.snapshots.tap_count + scene.sweep.count, 0);
    assert_true(!scene.title && scene.skin == 0);
    assert_false(scene.settle.present || scene.movie.present);
    assert_true(scene.observe.interval == scene.period);
    assert_true(scene.walls[0].contact.friction == 0.3);
    oz_scene_free(&scene);
    scene = parse(full, SETTINGS("walls.0.motion=false", "snapshots.taps=false",
                                 "observe.interval_taps=false"));
    assert_false(scene.walls[0].motion.present);
    oz_scene_free(&scene);
    scene = parse(full, SETTINGS("walls.1=false"));
    assert_int_equal(scene.wall_count, 1);
    assert_true(scene.walls[0].motion.present);
    oz_scene_free(&scene);
    scene = parse(SMALL "walls:\n  - kind: plane\n", SETTINGS("walls=false"));
    assert_int_equal(scene.wall_count, 0);
    oz_scene_free(&scene);
    scene = parse_beside_an6("extends: an6.yaml\nsnapshots: false\nmovie: false\n", NULL, 0);
    assert_int_equal(scene.snapshots.count, 0);
    assert_false(scene.movie.present);
    assert_true(scene.settle.present && scene.taps == 4134);
    oz_scene_free(&scene);
}

/* It takes nothing else with it: neither what says the same otherwise, nor what is set below it
 * later. */
static void leaves_out_nothing_else(void **state)
{
    (void)state;
    OzScene scene =
        parse_beside_an6("extends: an6.yaml\ntime: {taps: false, duration: 0.5}\n", NULL, 0);
    assert_true(scene.taps == 0 && scene.duration == 0.5);
    oz_scene_free(&scene);
    scene =
        parse_beside_an6("extends: an6.yaml\n", SETTINGS("time.duration=0.5", "time.taps=false"));
    assert_true(scene.taps == 0 && scene.duration == 0.5);
    oz_scene_free(&scene);
    scene = parse_beside_an6("extends: an6.yaml\nsnapshots: false\n",
                             SETTINGS("snapshots.times=[0.1]", "title='false'"));
    assert_int_equal(scene.snapshots.count, 1);
    assert_string_equal(scene.title, "false");
    oz_scene_free(&scene);
    expect_error(SMALL,
                 "--set contact.friction=false: contact.friction is false; expected a number from "
                 "0 to 1e6",
                 SETTINGS("contact.friction=false"));
    expect_error(SMALL,
                 "--set time.step=false: time.step is false; expected a number from 1e-12 to 1 s\n"
                 "--set observe=false: observe is false; expected a group of keys\n"
                 "--set contact=false: contact is false; expected a group of keys",
                 SETTINGS("time.step=false", "observe=false", "contact=false"));
}

/* A sweep over another is not added to it. */
static void replaces_an_inherited_sweep(void **state)
{
    (void)state;
    char base[] = "/tmp/orzo_scene_XXXXXX", text[128];
    int file = mkstemp(base);
    const char *inherited = SMALL "sweep: {contact.friction: [0.1, 0.2]}\n";
    assert_int_equal(write(file, inherited, strlen(inherited)), strlen(inherited));
    close(file);
    snprintf(text, sizeof text, "extends: %s\nsweep: {seed: [1, 2, 3]}\n", base);
    OzScene scene = parse(text, NULL, 0);
    assert_string_equal(scene.sweep.key, "seed");
    assert_int_equal(scene.sweep.count, 3);
    oz_scene_free(&scene);
    snprintf(text, sizeof text, "extends: %s\nsweep: false\n", base);
    scene = parse(text, NULL, 0);
    assert_int_equal(scene.sweep.count, 0);
    oz_scene_free(&scene);
    unlink(base);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leaves_out_what_is_false),
        cmocka_unit_test(leaves_out_nothing_else),
        cmocka_unit_test(replaces_an_inherited_sweep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
