/* How far beams go in a hit: against what energy allows, and what `check` makes of it. */
#include "rig.h"

#include "command/inspect_elements.h"
#include "sim/trial.h"

#include <glob.h>
#include <stdlib.h>

/* L-shaped grains, whose beams are soft unless told otherwise, poured into a vessel. */
static const char ells[] =
    "model: trigrains\ntime: {step: 1.5e-6, duration: 0.5}\nbeams: {second_moment: %g, damping: "
    "%g}\n"
    "grains:\n  - {kind: random, count: 60, shape: vertices,\n"
    "     vertices: [0,0, 5e-3,0, 5e-3,2e-3, 2e-3,2e-3, 2e-3,5e-3, 0,5e-3]}\n"
    "walls:\n  - {kind: vessel, width: 40e-3, height: 50e-3}\n";

static OzTrial trial_of(double second_moment, double speed)
{
    Rig rig;
    OzTrial trial;
    rig_open(&rig, ells, second_moment, 0.0);
    must(oz_trial_hit(&trial, &rig.scene, &rig.grains, 0, speed));
    rig_close(&rig);
    return trial;
}

/* A beam's bending energy 2 E I / L (a^2 + a b + b^2) is at least 3/2 E I / L a^2, and all of it at
 * most the grain's m v^2 / 2: so a <= v sqrt(m L / (3 E I)). A hit that is any use as an estimate
 * comes within a fifth of that; so for the stretch, sqrt(m / E) v / L. */
static void test_bending_is_what_energy_allows(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, ells, 1e-10, 0.0);
    const OzElements *p = rig.grains.elements;
    double longest = 0, shortest = INFINITY, speed = 0.2, mass = rig.grains.mass[0];
    for (int64_t k = 0; k < p->beam_count; k++) {
        longest = fmax(longest, p->beam_length[k]);
        shortest = fmin(shortest, p->beam_length[k]);
    }
    OzTrial trial = trial_of(1e-10, speed);
    double most = speed * sqrt(mass * longest / (3 * 100 * 1e-10));
    double stretch = speed * sqrt(mass / 100) / shortest;
    print_message("bend %.3g of at most %.3g rad, stretch %.3g of %.3g\n", trial.bend, most,
                  trial.stretch, stretch);
    assert_true(trial.bend < most && trial.bend > most / 5);
    assert_true(trial.stretch < stretch && trial.stretch > stretch / 5);
    assert_false(trial.deep);
    rig_close(&rig);
}

/* Beams are linear: bending grows with speed, within a quarter, since contacts are not. Past the
 * guard's limit the figures come from a slower hit. A second moment four times as large halves it
 * at least (what is advised by that is on the safe side): contacts and beams' lengths then take a
 * larger part of the energy. */
static void test_bending_scales(void **state)
{
    (void)state;
    double slow = trial_of(1e-10, 0.1).bend, fast = trial_of(1e-10, 0.2).bend;
    double faster = trial_of(1e-10, 3).bend, stiff = trial_of(4e-10, 0.2).bend;
    print_message("%.3g, %.3g, %.3g rad; four times as stiff %.3g\n", slow, fast, faster, stiff);
    /* contacts are not linear: by 2 % here */
    assert_true(fabs(fast / slow / 2 - 1) < 0.05);
    assert_true(faster > 1 && fabs(faster / slow / 30 - 1) < 0.05);
    assert_true(stiff < 0.5 * fast && stiff > 0.25 * fast);
}

/* What `check` prints of a scene that is loaded, in memory that the caller frees. */
static char *print_check(const Rig *rig)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_non_null(file);
    must(oz_inspect_elements_warn(file, &rig->scene, &rig->grains));
    must(oz_inspect_elements_print(file, &rig->scene, &rig->grains));
    assert_int_equal(fclose(file), 0);
    return text;
}

static void test_check_warns_of_soft_beams(void **state)
{
    (void)state;
    Rig rig;
    double advised = 0;
    rig_open(&rig, ells, 1e-10, 9e-3);
    char *text = print_check(&rig);
    const char *advice = strstr(text, "beams are too soft");
    assert_non_null(advice);
    assert_int_equal(
        sscanf(strstr(advice, "beams.second_moment "), "beams.second_moment %lf", &advised), 1);
    free(text);
    rig_close(&rig);
    rig_open(&rig, ells, advised, 9e-3);
    text = print_check(&rig);
    assert_non_null(strstr(text, "beams              a hit at"));
    assert_null(strstr(text, "too soft"));
    free(text);
    rig_close(&rig);
}

static void test_no_word_about_the_scenes_that_run(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob(ORZO_SCENES "/*.yaml", 0, NULL, &found), 0);
    for (size_t k = 0; k < found.gl_pathc; k++) {
        Rig rig = {0};
        must(oz_scene_load(&rig.scene, found.gl_pathv[k], NULL, 0));
        if (rig.scene.model == OZ_MODEL_TRIGRAINS) {
            must(oz_insert_grains(&rig.grains, &rig.scene));
            char *text = print_check(&rig);
            if (strstr(text, "too soft")) {
                fail_msg("%s: %s", found.gl_pathv[k], strstr(text, "beams are"));
            }
            free(text);
        }
        rig_close(&rig);
    }
    globfree(&found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bending_is_what_energy_allows),
        cmocka_unit_test(test_bending_scales),
        cmocka_unit_test(test_check_warns_of_soft_beams),
        cmocka_unit_test(test_no_word_about_the_scenes_that_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
