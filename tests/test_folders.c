/* Run folders: what orzo did not write survives every command, by contents. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

#include "base/folder.h"
#include "base/marker.h"

#include <fcntl.h>

/* A user's file: written once, compared after each command. */
static const char precious[] = "do not lose me\n";

static void keep(const char *name)
{
    write_file(name, "%s", precious);
}

static void assert_kept(const char *name)
{
    char *text = read_file(name, NULL);
    if (strcmp(text, precious) != 0) {
        fail_msg("%s was changed", name);
    }
    free(text);
}

static void shell(const char *command)
{
    assert_int_equal(system(command), 0);
}

static int make_run(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    write_file("shown.yaml", "%s%s", bed, pictures);
    return orzo("run shown.yaml -o shown --until 0.02");
}

static void test_no_name(void **state)
{
    (void)state;
    keep("log.txt");
    expect(2, "expected -o with the name of a folder", "run bed.yaml -o ''");
    expect(2, "expected -o with the name of a folder", "run bed.yaml --overwrite -o ''");
    expect(2, "expected -o with the name of a folder", "draw shown -o ''");
    expect(2, "expected -o with the name of a folder", "report bed.yaml -o ''");
    expect(2, "expected -o with the name of a folder", "bench -o ''");
    assert_kept("log.txt");
}

/* One at a time, each name that a run may write. */
static void test_what_no_run_wrote(void **state)
{
    (void)state;
    static const char *const names[] = {
        "log.txt",        "scene.yaml",  "series.csv",     "frames.bin",
        "final.csv",      "movie.mp4",   "movie.mp4.part", "movie.mp4.new",
        "final.csv.part", "members.csv", "ensemble.csv",   "snapshots/tap_00000.png"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[64], said[160];
        shell("rm -rf mine && mkdir -p mine/snapshots");
        snprintf(path, sizeof path, "mine/%s", names[i]);
        snprintf(said, sizeof said, "%s is there and no run of orzo has written it", path);
        keep(path);
        expect(2, said, "run shown.yaml -o mine");
        expect(2, said, "run shown.yaml -o mine --overwrite");
        expect(2, said, "run shown.yaml -o mine --seeds 1..2");
        assert_kept(path);
        assert_false(is_there("mine/.orzo"));
    }
    shell("rm -r mine");
}

/* The folder of a run, with a user's files among the run's own. */
static void test_what_a_user_added(void **state)
{
    (void)state;
    shell("cp -r shown added");
    keep("added/notes.txt");
    keep("added/snapshots/holiday.png");
    expect(2, "added holds a run that has ended", "run shown.yaml -o added");
    assert_true(same_files("added/movie.mp4", "shown/movie.mp4"));
    expect(0, "30 grains", "run bed.yaml -o added --overwrite --until 0");
    assert_kept("added/notes.txt");
    assert_kept("added/snapshots/holiday.png");
    assert_false(is_there("added/movie.mp4") || is_there("added/snapshots/tap_00000.png"));
    keep("added/inclination_spectrum.csv"); /* no drum, none written */
    expect(2, "added/inclination_spectrum.csv is there and no run",
           "run bed.yaml -o added --overwrite");
    assert_kept("added/inclination_spectrum.csv");
    shell("rm added/inclination_spectrum.csv");
    keep("added/movie.mp4"); /* the last run made none */
    expect(2, "added/movie.mp4 is there and no run", "run shown.yaml -o added --overwrite");
    assert_kept("added/movie.mp4");
}

