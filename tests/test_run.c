/* `orzo run` and its companions as a user meets them: outputs, exit statuses, signals. One scene
 * of rods serves nearly all, with few changes of what its kernels do. ORZO_NEEDS_DEVICE. */
#include "base/interrupt.h"
#include "program.h"
#include "run_bed.h"

#include <math.h>

#define BEFORE_LAYERS                                                                              \
    "density,density_all,density_tap_mean,density_all_tap_mean,density_com,"                       \
    "density_com_tap_mean,density_slab,density_slab_tap_mean,angle,angle_tap_mean,"
#define BEFORE_DEEP                                                                                \
    ",contact_count,overlap_max,overlap_mean,speed_max,kinetic,rotational,contact_number"
#define AFTER_LAYERS BEFORE_DEEP ",deep_count"
#define STRESSES     ",strain,stress_xx,stress_yy,stress_zz,stress_xy,stress_xz,stress_yz"
static const char header[] =
    "step,time,tap," BEFORE_LAYERS "angle_layer1,angle_layer2,angle_layer3,angle_layer4,"
    "count_layer1,count_layer2,count_layer3,count_layer4,nematic_s" AFTER_LAYERS;
static const char listed[] =
    "step,time,tap,phase,cycle," BEFORE_LAYERS
    "angle_layer<i>,count_layer<i>,nematic_s,nematic_axis,psi6,"
    "rattler_count" BEFORE_DEEP STRESSES ",deep_count,wall<i>_f<x>,wall<i>_t<x>,"
    "servo<i>_place,servo<i>_velocity,servo<i>_force,servo<i>_pressure";
static const char ledger_header[] =
    ",energy_potential,energy_elastic,energy_dissipated,energy_friction,work_walls,energy_residual";
static const char final_header[] =
    "id,x,y,z,qw,qx,qy,qz,ux,uy,uz,vx,vy,vz,wx,wy,wz,diameter,length,mass\n";

/* A program of its own, which tests share. */
#define EXACT "--precision double --set observe.ledger=true"

static int make_bed(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    write_file("shown.yaml", "%s%s", bed, pictures);
    return orzo("run shown.yaml -o shown");
}

static void test_outputs(void **state)
{
    (void)state;
    char *series = read_file("shown/series.csv", NULL),
         *grains = read_file("shown/final.csv", NULL);
    assert_string_equal(line_of(series, 0), header);
    assert_int_equal(count_lines("shown/series.csv"), 6); /* names, taps 0, 0.5, 1, 1.5, 2 */
    assert_true(strncmp(line_of(series, 1), "0,0,0,", 6) == 0);
    assert_true(strncmp(line_of(series, 2), "500,0.01,0.5,", 13) == 0);
    assert_true(strncmp(line_of(series, 5), "2000,0.04,2,", 12) == 0);
    assert_true(strncmp(grains, final_header, strlen(final_header)) == 0);
    assert_int_equal(count_lines("shown/final.csv"), 31);
    for (int id = 0; id < 30; id++) {
        assert_int_equal(atoi(line_of(grains, id + 1)), id);
    }
    assert_true(is_playable("shown/movie.mp4"));
    assert_true(is_there("shown/frames.bin") && is_there("shown/log.txt"));
    assert_true(is_there("shown/snapshots/tap_00000.png"));
    assert_true(is_there("shown/snapshots/tap_00001.png"));
    assert_false(is_there("shown/snapshots/tap_00050.png"));
    assert_true(contains("shown/log.txt",
                         "warning: snapshots.taps 50 beyond the run's end at tap 2 are not drawn"));
    assert_true(contains("shown/log.txt", "s waiting for pictures; "));
    free(series);
    free(grains);
}

