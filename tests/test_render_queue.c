/* Pictures from the render queue's thread: the bytes of those drawn on the spot, a bounded queue,
 * failures that come back, and no thread where there are no pictures. */
#include "program.h"

#include "draw/render_queue.h"
#include "model/insert.h"
#include "observe/frames.h"

#include <dirent.h>
#include <math.h>
#include <semaphore.h>
#include <time.h>

enum { PICTURES = 2 * OZ_RENDER_QUEUE_JOBS + 3 };

/* A snapshot's name has its time, so that each picture is a file of its own. */
static const char text[] = "model: rods\n"
                           "time: {step: 1e-5, duration: 1}\n"
                           "contact: {contact_time: 6e-4, restitution: 0.5}\n"
                           "grains: [{kind: random, count: 20, diameter: 5e-4, aspect: 4}]\n"
                           "walls:\n"
                           "  - {kind: plane}\n"
                           "  - {kind: cylinder, diameter: 8e-3}\n"
                           "movie: {size: [320, 240], length: 1}\n";

typedef struct Show {
    OzScene scene;
    OzGrains grains;
    OzSnapshot now;
    OzRenderQueue *render_queue;
} Show;

static void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

static void open_show(Show *show)
{
    memset(show, 0, sizeof *show);
    must(oz_scene_parse(&show->scene, "show.yaml", text, NULL, 0));
    must(oz_insert_grains(&show->grains, &show->scene));
    must(oz_snapshot_create(&show->now, &show->scene, &show->grains));
    must(oz_render_queue_create(&show->render_queue));
}

static void close_show(Show *show)
{
    oz_render_queue_free(show->render_queue);
    oz_snapshot_free(&show->now);
    oz_grains_free(&show->grains);
    oz_scene_free(&show->scene);
}

/* A moment of its own: the grains rise and turn. */
static void set_moment(Show *show, int index)
{
    show->now.time = 1e-3 * index;
    for (int64_t i = 0; i < show->now.count; i++) {
        for (int c = 0; c < 4; c++) {
            show->now.position[3 * i + c % 3] =
                show->grains.position[3 * i + c % 3] + (c == 2 ? 1e-4 * index : 0);
            show->now.quaternion[4 * i + c] = c == 0   ? cos(0.1 * index)
                                              : c == 1 ? sin(0.1 * index)
                                                       : 0;
        }
    }
    oz_snapshot_move_walls(&show->now);
    oz_snapshot_turn_axes(&show->now);
}

static OzPictures *open_gallery(const Show *show, OzPicturesSettings *settings, const char *folder,
                                bool in_studio)
{
    OzPictures *pictures = NULL;
    assert_int_equal(mkdir(folder, 0777), 0);
    *settings = (OzPicturesSettings){
        .folder = folder,
        .device = "none",
        .renderer = in_studio ? oz_render_queue_renderer(show->render_queue) : NULL};
    must(oz_pictures_create(&pictures, settings, &show->scene));
    return pictures;
}

static int count_entries(const char *folder)
{
    int count = 0;
    DIR *entries = opendir(folder);
    for (struct dirent *entry = entries ? readdir(entries) : NULL; entry;
         entry = readdir(entries)) {
        count += entry->d_name[0] != '.';
    }
    if (entries) {
        closedir(entries);
    }
    return count;
}

static int thread_count(void)
{
    return count_entries("/proc/self/task");
}

static void test_no_pictures_no_thread(void **state)
{
    (void)state;
    Show show;
    OzPicturesSettings settings;
    open_show(&show);
    OzPictures *pictures = open_gallery(&show, &settings, "none", true);
    must(oz_render_queue_finish(show.render_queue, pictures));
    assert_int_equal(thread_count(), 1);
    close_show(&show);
    assert_int_equal(count_entries("none"), 0);
}