/* A named file behind a link to a user's folder, and a marker that leads elsewhere. */
static void test_links(void **state)
{
    (void)state;
    shell("cp -r shown linked && mkdir photos && rm -r linked/snapshots && "
          "ln -s ../photos linked/snapshots");
    keep("photos/tap_00000.png");
    expect(0, "30 grains", "run bed.yaml -o linked --overwrite --until 0");
    assert_kept("photos/tap_00000.png");
    shell("cp -r shown led && printf '../photos/tap_00000.png\\n/etc/no\\n./\\nphotos/../../x/\\n' "
          ">>led/.orzo");
    expect(0, "30 grains", "run bed.yaml -o led --overwrite --until 0");
    assert_kept("photos/tap_00000.png");
    shell("mkdir strange");
    keep("strange/.orzo");
    expect(2, "strange/.orzo is no marker of orzo's", "run bed.yaml -o strange --overwrite");
    assert_kept("strange/.orzo");
}

static void test_inputs(void **state)
{
    (void)state;
    shell("mkdir here && cp bed.yaml here/scene.yaml && cp bed.yaml here/base.yaml && "
          "cp -r shown again");
    write_file("bed_from_file.yaml", "extends: bed.yaml\nsettle: {drag: 70, time_max: 0.02}\n"
                                     "grains: [{kind: file, path: again/final.csv}]\n");
    write_file("again/above.yaml", "extends: scene.yaml\n");
    expect(2, "here/scene.yaml is read here, and the run would write or remove it",
           "run here/scene.yaml -o here");
    expect(2, "here/scene.yaml is read here", "run here/scene.yaml -o here --overwrite");
    expect(2, "again/final.csv is read here", "run bed_from_file.yaml -o again --overwrite");
    expect(2, "again/final.csv is read here",
           "run bed_from_file.yaml -o again --overwrite --seeds 1..2");
    expect(2, "again/scene.yaml is read here", "run again/above.yaml -o again --overwrite");
    assert_true(same_files("here/scene.yaml", "bed.yaml"));
    assert_true(same_files("again/final.csv", "shown/final.csv"));
    assert_true(same_files("again/scene.yaml", "shown/scene.yaml"));
    expect(0, "30 grains", "run here/base.yaml -o here/out --until 0");
}

/* A bed among a sweep's own members, the swept one too. */
static void test_inputs_of_members(void **state)
{
    (void)state;
    expect(0, "2 members", "run bed.yaml -o many --seeds 1..2 --until 0");
    expect(2, "many/seed_00002/final.csv is read here",
           "run bed.yaml -o many --overwrite --seeds 1..2 "
           "--set 'grains=[{kind: file, path: many/seed_00002/final.csv}]'");
    expect(2, "many/seed_00001/final.csv is read here",
           "run bed.yaml -o many --overwrite --set 'grains=[{kind: file, path: shown/final.csv}]' "
           "--set 'sweep={grains.0.path: [shown/final.csv, many/seed_00001/final.csv]}'");
    assert_int_equal(count_lines("many/seed_00001/final.csv"), 31);
    keep("many/seed_00001/notes.txt");
    expect(0, "30 grains", "run bed.yaml -o many --overwrite --until 0"); /* one run instead */
    assert_false(is_there("many/seed_00002") || is_there("many/members.csv"));
    assert_false(is_there("many/seed_00001/final.csv"));
    assert_kept("many/seed_00001/notes.txt");
    shell("mkdir -p other/seed_00002");
    keep("other/seed_00002/series.csv");
    expect(2, "other/seed_00002/series.csv is there and no run",
           "run bed.yaml -o other --seeds 1..2 --overwrite");
    assert_kept("other/seed_00002/series.csv");
    assert_false(is_there("other/seed_00001") || is_there("other/log.txt"));
}

static pid_t start_long_run(const char *out)
{
    char arguments[128];
    snprintf(arguments, sizeof arguments, "run bed.yaml -o %s --set time.taps=1000000", out);
    pid_t child = start_orzo(arguments);
    char path[64];
    snprintf(path, sizeof path, "%s/series.csv", out);
    for (int i = 0; i < 3000 && (!is_there(path) || count_lines(path) < 4); i++) {
        sleep_a_little();
    }
    assert_true(count_lines(path) >= 4);
    return child;
}