/* The scene as used gives the same run again. */
static void test_scene_as_used(void **state)
{
    (void)state;
    expect(0, "30 grains", "run shown/scene.yaml -o again --no-video");
    assert_true(same_files("shown/final.csv", "again/final.csv"));
    assert_true(same_files("shown/series.csv", "again/series.csv"));
    assert_true(same_files("shown/frames.bin", "again/frames.bin"));
    assert_false(is_there("again/movie.mp4") || is_there("again/snapshots"));
    assert_true(contains("again/log.txt", "2000 steps in "));
    assert_false(contains("again/log.txt", "pictures") || contains("again/log.txt", "drawing"));
}

static void test_finished_runs_are_kept(void **state)
{
    (void)state;
    expect(0, "30 grains", "run shown.yaml -o kept --until 0.02");
    expect(2, "kept holds a run that has ended; expected another folder (-o) or --overwrite",
           "run bed.yaml -o kept");
    assert_true(is_playable("kept/movie.mp4"));
    expect(0, "30 grains", "run bed.yaml -o kept --overwrite --until 0.01");
    assert_int_equal(count_lines("kept/series.csv"), 3);
    assert_false(is_there("kept/movie.mp4") || is_there("kept/snapshots"));
    assert_false(is_there("kept/frames.bin"));
}

static void test_default_folder(void **state)
{
    (void)state;
    expect(0, "30 grains", "run bed.yaml --until 0");
    assert_int_equal(count_lines("runs/bed/series.csv"), 2);
}

/* Spins come back through angular momenta: two roundings. */
static void assert_same_numbers(const char *one, const char *other)
{
    char *a = read_file(one, NULL), *b = read_file(other, NULL), *end;
    const char *x = strchr(a, '\n') + 1, *y = strchr(b, '\n') + 1;
    int count = 0;
    for (; *x && *y; count++) {
        double expected = strtod(x, &end);
        x = end + (*end != '\0');
        double got = strtod(y, &end);
        y = end + (*end != '\0');
        /* a few roundings of spins, and of none where there is none; 17 digits are written */
        assert_true(fabs(got - expected) <= 1e-12 * fabs(expected) + 1e-15);
    }
    assert_int_equal(count, 30 * 20);
    assert_true(*x == *y);
    free(a);
    free(b);
}

/* A run from a settled bed's file starts where that ended. */
static void test_bed_from_a_file(void **state)
{
    (void)state;
    expect(0, "30 grains", "run bed.yaml -o settled " EXACT " --until 0");
    expect(0, "30 grains",
           "run bed.yaml -o restarted " EXACT " --until 0 --set settle=false "
           "--set 'grains=[{kind: file, path: settled/final.csv}]'");
    assert_same_numbers("settled/final.csv", "restarted/final.csv");
}

static void test_settings(void **state)
{
    (void)state;
    expect(0, "30 grains",
           "run bed.yaml -o set --until 0.01 --set contact.friction=0 --set "
           "contact.friction=0.2 " EXACT " --set walls.0.motion.acceleration_ratio=3");
    char *series = read_file("set/series.csv", NULL);
    assert_true(strncmp(line_of(series, 0), header, strlen(header)) == 0);
    assert_string_equal(line_of(series, 0) + strlen(header), ledger_header);
    assert_true(contains("set/scene.yaml", "friction: 0.2"));
    assert_true(contains("set/scene.yaml", "acceleration_ratio: 3"));
    free(series);
    expect(2, "contact.friktion", "run bed.yaml -o bad --set contact.friktion=1");
    assert_false(is_there("bad"));
}

/* The number in a column (from 0) of a line. */
static double cell_of(const char *line, int column)
{
    for (; column > 0; column--) {
        line = strchr(line, ',') + 1;
    }
    return strtod(line, NULL);
}

/* Every contact is in contacts.csv: as many pairs as the series counts, and on the floor (wall 0)
 * the force that it says. */
