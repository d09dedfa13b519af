/* Small scenes as texts, loaded or refused. */
#ifndef OZ_TESTS_SCENE_TEXT_H
#define OZ_TESTS_SCENE_TEXT_H

#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

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

static inline OzScene parse(const char *text, char *const *settings, int count)
{
    OzScene scene;
    if (oz_scene_parse(&scene, "scenes/small.yaml", text, settings, count) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return scene;
}

static inline void expect_error(const char *text, const char *message, char *const *settings,
                                int count)
{
    OzScene scene;
    assert_int_equal(oz_scene_parse(&scene, "small.yaml", text, settings, count), OZ_ERR_INPUT);
    assert_string_equal(oz_status_text(), message);
    assert_null(scene.name);
}

#endif