static void test_killed(void **state)
{
    (void)state;
    pid_t child = start_long_run("killed");
    kill(child, SIGKILL);
    assert_int_equal(wait_for(child, 20), -1);
    shell("cp killed/series.csv rows");
    expect(2, "killed holds series.csv of a run that did not reach its end",
           "run bed.yaml -o killed");
    assert_true(same_files("killed/series.csv", "rows"));
    expect(0, "30 grains", "run bed.yaml -o killed --overwrite --until 0");
    assert_int_equal(count_lines("killed/series.csv"), 2);
    assert_false(is_there("killed/final.csv.part"));
}

static void test_one_owner(void **state)
{
    (void)state;
    char said[64];
    pid_t child = start_long_run("owned");
    snprintf(said, sizeof said, "owned is in use by process %d", (int)child);
    shell("mv said said_by_owner");
    expect(2, said, "run bed.yaml -o owned");
    expect(2, said, "run bed.yaml -o owned --overwrite");
    expect(2, said, "run bed.yaml -o owned --overwrite --seeds 1..2");
    expect(2, said, "draw owned");
    expect(2, said, "draw owned -o owned_drawn");
    expect(2, said, "export owned --to csv -o owned_drawn");
    assert_false(is_there("owned_drawn"));
    snprintf(said, sizeof said, "owned/.. is in use by process %d", (int)child);
    shell("mkdir owned/below");
    expect(2, "is in use by process", "run bed.yaml -o owned/below");
    kill(child, SIGTERM); /* ends in order */
    assert_int_equal(wait_for(child, 20), 130);
    assert_int_equal(count_lines("owned/final.csv"), 31);
    assert_true(contains("owned/log.txt", "interrupted at step"));
    expect(0, "30 grains", "run bed.yaml -o owned --overwrite --until 0");
}

static long holder_of(const char *marker)
{
    int descriptor = open(marker, O_RDONLY);
    long pid = oz_marker_holder(descriptor);
    close(descriptor);
    return pid;
}

/* Who draws reads: others may read too, and nobody may run there. It waits here for who writes its
 * frames. */
static void test_a_reader(void **state)
{
    (void)state;
    OzFolder too;
    char said[64];
    shell("cp -r shown held && rm held/frames.bin && mkfifo held/frames.bin");
    pid_t child = start_orzo("draw held -o held_drawn");
    for (int i = 0; i < 1500 && holder_of("held/.orzo") != child; i++) {
        sleep_a_little();
    }
    snprintf(said, sizeof said, "held is in use by process %d", (int)child);
    expect(2, said, "run bed.yaml -o held --overwrite");
    expect(2, said, "resume held");
    assert_int_equal(oz_folder_read(&too, "held"), OZ_OK);
    assert_true(too.lock > 0);
    oz_folder_close(&too);
    shell("cp shown/frames.bin held/frames.bin || true"); /* closed before its end */
    assert_int_equal(wait_for(child, 20), 2);             /* it is no file */
    expect(0, "30 grains", "run bed.yaml -o held --overwrite --until 0");
}

static void test_draw(void **state)
{
    (void)state;
    shell("cp -r shown redrawn");
    expect(2, "redrawn/frames.bin is read here", "draw redrawn -o redrawn");
    assert_true(same_files("redrawn/frames.bin", "shown/frames.bin"));
    shell("mkdir pictures");
    keep("pictures/movie.mp4");
    keep("pictures/notes.txt");
    expect(2, "pictures/movie.mp4 is there and no run", "draw redrawn -o pictures");
    assert_kept("pictures/movie.mp4");
    shell("rm pictures/movie.mp4");
    expect(0, "drawn into", "draw redrawn -o pictures --set movie=false");
    expect(0, "drawn into", "draw redrawn -o pictures --set movie=false");
    assert_true(is_there("pictures/snapshots/tap_00000.png"));
    assert_kept("pictures/notes.txt");
}

