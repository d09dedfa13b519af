/* A state that is no number stops a run, whichever of its words it is, on the device in both
 * precisions and in the host reference, and is never written as a result. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "hand_bed.h"
#include "observe/final.h"
#include "sim/element_reference.h"
#include "sim/sim.h"

/* The features of test_scale.c's beds, whose kernels serve here too. */
static const char rods[] =
    "model: rods\n"
    "precision: %s\n"
    "gravity: [0, 0, 0]\n"
    "time: {step: 1e-5, duration: 1}\n"
    "contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.3}\n"
    "grains:\n"
    "  - {kind: single, diameter: 1e-3, aspect: 3, position: [0, 0, 1e-2]}\n"
    "  - {kind: single, diameter: 2e-3, aspect: 0, position: [9e-3, 0, 1e-2]}\n"
    "walls:\n"
    "  - {kind: plane}\n";

static const char elements[] =
    "model: trigrains\n"
    "precision: %s\n"
    "gravity: [0, 0]\n"
    "time: {step: 1e-6, duration: 1}\n"
    "grains:\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [0, 5e-3]}\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [9e-3, 5e-3]}\n"
    "walls:\n"
    "  - {kind: vessel, width: 4e-2, height: 2e-2, motion: {frequency: 1, "
    "amplitude: 1e-4}}\n";

static const char *const precisions[] = {"float", "double"};

/* The words of grain 0 of a bed; NULL beyond the last. In single precision a place is an integer
 * and cannot be none. */
static double *rod_word(OzGrains *grains, int k, bool is_float)
{
    double *const words[] = {grains->velocity,       grains->angular_velocity, grains->quaternion,
                             grains->quaternion + 3, grains->position,         NULL};
    return k == 4 && is_float ? NULL : words[k];
}

static double *element_word(OzGrains *grains, int k, bool is_float)
{
    double *const words[] = {grains->elements->velocity, grains->elements->angular_velocity,
                             grains->elements->angle, grains->elements->position + 1, NULL};
    (void)is_float;
    return words[k];
}

/* That the device stops in the first steps for what is no number, and says so. */
static void assert_device_stops(Rig *rig)
{
    OzSim *sim = NULL;
    OzMember member = {&rig->scene, &rig->grains};
    OzStatus status = oz_sim_create(&sim, &rig_device, &member, 1, NULL);
    if (status == OZ_OK) {
        status = oz_sim_advance(sim, 2);
    }
    assert_int_equal(status, OZ_ERR_BLOWUP);
    assert_non_null(strstr(oz_status_text(), "not a number"));
    oz_sim_free(sim);
}

static void assert_rods_reference_stops(Rig *rig)
{
    OzReference *reference;
    must(oz_reference_create(&reference, &rig->scene, &rig->grains));
    assert_int_equal(oz_reference_advance(reference, 2), OZ_ERR_BLOWUP);
    oz_reference_free(reference);
}

static void assert_elements_reference_stops(Rig *rig)
{
    OzElementReference *reference;
    must(oz_element_reference_create(&reference, &rig->scene, &rig->grains));
    assert_int_equal(oz_element_reference_advance(reference, 2), OZ_ERR_BLOWUP);
    oz_element_reference_free(reference);
}

/* Puts a NaN into one word after the other. */
static void try_words(const char *scene, double *(*word_of)(OzGrains *grains, int k, bool is_float),
                      void (*assert_reference_stops)(Rig *rig))
{
    for (int p = 0; p < 2; p++) {
        bool more = true;
        for (int k = 0; more; k++) {
            Rig rig;
            rig_open(&rig, scene, precisions[p]);
            double *word = word_of(&rig.grains, k, p == 0);
            more = word != NULL;
            if (more) {
                *word = NAN;
                assert_device_stops(&rig);
                assert_reference_stops(&rig);
            }
            rig_close(&rig);
        }
    }
}

static void test_rods(void **state)
{
    (void)state;
    try_words(rods, rod_word, assert_rods_reference_stops);
}

static void test_trigrains(void **state)
{
    (void)state;
    try_words(elements, element_word, assert_elements_reference_stops);
}

/* No file is left, under either name. */
static void test_never_written(void **state)
{
    Bed bed;
    (void)state;
    bed_create(&bed, 3, 1e-3, 2e-3);
    fill_randomly(&bed);
    bed.snapshot.angular_velocity[4] = NAN;
    assert_int_equal(oz_final_write(&bed.snapshot, in_folder("final.csv")), OZ_ERR_BLOWUP);
    assert_non_null(strstr(oz_status_text(), "grain 1"));
    assert_null(fopen(in_folder("final.csv"), "r"));
    assert_null(fopen(in_folder("final.csv.part"), "r"));
    bed_free(&bed);
}

static int open_all(void **state)
{
    return make_folder(state) == 0 ? open_rig_device(state) : -1;
}

static int close_all(void **state)
{
    static const char *const files[] = {NULL};
    return close_rig_device(state) + remove_folder(files);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rods),
        cmocka_unit_test(test_trigrains),
        cmocka_unit_test(test_never_written),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