/* The snapshot is changed as soon as it is handed over, as a run does. */
static void test_same_bytes(void **state)
{
    (void)state;
    const int moments = 5, both = OZ_FRAME_MOVIE | OZ_FRAME_SNAPSHOT;
    Show show;
    OzPicturesSettings settings[3];
    open_show(&show);
    OzPictures *here = open_gallery(&show, &settings[0], "here", false);
    for (int i = 0; i < moments; i++) {
        set_moment(&show, i);
        must(oz_pictures_add(here, &show.now, both));
    }
    must(oz_pictures_finish(here));
    OzPictures *one = open_gallery(&show, &settings[1], "one", true);
    OzPictures *other = open_gallery(&show, &settings[2], "other", true);
    for (int i = 0; i < moments; i++) {
        set_moment(&show, i);
        must(oz_render_queue_add(show.render_queue, one, &show.now, both));
        must(oz_render_queue_add(show.render_queue, other, &show.now, both));
    }
    must(oz_render_queue_finish(show.render_queue, one));
    must(oz_render_queue_finish(show.render_queue, other));
    assert_true(thread_count() > 1);
    close_show(&show);
    assert_int_equal(count_entries("one/snapshots"), moments);
    assert_true(is_playable("one/movie.mp4"));
    assert_true(same_files("here/movie.mp4", "one/movie.mp4"));
    assert_true(same_files("here/movie.mp4", "other/movie.mp4"));
    assert_true(same_files("here/snapshots/time_0.000000.png", "one/snapshots/time_0.000000.png"));
    assert_true(
        same_files("here/snapshots/time_0.004000.png", "other/snapshots/time_0.004000.png"));
    assert_false(same_files("one/snapshots/time_0.000000.png", "one/snapshots/time_0.004000.png"));
}

/* Width and height as a PNG's head says. */
static void size_of_png(const char *path, int size[2])
{
    char *bytes = read_file(path, NULL);
    for (int k = 0; k < 2; k++) {
        const unsigned char *at = (const unsigned char *)bytes + 16 + 4 * k;
        size[k] = at[2] << 8 | at[3];
    }
    free(bytes);
}

/* Single pictures have a look of their own; the movie's bytes do not change by them. */
static void test_stills_of_their_own(void **state)
{
    (void)state;
    const int both = OZ_FRAME_MOVIE | OZ_FRAME_SNAPSHOT;
    static const char *const stills[] = {"snapshots.size=[401, 301]", "snapshots.views=[cut]",
                                         "snapshots.colour=type"};
    Show show;
    OzPicturesSettings settings[2];
    open_show(&show);
    OzPictures *plain = open_gallery(&show, &settings[0], "plain", false);
    must(oz_pictures_add(plain, &show.now, both));
    must(oz_pictures_finish(plain));
    oz_scene_free(&show.scene);
    must(oz_scene_parse(&show.scene, "show.yaml", text, (char *const *)(uintptr_t)stills, 3));
    OzPictures *own = open_gallery(&show, &settings[1], "own", false);
    must(oz_pictures_add(own, &show.now, both));
    must(oz_pictures_repeat(own));
    must(oz_pictures_finish(own));
    int size[2];
    size_of_png("plain/snapshots/time_0.000000.png", size);
    assert_true(size[0] == 320 && size[1] == 240);
    size_of_png("own/snapshots/time_0.000000.png", size);
    assert_true(size[0] == 401 && size[1] == 301);
    assert_true(is_playable("own/movie.mp4"));
    close_show(&show);
}

/* Whoever adds is let go only when all but the queue is drawn. */
static void test_queue_is_bounded(void **state)
{
    (void)state;
    Show show;
    OzPicturesSettings settings;
    open_show(&show);
    OzPictures *pictures = open_gallery(&show, &settings, "many", true);
    for (int i = 0; i < PICTURES; i++) {
        set_moment(&show, i);
        must(oz_render_queue_add(show.render_queue, pictures, &show.now, OZ_FRAME_SNAPSHOT));
        assert_true(count_entries("many/snapshots") >= i + 1 - OZ_RENDER_QUEUE_JOBS);
    }
    must(oz_render_queue_finish(show.render_queue, pictures));
    OzRenderQueueTimes times = oz_render_queue_take_times(show.render_queue),
                       again = oz_render_queue_take_times(show.render_queue);
    assert_true(times.waited > 0 && times.drawing > 0 && times.encoding >= 0);
    assert_true(again.waited == 0 && again.drawing == 0);
    assert_int_equal(count_entries("many/snapshots"), PICTURES);
    close_show(&show);
}