/* Studies write into folders of their own by the same rules, and refuse before they compute. */
static void test_studies(void **state)
{
    (void)state;
    static const struct {
        const char *name, *command;
    } cases[] = {{"bench.csv", "bench --quick -o studies"},
                 {"report.csv", "report bed.yaml --quick -o studies"},
                 {"ensemble.csv", "report --ensemble bed.yaml --quick -o studies"},
                 {"stability.csv", "report --map -o studies"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[64], said[128];
        double start = now_seconds();
        shell("rm -rf studies && mkdir studies");
        snprintf(path, sizeof path, "studies/%s", cases[i].name);
        snprintf(said, sizeof said, "%s is there and no run of orzo has written it", path);
        keep(path);
        expect(2, said, cases[i].command);
        assert_kept(path);
        assert_true(now_seconds() - start < 30); /* the studies themselves take minutes */
    }
}

/* No file may become larger than some frames: rows and frames are whole, and the last state is
 * there. */
static void test_no_room(void **state)
{
    (void)state;
    write_file("wide.yaml", "%smovie: {size: [320, 240], fps: 100, length: 20}\n", bed);
    expect(0, "30 grains", "run wide.yaml --no-video -o warm --until 0"); /* kernels are built */
    char command[256];
    snprintf(command, sizeof command,
             "ulimit -f 3000; '%s' run wide.yaml --no-video -o full >said 2>&1; test $? -eq 1",
             ORZO_PROGRAM); /* blocks of 512 bytes */
    shell(command);
    assert_true(contains("said", "cannot write full/frames.bin: File too large"));
    assert_int_equal(count_lines("full/final.csv"), 31);
    char *rows = read_file("full/series.csv", NULL);
    assert_true(rows[strlen(rows) - 1] == '\n');
    free(rows);
    expect(0, "frames drawn", "draw full --set movie.size=[64,64]");
}

static void test_scenes_that_are_no_files(void **state)
{
    (void)state;
    shell("mkfifo pipe");
    double start = now_seconds();
    expect(2, "cannot read pipe: a pipe, not a file; expected a scene file", "check pipe");
    assert_true(now_seconds() - start < 5);
    char command[256];
    snprintf(
        command, sizeof command,
        "ulimit -v 4000000; '%s' run bed.yaml -o huge --set grains.0.count=19000000 >said 2>&1; "
        "test $? -eq 2",
        ORZO_PROGRAM);
    shell(command);
    assert_true(contains("said", "19000001 grains need at least 28.5 GB of memory"));
    assert_false(is_there("huge"));
}

static void test_kernel_cache(void **state)
{
    (void)state;
    char command[512];
    snprintf(command, sizeof command,
             "POCL_CACHE_DIR=/dev/null/x TMPDIR=%s '%s' devices >said 2>&1", work, ORZO_PROGRAM);
    shell(command);
    assert_true(contains("said", "kernels cannot be kept in '/dev/null/x' (by POCL_CACHE_DIR)"));
    assert_true(contains("said", "0  cpu: ") || contains("said", "0  gpu: "));
    snprintf(
        command, sizeof command,
        "POCL_CACHE_DIR= XDG_CACHE_HOME= HOME=/dev/null TMPDIR=/dev/null '%s' devices >said 2>&1",
        ORZO_PROGRAM);
    shell(command);
    assert_true(contains("said", "PoCL needs a folder to keep kernels in"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_name),
        cmocka_unit_test(test_what_no_run_wrote),
        cmocka_unit_test(test_what_a_user_added),
        cmocka_unit_test(test_links),
        cmocka_unit_test(test_inputs),
        cmocka_unit_test(test_inputs_of_members),
        cmocka_unit_test(test_killed),
        cmocka_unit_test(test_one_owner),
        cmocka_unit_test(test_a_reader),
        cmocka_unit_test(test_draw),
        cmocka_unit_test(test_studies),
        cmocka_unit_test(test_no_room),
        cmocka_unit_test(test_scenes_that_are_no_files),
        cmocka_unit_test(test_kernel_cache),
    };
    return cmocka_run_group_tests(tests, make_run, leave_work);
}