static void test_contacts(void **state)
{
    (void)state;
    expect(0, "30 grains",
           "run bed.yaml -o touching " EXACT " --set contacts={} --set observe.walls=instant");
    char *series = read_file("touching/series.csv", NULL),
         *contacts = read_file("touching/contacts.csv", NULL);
    assert_string_equal(line_of(contacts, 0),
                        "step,time,a,b,x,y,z,nx,ny,nz,overlap,fn,ftx,fty,ftz,slips");
    int next = 1, count = count_lines("touching/contacts.csv"), commas = 0;
    const char *names = line_of(series, 0), *floor = strstr(names, "wall0_fz");
    for (const char *at = names; at < floor; at++) {
        commas += *at == ',';
    }
    for (int row = 1; row <= 5; row++) {
        double step = cell_of(line_of(series, row), 0), pairs = 0, push = 0;
        for (; next < count && cell_of(line_of(contacts, next), 0) == step; next++) {
            const char *c = line_of(contacts, next);
            pairs += cell_of(c, 3) >= 0;
            push += cell_of(c, 3) == -1 ? cell_of(c, 11) * cell_of(c, 9) + cell_of(c, 14) : 0;
        }
        const char *line = line_of(series, row);
        assert_true(pairs == cell_of(line, 22)); /* contact_count */
        /* nine digits of each */
        assert_true(fabs(push - cell_of(line, commas)) <= 1e-7 * fabs(push));
    }
    assert_int_equal(next, count);
    assert_true(count > 30 && !strstr(contacts, ",-0,"));
    free(series);
    free(contacts);
    expect(0, "30 grains",
           "run bed.yaml -o touching --overwrite " EXACT " "
           "--set contacts.interval=0.015");
    contacts = read_file("touching/contacts.csv", NULL);
    for (int i = 1; i < count_lines("touching/contacts.csv"); i++) {
        assert_true(fmod(cell_of(line_of(contacts, i), 0), 750) == 0);
    }
    free(contacts);
    expect(0, "30 grains",
           "run bed.yaml -o touching --overwrite " EXACT " --set contacts.interval_taps=0.5");
    contacts = read_file("touching/contacts.csv", NULL);
    for (int i = 1; i < count_lines("touching/contacts.csv"); i++) {
        assert_true(fmod(cell_of(line_of(contacts, i), 0), 500) == 0);
    }
    free(contacts);
    expect(0, "30 grains", "run bed.yaml -o touching --overwrite --until 0");
    assert_false(is_there("touching/contacts.csv"));
}

/* Pictures between taps do not take each other's names. */
static void test_pictures_between_taps(void **state)
{
    (void)state;
    expect(0, "30 grains",
           "run shown.yaml -o between --until 0.02 --set 'snapshots.taps=[0.25, 0.4, 1]'");
    assert_true(is_there("between/snapshots/tap_00000.250.png"));
    assert_true(is_there("between/snapshots/tap_00000.400.png"));
    assert_true(is_there("between/snapshots/tap_00001.png"));
}

static void test_draws_again(void **state)
{
    (void)state;
    expect(0, "frames drawn into shown/draw", "draw shown");
    assert_true(is_playable("shown/draw/movie.mp4"));
    assert_true(is_there("shown/draw/snapshots/tap_00001.png"));
    expect(0, "frames drawn into other",
           "draw shown -o other --set movie.colour=speed --set 'movie.views=[lateral]'");
    assert_true(is_playable("other/movie.mp4"));
    assert_false(same_files("other/snapshots/tap_00001.png", "shown/draw/snapshots/tap_00001.png"));
    expect(0, "snapshots: time 0.0151 s is drawn", /* as it is asked for, though there are taps */
           "draw shown -o timed --set movie=false --set 'snapshots={times: [0.0151]}'");
    expect(2, "nowhere/scene.yaml", "draw nowhere");
}

static void test_kernels_from_a_folder(void **state)
{
    (void)state;
    expect(0, "30 grains", "run bed.yaml -o source --until 0 --source-dir '" ORZO_SOURCE "'");
    expect(1, "nowhere/kernels", "run bed.yaml -o nosource --until 0 --source-dir nowhere");
}

