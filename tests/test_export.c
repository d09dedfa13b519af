/* `orzo export`, and `export` of a scene: what is written, what is refused, what a killed run
 * leaves. That readers understand the files is tests/export.sh's to try.
 * ORZO_NEEDS_DEVICE. */
#include "program.h"

static const char scene[] = "model: rods\n"
                            "time: {step: 1e-4, duration: 0.1}\n"
                            "contact: {contact_time: 5e-3, restitution: 0.5}\n"
                            "grains:\n"
                            "  - {kind: single, diameter: 1e-3, position: [0, 0, 2e-3]}\n"
                            "  - {kind: single, diameter: 1e-3, position: [0, 0, 4e-3]}\n"
                            "walls: [{kind: plane}]\n"
                            "observe: {interval: 0.02}\n"
                            "export: [csv, xyz]\n";

static int begin(void **state)
{
    int status = enter_work(state);
    write_file("scene.yaml", "%s", scene);
    return status;
}

/* Without an interval an export has the rows' moments: 0, 0.02, ... 0.1 s. */
static void a_run_exports(void **state)
{
    (void)state;
    expect(0, "6 frames exported into run/export", "run scene.yaml -o run");
    assert_true(is_there("run/export/grains_00005.csv"));
    assert_true(is_there("run/export/contacts_00005.csv"));
    assert_false(is_there("run/export/grains_00006.csv"));
    assert_false(is_there("run/export/grains.pvd")); /* not asked for */
    assert_int_equal(count_lines("run/export/frames.csv"), 1 + 6);
    assert_int_equal(count_lines("run/export/grains.xyz"), 6 * (2 + 2));
    expect(0, "3 frames exported into run/export",
           "run scene.yaml -o run --overwrite --set export_interval=0.05");
    assert_false(is_there("run/export/grains_00003.csv")); /* what is replaced is gone */
}

static void a_folder_is_exported(void **state)
{
    (void)state;
    assert_int_equal(orzo("run scene.yaml -o again --overwrite"), 0);
    expect(0, "3 frames exported into other", "export again --to vtk,h5md --every 2 -o other");
    assert_true(is_there("other/grains.pvd") && is_there("other/grains_00002.vtp"));
    assert_true(is_there("other/contacts.pvd") && is_there("other/walls_00000.vtp"));
    assert_true(is_there("other/grains.h5") && !is_there("other/grains.xyz"));
    expect(0, "6 frames", "export again --to csv -o other");
    assert_true(is_there("other/grains.pvd") && is_there("other/grains_00005.csv"));
    expect(0, "2 frames", "export again --to csv --every 5 -o other");
    assert_true(is_there("other/grains.pvd")); /* an export replaces its own formats alone */
    assert_true(is_there("other/grains_00001.csv") && !is_there("other/grains_00002.csv"));
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    assert_int_equal(orzo("run scene.yaml -o kept --overwrite"), 0);
    expect(2, "--to pdf' is wrong; expected vtk, xyz, h5md or csv", "export kept --to pdf");
    expect(2, "each once", "export kept --to csv,csv");
    expect(2, "--to is missing", "export kept");
    expect(2, "--every with a whole number above 0", "export kept --to csv --every 0");
    expect(2, "nowhere/scene.yaml", "export nowhere --to csv");
    expect(2, "scene.yaml is a file; expected the folder that a run has left",
           "export scene.yaml --to csv");
    expect(2, "scene.yaml is a file; expected the folder that a run has left", "draw scene.yaml");
    assert_int_equal(mkdir("mine", 0777), 0);
    write_file("mine/grains.xyz", "a user's own\n");
    expect(2, "grains.xyz", "export kept --to xyz -o mine");
    assert_true(contains("mine/grains.xyz", "a user's own"));
    expect(2, "export is pdf; expected", "run scene.yaml -o no --set export=pdf");
    expect(2, "names a format twice", "run scene.yaml -o no --set export=[csv,csv]");
    expect(2, "export_interval without export",
           "run scene.yaml -o no --set export=false "
           "--set export_interval=0.1");
}

