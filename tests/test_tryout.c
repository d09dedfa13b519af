/* Pictures under a limit of address space: a driver's death in a trial is a message, and the
 * program never dies of it. */
#include "program.h"

#include "draw/tryout.h"
#include "model/insert.h"
#include "observe/frames.h"

#include <sys/resource.h>

static const char text[] = "model: rods\n"
                           "time: {step: 1e-3, duration: 1}\n"
                           "contact: {contact_time: 1e-2, restitution: 0.5}\n"
                           "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 2e-3]}]\n"
                           "walls: [{kind: plane}, {kind: cylinder, diameter: 8e-3}]\n"
                           "movie: {size: [1280, 720]}\n";

static OzStatus die(void *argument)
{
    (void)argument;
    abort();
}

static OzStatus refuse(void *argument)
{
    return oz_status_fail(OZ_ERR_MOVIE, "%s", (const char *)argument);
}

/* Writes where the caller would see it, were it the same process. */
static OzStatus succeed(void *argument)
{
    *(int *)argument = 1;
    return OZ_OK;
}

static void set_limit(rlim_t bytes)
{
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_AS, &limit), 0);
    limit.rlim_cur = bytes;
    assert_int_equal(setrlimit(RLIMIT_AS, &limit), 0);
}

static void nothing_is_tried_without_a_limit(void **state)
{
    (void)state;
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_AS, &limit), 0);
    if (limit.rlim_cur != RLIM_INFINITY) {
        skip();
    }
    assert_int_equal(oz_tryout_run(die, NULL), OZ_OK);
}

static void a_death_is_a_failure_with_a_text(void **state)
{
    (void)state;
    int touched = 0;
    char reason[] = "no encoder";
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_AS, &limit), 0);
    if (limit.rlim_max != RLIM_INFINITY) {
        skip();
    }
    set_limit((rlim_t)1 << 46); /* there, and never met */
    assert_int_equal(oz_tryout_run(die, NULL), OZ_ERR_GRAPHICS);
    assert_non_null(strstr(oz_status_text(), "ended by signal 6"));
    assert_non_null(strstr(oz_status_text(), "ulimit -v 68719476736"));
    assert_int_equal(oz_tryout_run(refuse, reason), OZ_ERR_MOVIE);
    assert_non_null(strstr(oz_status_text(), "no encoder (this process may have"));
    assert_int_equal(oz_tryout_run(succeed, &touched), OZ_OK);
    assert_int_equal(touched, 0);
    set_limit(RLIM_INFINITY);
}

static void make_run(void)
{
    OzScene scene;
    OzGrains grains;
    OzSnapshot now;
    OzFrames *frames = NULL;
    assert_int_equal(mkdir("run", 0777), 0);
    write_file("run/scene.yaml", "%s", text);
    assert_int_equal(oz_scene_parse(&scene, "scene.yaml", text, NULL, 0), OZ_OK);
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_int_equal(oz_snapshot_create(&now, &scene, &grains), OZ_OK);
    now.quaternion[0] = 1;
    now.position[2] = 2e-3;
    assert_int_equal(oz_frames_create(&frames, "run/frames.bin", &scene, &grains), OZ_OK);
    assert_int_equal(oz_frames_add(frames, &now, OZ_FRAME_MOVIE), OZ_OK);
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
    oz_snapshot_free(&now);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

/* From far too little to what must do: exit status 1 with the reason, or 0, and no signal (which a
 * shell makes 128 and more). Without the trial, half of the lower ones ended by one. */
static void no_limit_kills_the_program(void **state)
{
    (void)state;
#ifdef __SANITIZE_ADDRESS__
    skip(); /* its shadow is larger than any limit */
#endif
    static const int megabytes[] = {225, 275, 400, 575, 600, 8000};
    make_run();
    for (int i = 0; i < 6; i++) {
        char command[512];
        snprintf(command, sizeof command,
                 "bash -c \"ulimit -v %d000; exec '%s' draw run --gl egl -o out\" >said 2>&1", megabytes[i],
                 ORZO_PROGRAM);
        int status = system(command);
        assert_true(WIFEXITED(status));
        if (WEXITSTATUS(status) > 1 || !contains("said", i < 5 ? "ulimit -v" : "1 frames drawn")) {
            char *said = read_file("said", NULL);
            fail_msg("%d MB: exit status %d; it said:\n%s", megabytes[i], WEXITSTATUS(status),
                     said);
        }
        assert_false(is_there("out/movie.mp4.part"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_tried_without_a_limit),
        cmocka_unit_test(a_death_is_a_failure_with_a_text),
        cmocka_unit_test(no_limit_kills_the_program),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