static void test_other_commands(void **state)
{
    (void)state;
    expect(0, "orzo run SCENE", "--help");
    expect(0, "--overwrite", "run --help");
    expect(0, "orzo ", "--version");
    expect(0, "walls[].motion.acceleration_ratio", "keys");
    expect(0, "; law hooke", "keys contact.contact_time");
    expect(2, "no key holds friktion", "keys friktion");
    expect(0, "steps since the settled bed", "keys --columns");
    char *said = read_file("said", NULL), names[1024] = "";
    for (int row = 0; line_of(said, row)[0]; row++) {
        size_t used = strlen(names);
        char name[64], unit[16], model[16];
        assert_int_equal(sscanf(line_of(said, row), "%63s %15s %15s", name, unit, model), 3);
        if (strcmp(model, "trigrains") != 0) { /* a column of rods, whose header is known */
            snprintf(names + used, sizeof names - used, "%s%s", used ? "," : "", name);
        }
    }
    free(said);
    assert_true(strncmp(names, listed, strlen(listed)) == 0);
    assert_string_equal(names + strlen(listed), ledger_header);
    expect(0, "encoder", "devices");
}

static void test_wrong_command_lines(void **state)
{
    (void)state;
    expect(2, "no command", "");
    expect(2, "expected", "walk bed.yaml");
    expect(2, "expected", "run");
    expect(2, "expected", "run bed.yaml --quick");
    expect(2, "expected", "run bed.yaml --until soon");
    expect(2, "expected", "run bed.yaml --set");
    expect(2, "expected", "check bed.yaml --overwrite");
    expect(2, "wrong_type.yaml:3: time.step is fast", "check '" ORZO_TESTS "/bad/wrong_type.yaml'");
    expect(2, "nowhere.yaml", "run nowhere.yaml");
    expect(2, "no OpenCL device answers to 'abacus'", "run bed.yaml -o abacus --device abacus");
    expect(2, "is unstable", "run bed.yaml -o unstable --set time.step=1e-3");
}

static void test_wrong_arguments_are_named(void **state)
{
    (void)state;
    expect(2, "orzo: SCENE is missing; expected orzo run SCENE\n", "run");
    expect(2, "orzo: DIR is missing; expected orzo draw DIR\n", "draw -o there");
    expect(2, "orzo: 'b.yaml' is one too many; expected orzo check SCENE\n", "check a.yaml b.yaml");
    expect(2, "'--sed' is wrong; did you mean --set? (see orzo run --help)",
           "run a.yaml --sed x=1");
    expect(2, "'--over-write' is wrong; did you mean --overwrite?", "run a.yaml --over-write");
    expect(2, "'--sesame' is wrong; expected an option of `orzo run`", "run a.yaml --sesame");
    expect(2, "orzo: 'all' is one too many; expected orzo devices\n", "devices all");
    expect(2, "orzo: key=value is missing; expected --set key=value\n", "run bed.yaml --set");
}

/* A guard ends the run: exit status 1, and what was written so far is whole. */
static void test_blowup(void **state)
{
    (void)state;
    expect(0, "30 grains", "run bed.yaml -o calm --until 0");
    char *calm = read_file("calm/final.csv", NULL), *row = strstr(calm, "\n7,");
    write_file("fast.csv", "%.*s", (int)(row + 1 - calm), calm);
    FILE *file = fopen("fast.csv", "a");
    const char *rest = strchr(row + 1, '\n');
    fprintf(file, "7,0,0,0.03,1,0,0,0,0,0,1,0,0,-12,0,0,0,1e-3,2e-3,%s",
            strrchr(line_of(row + 1, 0), ',') + 1);
    fputs(rest, file);
    fclose(file);
    free(calm);
    expect(1, "grain 7: it overlaps another body",
           "run shown.yaml -o blown --set settle=false "
           "--set 'grains=[{kind: file, path: fast.csv}]'");
    assert_true(contains("blown/log.txt", "stopped at step 1"));
    assert_true(contains("blown/log.txt", "time 0.00"));
    assert_true(count_lines("blown/series.csv") >= 2);
    assert_true(is_playable("blown/movie.mp4"));
    assert_false(is_there("blown/final.csv"));
}

