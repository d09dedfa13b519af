/* The sweep of a scene: its combinations, and what is told of a wrong one. */
#include "scene_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A sweep is keys and their values; whatever else stands there is named. */
static void tells_what_is_wrong_with_a_sweep(void **state)
{
    (void)state;
    expect_error(SMALL "sweep: {contact.friction: 0.3}\n",
                 "small.yaml:5: sweep of contact.friction is 0.3; expected a list of 1 to 100000 "
                 "values, as in {contact.friction: [0.1, 0.2]}",
                 NULL, 0);
    expect_error(SMALL "sweep: {contact.friction: []}\n",
                 "small.yaml:5: sweep of contact.friction is a list of 0; expected a list of 1 to "
                 "100000 values, as in {contact.friction: [0.1, 0.2]}",
                 NULL, 0);
    expect_error(SMALL "sweep: contact.friction\n",
                 "small.yaml:5: sweep is contact.friction; expected 1 to 16 keys, each with a list "
                 "of values, as in {contact.friction: [0.1, 0.2]}",
                 NULL, 0);
    expect_error(
        SMALL "sweep: {zip: true}\n",
        "small.yaml:5: sweep is a group of 0 keys; expected 1 to 16 keys, each with a list "
        "of values, as in {contact.friction: [0.1, 0.2]}",
        NULL, 0);
    expect_error(SMALL "sweep:\n  contact.friction: [0.1, 0.2]\n  contact.fricton: [1]\n",
                 "small.yaml:7: sweep of an unknown key contact.fricton; did you mean "
                 "contact.friction?",
                 NULL, 0);
    expect_error(SMALL "sweep: {contact.friction: [0.1, 0.1], seed: [1, 2]}\n",
                 "small.yaml:5: 0.1 comes twice in the sweep; expected different values", NULL, 0);
    expect_error(SMALL "sweep: {contact.friction: [0.1, 0.2], seed: [1, 2, 3], zip: true}\n",
                 "small.yaml:5: sweep of contact.friction has 2 values and of seed 3; expected as "
                 "many for each with zip",
                 NULL, 0);
    expect_error(SMALL "sweep: {contact.friction: [0.1], zip: 3}\n",
                 "small.yaml:5: sweep.zip is 3; expected true or false", NULL, 0);
}

static void expect_combinations(const char *sweep, const char *key, const char *const *values,
                                int count)
{
    char text[512];
    snprintf(text, sizeof text, "%ssweep: %s\n", SMALL, sweep);
    OzScene scene = parse(text, NULL, 0);
    assert_string_equal(scene.sweep.key, key);
    assert_int_equal(scene.sweep.count, count);
    for (int i = 0; i < count; i++) {
        assert_string_equal(scene.sweep.values[i], values[i]);
    }
    oz_scene_free(&scene);
}

/* Every value with every other, the last key's fastest; or in step. */
static void combines_the_values_of_a_sweep(void **state)
{
    (void)state;
    expect_combinations(
        "{contact.friction: [0.1, 0.2], contact.restitution: [0.3, 0.5, 0.7], seed: [4]}",
        "contact.friction,contact.restitution,seed",
        (const char *[]){"0.1,0.3,4", "0.1,0.5,4", "0.1,0.7,4", "0.2,0.3,4", "0.2,0.5,4",
                         "0.2,0.7,4"},
        6);
    expect_combinations("{contact.friction: [0.1, 0.1, 0.2], seed: [4, 5, 4], zip: true}",
                        "contact.friction,seed", (const char *[]){"0.1,4", "0.1,5", "0.2,4"}, 3);
    expect_combinations("{contact.friction: [0.1, 0.2], zip: false}", "contact.friction",
                        (const char *[]){"0.1", "0.2"}, 2);
}

/* 400 x 400 folders are a slip of the hand. */
static void refuses_too_many_combinations(void **state)
{
    (void)state;
    char text[8192], *end = text + sprintf(text, SMALL "sweep: {");
    static const char *const keys[] = {"contact.friction: [", "seed: ["};
    for (int k = 0; k < 2; k++) {
        end += sprintf(end, "%s", keys[k]);
        for (int i = 0; i < 400; i++) {
            end += sprintf(end, "%d, ", i);
        }
        end += sprintf(end, "], ");
    }
    sprintf(end, "}\n");
    expect_error(text, "small.yaml:5: sweep has 160000 combinations; expected at most 100000", NULL,
                 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tells_what_is_wrong_with_a_sweep),
        cmocka_unit_test(combines_the_values_of_a_sweep),
        cmocka_unit_test(refuses_too_many_combinations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