/* Draws moment 9 and the strobe, after moment 0 where that is not drawn by pictures left before. */
static void draw_on(Show *show, const char *folder, bool anew, OzState *state)
{
    const int both = OZ_FRAME_SNAPSHOT | OZ_FRAME_STROBE;
    OzPicturesSettings settings;
    OzPictures *pictures = open_gallery(show, &settings, folder, true);
    set_moment(show, 0);
    if (anew) {
        must(oz_render_queue_add(show->render_queue, pictures, &show->now, both));
    }
    OzStateVisit visit = state->count == 0 ? oz_state_save(state) : oz_state_load(state);
    must(oz_render_queue_state(show->render_queue, pictures, &show->now, &visit));
    must(oz_state_finish(&visit));
    set_moment(show, 9);
    must(oz_render_queue_add(show->render_queue, pictures, &show->now, both));
    must(oz_render_queue_finish(show->render_queue, pictures));
}

/* Pictures that are left and taken up again frame what was framed first, and keep the strobe's
 * states. */
static void test_taken_up_again(void **state)
{
    (void)state;
    Show show;
    OzState kept = {0}, none = {0};
    open_show(&show);
    draw_on(&show, "straight", true, &kept);
    draw_on(&show, "taken_up", false, &kept);
    draw_on(&show, "begun_late", false, &none);
    close_show(&show);
    oz_state_free(&kept);
    oz_state_free(&none);
    static const char *const names[] = {"time_0.009000.png", "strobe.png"};
    for (int k = 0; k < 2; k++) {
        char straight[64], taken_up[64], late[64];
        snprintf(straight, sizeof straight, "straight/snapshots/%s", names[k]);
        snprintf(taken_up, sizeof taken_up, "taken_up/snapshots/%s", names[k]);
        snprintf(late, sizeof late, "begun_late/snapshots/%s", names[k]);
        assert_true(same_files(straight, taken_up));
        assert_false(same_files(straight, late));
    }
}

static void add_moments(Show *show, OzPictures *pictures, int first, int last)
{
    for (int i = first; i < last; i++) {
        set_moment(show, i);
        must(oz_render_queue_add(show->render_queue, pictures, &show->now, OZ_FRAME_MOVIE));
    }
}

static void visit_pictures(Show *show, OzPictures *pictures, OzState *state)
{
    OzStateVisit visit = state->count == 0 ? oz_state_save(state) : oz_state_load(state);
    must(oz_render_queue_state(show->render_queue, pictures, &show->now, &visit));
    must(oz_state_finish(&visit));
}

/* A folder as a kill leaves it, some frames after the state: the movie that goes on there is that
 * of the straight run. */
static void test_movie_goes_on(void **state)
{
    (void)state;
    const int saved = 5, left = 7, all = 12;
    Show show;
    OzState kept = {0};
    OzPicturesSettings settings[2];
    open_show(&show);
    OzPictures *pictures = open_gallery(&show, &settings[0], "whole", true);
    add_moments(&show, pictures, 0, saved);
    visit_pictures(&show, pictures, &kept);
    assert_true(is_playable("whole/movie.mp4.part"));
    add_moments(&show, pictures, saved, left);
    assert_int_equal(system("cp whole/movie.mp4.part left.part"), 0);
    add_moments(&show, pictures, left, all);
    must(oz_render_queue_finish(show.render_queue, pictures));
    pictures = open_gallery(&show, &settings[1], "killed", true);
    assert_int_equal(rename("left.part", "killed/movie.mp4.part"), 0);
    visit_pictures(&show, pictures, &kept);
    add_moments(&show, pictures, saved, all);
    must(oz_render_queue_finish(show.render_queue, pictures));
    close_show(&show);
    oz_state_free(&kept);
    assert_true(is_playable("killed/movie.mp4"));
    assert_true(same_files("whole/movie.mp4", "killed/movie.mp4"));
    assert_int_equal(count_entries("killed"), 1);
}

/* One who looks on and holds up the first picture until it is let go. */
typedef struct Gate {
    sem_t opened;
    bool is_passed, gave_up; /* gave up: a test that fails must end */
} Gate;

static bool wants(void *context)
{
    (void)context;
    return true;
}

static void hold(void *context, const OzImage *image)
{
    Gate *gate = context;
    struct timespec end;
    (void)image;
    clock_gettime(CLOCK_REALTIME, &end);
    end.tv_sec += 20;
    gate->gave_up = !gate->is_passed && sem_timedwait(&gate->opened, &end) != 0;
    gate->is_passed = true;
}

static void set_colour(Show *show, const char *colour)
{
    const char *set[] = {colour};
    oz_scene_free(&show->scene);
    must(oz_scene_parse(&show->scene, "show.yaml", text, (char *const *)(uintptr_t)set, 1));
}