/* Waits until a running program has written so many lines. */
static void wait_for_lines(const char *name, int lines)
{
    double end = now_seconds() + 60;
    while (!is_there(name) || count_lines(name) < lines) {
        assert_true(now_seconds() < end);
        sleep_a_little();
    }
}

static void assert_interrupted(pid_t child, const char *folder)
{
    char path[256];
    double start = now_seconds();
    kill(child, SIGINT);
    assert_int_equal(wait_for(child, 10), 130);
    /* 0.1 s on an idle machine: a launch, two pictures, the files. Forty times that is left for a
     * machine whose cores ten others want as well; waiting for the run's end would take a minute.
     */
    assert_true(now_seconds() - start < 4);
    snprintf(path, sizeof path, "%s/final.csv", folder);
    assert_int_equal(count_lines(path), 31);
    snprintf(path, sizeof path, "%s/log.txt", folder);
    assert_true(contains(path, "interrupted at step"));
}

static void test_interrupted(void **state)
{
    (void)state;
    pid_t child = start_orzo("run shown.yaml -o cut --set time.taps=100000 --set movie.speed=0.1 "
                             "--set snapshots.taps=[0]");
    wait_for_lines("cut/series.csv", 10);
    assert_interrupted(child, "cut");
    assert_true(is_playable("cut/movie.mp4"));
}

/* A program that hangs ends by a later signal, not by one that comes twice at once. */
static void test_second_signal_ends_what_hangs(void **state)
{
    (void)state;
    int outcome;
    pid_t child = fork();
    if (child == 0) {
        oz_interrupt_watch();
        raise(SIGINT);
        raise(SIGINT);
        if (oz_interrupt_asked()) {
            usleep(1100 * 1000); /* more than the second that tells them apart */
            raise(SIGTERM);
        }
        _exit(0);
    }
    assert_int_equal(waitpid(child, &outcome, 0), child);
    assert_true(WIFSIGNALED(outcome));
    assert_int_equal(WTERMSIG(outcome), SIGTERM); /* so the first two ended nothing */
    assert_false(oz_interrupt_asked());
}

/* Without movie and snapshots neither GL nor libav is opened. */
static void test_maps_no_more_than_it_needs(void **state)
{
    (void)state;
    static const char *const unneeded[] = {"libEGL",      "libOSMesa", "libGL",     "libavcodec",
                                           "libavformat", "libavutil", "libswscale"};
    char path[64];
    pid_t child = start_orzo("run bed.yaml -o bare --set time.taps=100000");
    wait_for_lines("bare/series.csv", 10);
    snprintf(path, sizeof path, "/proc/%ld/maps", (long)child);
    char *maps = read_file(path, NULL);
    assert_non_null(strstr(maps, "libOpenCL"));
    for (size_t i = 0; i < sizeof unneeded / sizeof *unneeded; i++) {
        if (strstr(maps, unneeded[i])) {
            fail_msg("%s is mapped", unneeded[i]);
        }
    }
    free(maps);
    assert_interrupted(child, "bare");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_outputs),
        cmocka_unit_test(test_scene_as_used),
        cmocka_unit_test(test_finished_runs_are_kept),
        cmocka_unit_test(test_default_folder),
        cmocka_unit_test(test_bed_from_a_file),
        cmocka_unit_test(test_settings),
        cmocka_unit_test(test_contacts),
        cmocka_unit_test(test_pictures_between_taps),
        cmocka_unit_test(test_draws_again),
        cmocka_unit_test(test_kernels_from_a_folder),
        cmocka_unit_test(test_other_commands),
        cmocka_unit_test(test_wrong_command_lines),
        cmocka_unit_test(test_wrong_arguments_are_named),
        cmocka_unit_test(test_blowup),
        cmocka_unit_test(test_interrupted),
        cmocka_unit_test(test_second_signal_ends_what_hangs),
        cmocka_unit_test(test_maps_no_more_than_it_needs),
    };
    return cmocka_run_group_tests(tests, make_bed, leave_work);
}