/* What a run exports once it was resumed is what a straight one exports. */
static void a_resumed_run_exports(void **state)
{
    (void)state;
    assert_int_equal(orzo("run scene.yaml -o straight"), 0);
    assert_int_equal(orzo("run scene.yaml -o two --until 0.05"), 0);
    expect(0, "6 frames exported", "resume two");
    assert_true(same_files("straight/export/grains.xyz", "two/export/grains.xyz"));
    assert_true(same_files("straight/export/contacts_00005.csv", "two/export/contacts_00005.csv"));
}

/* Every wall has its surface: six faces, a belt of 64 with two lids, 32 belts of 64. */
static void all_walls_are_exported(void **state)
{
    (void)state;
    write_file("walls.yaml",
               "model: rods\n"
               "time: {step: 1e-4, duration: 0.01}\n"
               "contact: {contact_time: 5e-3, restitution: 0.5}\n"
               "grains: [{kind: random, count: 20, diameter: 1e-3, fill: 0.1}]\n"
               "walls:\n"
               "  - {kind: box, size: [8e-3, 8e-3, 8e-3], point: [0, 0, -4e-3]}\n"
               "  - {kind: cylinder, diameter: 9e-3, axis: [0, 1, 0], point: [0, -3.5e-3, 0],"
               " length: 7e-3, ends: closed}\n"
               "  - {kind: sphere, diameter: 10e-3}\n"
               "export: [vtk]\n");
    assert_int_equal(orzo("run walls.yaml -o walls"), 0);
    char polygons[64];
    snprintf(polygons, sizeof polygons, "NumberOfPolys=\"%d\"", 6 + 64 + 2 + 32 * 64);
    assert_true(contains("walls/export/walls_00000.vtp", polygons));
}

/* Whether the index ends as it must and every file that it names is there. */
static void assert_whole_index(const char *name)
{
    char *index = read_file(name, NULL), path[160];
    const char *end = "</Collection>\n</VTKFile>\n";
    int count = 0;
    assert_string_equal(index + strlen(index) - strlen(end), end);
    for (char *at = index; (at = strstr(at, "file=\"")); count++) {
        at += strlen("file=\"");
        snprintf(path, sizeof path, "cut/export/%.*s", (int)strcspn(at, "\""), at);
        assert_true(is_there(path));
    }
    assert_true(count >= 3);
    free(index);
}

/* A run that is killed leaves what it has exported, whole; resumed, it exports what a straight one
 * does. */
static void a_killed_run_has_exported(void **state)
{
    (void)state;
    static const char more[] = " --set time.step=2e-6 --set time.duration=2 --set export=[vtk,csv] "
                               "--set export_interval=1e-2 --set checkpoint.every=0.02";
    char arguments[300];
    snprintf(arguments, sizeof arguments, "run scene.yaml -o whole%s", more);
    expect(0, "201 frames exported", arguments);
    snprintf(arguments, sizeof arguments, "run scene.yaml -o cut%s", more);
    pid_t child = start_orzo(arguments);
    for (int k = 0; k < 20000 && !is_there("cut/export/grains_00003.csv"); k++) {
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
    kill(child, SIGKILL);
    assert_int_equal(wait_for(child, 20), -1);
    assert_whole_index("cut/export/grains.pvd");
    assert_whole_index("cut/export/walls.pvd");
    assert_true(same_files("whole/export/grains_00003.vtp", "cut/export/grains_00003.vtp"));
    expect(0, "201 frames exported", "resume cut");
    assert_true(same_files("whole/export/grains.pvd", "cut/export/grains.pvd"));
    assert_true(same_files("whole/export/contacts_00150.vtp", "cut/export/contacts_00150.vtp"));
    assert_true(same_files("whole/export/frames.csv", "cut/export/frames.csv"));
}

static void each_member_exports(void **state)
{
    (void)state;
    assert_int_equal(orzo("run scene.yaml --seeds 1..2 -o many"), 0);
    assert_true(is_there("many/seed_00001/export/grains.xyz"));
    assert_true(is_there("many/seed_00002/export/grains.xyz"));
    assert_int_equal(orzo("run scene.yaml --seeds 1..2 -o many --overwrite --set export=false"), 0);
    assert_false(is_there("many/seed_00002/export"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_exports),
        cmocka_unit_test(a_folder_is_exported),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(a_resumed_run_exports),
        cmocka_unit_test(a_killed_run_has_exported),
        cmocka_unit_test(each_member_exports),
        cmocka_unit_test(all_walls_are_exported),
    };
    return cmocka_run_group_tests(tests, begin, leave_work);
}