/* Pictures 0 to JOBS - 1 before the change and one after it, drawn on the spot. */
static void draw_changed(Show *show, const char *folder)
{
    OzPicturesSettings settings;
    OzScene next;
    set_colour(show, "movie.colour=angle");
    OzPictures *pictures = open_gallery(show, &settings, folder, false);
    for (int i = 0; i <= OZ_RENDER_QUEUE_JOBS; i++) {
        set_moment(show, i);
        if (i == OZ_RENDER_QUEUE_JOBS) {
            set_colour(show, "movie.colour=type");
            must(oz_scene_copy(&next, &show->scene));
            oz_pictures_take(pictures, &next, "");
        }
        must(oz_pictures_add(pictures, &show->now, OZ_FRAME_MOVIE | OZ_FRAME_SNAPSHOT));
    }
    must(oz_pictures_finish(pictures));
}

/* A change is handed in at once, however many pictures wait, and these show the scene before it. */
static void test_change_waits_for_no_picture(void **state)
{
    (void)state;
    const int both = OZ_FRAME_MOVIE | OZ_FRAME_SNAPSHOT;
    Gate gate = {0};
    Show show;
    OzPicturesSettings settings;
    open_show(&show);
    sem_init(&gate.opened, 0, 0);
    draw_changed(&show, "spot");
    set_colour(&show, "movie.colour=angle");
    OzPictures *pictures = open_gallery(&show, &settings, "queued", true);
    settings.live = oz_render_queue_live(show.render_queue);
    settings.live->watcher = (OzLiveWatcher){wants, hold, &gate};
    for (int i = 0; i < OZ_RENDER_QUEUE_JOBS; i++) {
        set_moment(&show, i);
        must(oz_render_queue_add(show.render_queue, pictures, &show.now, both));
    }
    set_colour(&show, "movie.colour=type");
    must(oz_render_queue_take(show.render_queue, pictures, &show.scene, ""));
    assert_int_equal(count_entries("queued/snapshots"), 0);
    sem_post(&gate.opened);
    set_moment(&show, OZ_RENDER_QUEUE_JOBS);
    must(oz_render_queue_add(show.render_queue, pictures, &show.now, both));
    must(oz_render_queue_finish(show.render_queue, pictures));
    close_show(&show);
    sem_destroy(&gate.opened);
    assert_false(gate.gave_up);
    assert_true(same_files("spot/movie.mp4", "queued/movie.mp4"));
    assert_true(
        same_files("spot/snapshots/time_0.007000.png", "queued/snapshots/time_0.007000.png"));
    assert_true(
        same_files("spot/snapshots/time_0.008000.png", "queued/snapshots/time_0.008000.png"));
}

/* A picture that cannot be written fails a later call with its text, and the movie so far is whole.
 */
static void test_failure_comes_back(void **state)
{
    (void)state;
    Show show;
    OzPicturesSettings settings;
    OzStatus status = OZ_OK;
    open_show(&show);
    OzPictures *pictures = open_gallery(&show, &settings, "bad", true);
    write_file("bad/snapshots", "in the way");
    for (int i = 0; i < PICTURES && status == OZ_OK; i++) {
        set_moment(&show, i);
        status = oz_render_queue_add(show.render_queue, pictures, &show.now,
                                     OZ_FRAME_MOVIE | (i == 2 ? OZ_FRAME_SNAPSHOT : 0));
    }
    assert_int_equal(status, OZ_ERR_FILE);
    assert_non_null(strstr(oz_status_text(), "bad/snapshots"));
    oz_status_fail(OZ_ERR_INPUT, "another text");
    assert_int_equal(oz_render_queue_finish(show.render_queue, pictures), OZ_ERR_FILE);
    assert_non_null(strstr(oz_status_text(), "bad/snapshots"));
    assert_true(is_playable("bad/movie.mp4"));
    close_show(&show);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            test_no_pictures_no_thread), /* first: the others' libraries have threads */
        cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_stills_of_their_own),
        cmocka_unit_test(test_queue_is_bounded),
        cmocka_unit_test(test_taken_up_again),
        cmocka_unit_test(test_movie_goes_on),
        cmocka_unit_test(test_change_waits_for_no_picture),
        cmocka_unit_test(test_failure_comes_back),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
