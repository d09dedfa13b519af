/* frames.bin of flat grains: what is written comes back and can be drawn again, what is damaged is
 * refused by name. */
#include "hand_heap.h"

#include "base/file.h"
#include "command/redraw.h"
#include "observe/bytes.h"
#include "observe/frame_reader.h"

#include <sys/stat.h>

enum { FRAMES = 3 };

/* One square, one disc and a wall of two triangles. */
static void make_heap(Heap *heap)
{
    heap_create(heap, 1, 1, 2);
    heap_put_square(heap, 0, 1e-3, 2e-3, 2e-3, 0.3);
    heap_put_disc(heap, 1, 5e-3, 2e-3, 1e-3);
    heap_put_wall(heap, 0, (const double[6]){-1e-3, 0, 2e-3, -1e-3, 3e-3, 0});
    heap_put_wall(heap, 1, (const double[6]){3e-3, 0, 6e-3, -1e-3, 8e-3, 0});
    heap->grains.population[1] = 3;
    heap_start(heap);
    heap_push(heap, 0, 0.25, -0.5, 80);
    heap_push(heap, 1, -0.75, 0.125, -3);
}

/* Every frame moved on a little; leaves the heap as in the last. */
static void write_frames(Heap *heap)
{
    OzFrames *frames = NULL;
    const char *path = in_folder("frames.bin");
    assert_int_equal(oz_frames_create(&frames, path, &heap->scene, &heap->grains), OZ_OK);
    for (int k = 0; k < FRAMES; k++) {
        heap->snapshot.step = 100 * k;
        heap->snapshot.time = 0.25 * k;
        heap_move(heap, 0, 1e-4, 0, 0.5);
        assert_int_equal(oz_frames_add(frames, &heap->snapshot, 1 + k), OZ_OK);
    }
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
}

/* The number of frames that the file gives, -1 when it is refused; the last one stays in back. */
static int count_frames(OzSnapshot *back, OzGrains *grains, const OzScene *scene, OzStatus *last)
{
    OzFrames *frames = NULL;
    bool more = true;
    int count = -1, purpose = 0;
    *last = oz_frame_reader_open(&frames, in_folder("frames.bin"), grains);
    if (*last != OZ_OK) {
        return -1;
    }
    assert_int_equal(oz_snapshot_create(back, scene, grains), OZ_OK);
    while (*last == OZ_OK && more) {
        *last = oz_frame_reader_next(frames, back, &purpose, &more);
        count++;
        assert_true(*last != OZ_OK || !more || purpose == count + 1);
    }
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
    return count;
}

static void assert_doubles(const double *a, const double *b, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        assert_true(a[i] == b[i]);
    }
}

/* What is kept as float comes back within half of its last place. */
static void assert_floats(const double *a, const double *b, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        assert_near(a[i], b[i], fabs(b[i]) * 6e-8);
    }
}

static void assert_elements(const OzElements *a, const OzElements *b)
{
    assert_int_equal(a->grain_count, b->grain_count);
    assert_int_equal(a->wall_count, b->wall_count);
    assert_int_equal(a->free_count, b->free_count);
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->first, b->first, (size_t)(b->grain_count + b->wall_count + 1) * 8);
    assert_memory_equal(a->body, b->body, (size_t)b->count * sizeof(int));
    assert_doubles(a->radius, b->radius, b->count);
    assert_doubles(a->corner, b->corner, 6 * b->count);
    assert_doubles(a->reach, b->reach, b->count);
    assert_doubles(a->area, b->area, b->count);
    assert_doubles(a->mass, b->mass, b->count);
    assert_doubles(a->inertia, b->inertia, b->count);
    assert_doubles(a->angle, b->angle, b->count);
    assert_int_equal(a->beam_count, b->beam_count);
    assert_memory_equal(a->beam_a, b->beam_a, (size_t)b->beam_count * sizeof(int));
    assert_memory_equal(a->beam_b, b->beam_b, (size_t)b->beam_count * sizeof(int));
    assert_int_equal(a->outline_count, b->outline_count);
    assert_memory_equal(a->outline_element, b->outline_element,
                        (size_t)b->outline_count * sizeof(int));
    assert_memory_equal(a->outline_edge, b->outline_edge, (size_t)b->outline_count * sizeof(int));
}

static void frames_come_back(void **state)
{
    (void)state;
    Heap heap;
    OzGrains grains;
    OzSnapshot back;
    OzStatus last;
    make_heap(&heap);
    write_frames(&heap);
    assert_int_equal(count_frames(&back, &grains, &heap.scene, &last), FRAMES);
    assert_int_equal(last, OZ_OK);
    assert_elements(grains.elements, heap.grains.elements);
    assert_int_equal(grains.population[1], 3);
    const OzSnapshot *sent = &heap.snapshot;
    assert_int_equal(back.step, sent->step);
    assert_true(back.time == sent->time);
    assert_floats(back.element_position, sent->element_position, 2 * sent->element_count);
    assert_floats(back.element_angle, sent->element_angle, sent->element_count);
    assert_floats(back.element_velocity, sent->element_velocity, 2 * sent->element_count);
    assert_floats(back.element_angular_velocity, sent->element_angular_velocity,
                  sent->element_count);
    assert_false(back.has_contacts);
    for (int64_t k = 0; k < 6; k++) { /* joined: sums of four roundings */
        assert_near(back.position[k], sent->position[k], 3e-7 * 5e-3);
        assert_near(back.velocity[k], sent->velocity[k], 3e-7);
    }
    oz_snapshot_free(&back);
    oz_grains_free(&grains);
    heap_free(&heap);
}

/* Of frames that are kept to be exported, and of no others. */
static void contacts_come_back(void **state)
{
    (void)state;
    const OzContactEntry pair = {.a = 0,
                                 .b = 1,
                                 .part_a = 2,
                                 .part_b = 4,
                                 .kind = OZ_CONTACT_DISC,
                                 .slips = true,
                                 .point = {1e-3, 2e-3, 0},
                                 .normal = {0.6, 0.8, 0},
                                 .push = 0.25,
                                 .tangential = {-0.08, 0.06, 0},
                                 .overlap = 1e-6};
    OzContactEntry wall = pair;
    Heap heap;
    OzGrains grains;
    OzSnapshot back;
    OzFrames *frames = NULL;
    bool more = false;
    int purpose = 0;
    make_heap(&heap);
    wall.a = 1;
    wall.b = -1;
    assert_int_equal(oz_contact_list_add(&heap.snapshot.contacts, &pair), OZ_OK);
    assert_int_equal(oz_contact_list_add(&heap.snapshot.contacts, &wall), OZ_OK);
    heap.snapshot.has_contacts = true;
    const char *path = in_folder("frames.bin");
    assert_int_equal(oz_frames_create(&frames, path, &heap.scene, &heap.grains), OZ_OK);
    assert_int_equal(oz_frames_add(frames, &heap.snapshot, OZ_FRAME_EXPORT), OZ_OK);
    assert_int_equal(oz_frames_add(frames, &heap.snapshot, OZ_FRAME_MOVIE), OZ_OK);
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
    assert_int_equal(oz_frame_reader_open(&frames, path, &grains), OZ_OK);
    assert_int_equal(oz_snapshot_create(&back, &heap.scene, &grains), OZ_OK);
    assert_int_equal(oz_frame_reader_next(frames, &back, &purpose, &more), OZ_OK);
    assert_true(more && back.has_contacts && purpose == OZ_FRAME_EXPORT);
    assert_int_equal(back.contacts.count, 2);
    const OzContactEntry *e = back.contacts.entry;
    assert_true(e->a == 0 && e->b == 1 && e->part_a == 2 && e->part_b == 4 && e->slips);
    assert_int_equal(e->kind, OZ_CONTACT_DISC);
    assert_floats(e->point, pair.point, 3);
    assert_floats(e->normal, pair.normal, 3);
    assert_floats(&e->push, &pair.push, 1);
    assert_floats(e->tangential, pair.tangential, 3);
    assert_floats(&e->overlap, &pair.overlap, 1);
    assert_true(e[1].a == 1 && e[1].b == -1);
    assert_int_equal(oz_frame_reader_next(frames, &back, &purpose, &more), OZ_OK);
    assert_true(more && !back.has_contacts && purpose == OZ_FRAME_MOVIE);
    assert_int_equal(oz_frame_reader_next(frames, &back, &purpose, &more), OZ_OK);
    assert_false(more);
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
    oz_snapshot_free(&back);
    oz_grains_free(&grains);
    heap_free(&heap);
}

static void damage(long at, unsigned char bits)
{
    FILE *file = fopen(in_folder("frames.bin"), "r+b");
    assert_non_null(file);
    fseek(file, at, SEEK_SET);
    int byte = fgetc(file);
    fseek(file, at, SEEK_SET);
    fputc(byte ^ bits, file);
    fclose(file);
}

/* Seven elements of seven numbers and of six corners' coordinates, four beams, four outlines; a
 * frame has six floats of each and the number of contacts. */
static const long HEAD = 32 + 32 + 2 * 28 + 4 * 4 + 7 * 88 + 4 * 16 + 8;
static const long FRAME = 32 + 8 + 7 * 24 + 8 + 8;

static void any_damage_is_found(void **state)
{
    (void)state;
    Heap heap;
    OzGrains grains;
    OzSnapshot back;
    OzStatus last;
    struct stat info;
    make_heap(&heap);
    write_frames(&heap);
    assert_int_equal(stat(in_folder("frames.bin"), &info), 0);
    assert_int_equal(info.st_size, HEAD + FRAMES * FRAME);
    for (long at = 0; at < HEAD + FRAMES * FRAME; at++) {
        damage(at, 0x40);
        int whole = count_frames(&back, &grains, &heap.scene, &last);
        assert_int_equal(last, OZ_ERR_INPUT);
        assert_int_equal(whole, at < HEAD ? -1 : (at - HEAD) / FRAME);
        if (whole >= 0) {
            oz_snapshot_free(&back);
            oz_grains_free(&grains);
        }
        damage(at, 0x40);
    }
    for (long size = HEAD + FRAMES * FRAME; size >= 0; size -= 7) {
        assert_int_equal(truncate(in_folder("frames.bin"), size), 0);
        int whole = count_frames(&back, &grains, &heap.scene, &last);
        assert_int_equal(whole, size < HEAD ? -1 : (size - HEAD) / FRAME);
        if (whole >= 0) {
            oz_snapshot_free(&back);
            oz_grains_free(&grains);
        }
    }
    heap_free(&heap);
}

/* A sealed file may still hold what no scene can: each is refused, and nothing is read through it.
 */
/* The file as the version before wrote it: no angular velocities, no contacts. */
static void make_old(void)
{
    enum { OLD = 2, OLD_FRAME = 32 + 8 + 7 * 20 + 8 };
    char *bytes = NULL;
    unsigned char frame[OLD_FRAME];
    uint32_t version = OLD;
    uint64_t size = OLD_FRAME;
    assert_int_equal(oz_file_read(&bytes, NULL, in_folder("frames.bin")), OZ_OK);
    FILE *file = fopen(in_folder("frames.bin"), "wb");
    assert_non_null(file);
    memcpy(bytes + 12, &version, sizeof version);
    oz_bytes_seal((unsigned char *)bytes, (size_t)HEAD);
    fwrite(bytes, 1, (size_t)HEAD, file);
    for (int k = 0; k < FRAMES; k++) {
        memcpy(frame, bytes + HEAD + k * FRAME, OLD_FRAME - 8);
        memcpy(frame, &size, sizeof size);
        oz_bytes_seal(frame, OLD_FRAME);
        fwrite(frame, 1, OLD_FRAME, file);
    }
    fclose(file);
    free(bytes);
}

static void old_files_are_read(void **state)
{
    (void)state;
    Heap heap;
    OzGrains grains;
    OzSnapshot back;
    OzStatus last;
    make_heap(&heap);
    write_frames(&heap);
    make_old();
    assert_int_equal(count_frames(&back, &grains, &heap.scene, &last), FRAMES);
    assert_int_equal(last, OZ_OK);
    const OzSnapshot *sent = &heap.snapshot;
    assert_floats(back.element_position, sent->element_position, 2 * sent->element_count);
    assert_floats(back.element_velocity, sent->element_velocity, 2 * sent->element_count);
    assert_true(back.element_angular_velocity[0] == 0 && back.angular_velocity[2] == 0);
    assert_false(back.has_contacts);
    oz_snapshot_free(&back);
    oz_grains_free(&grains);
    heap_free(&heap);
}

static void impossible_elements_are_refused(void **state)
{
    (void)state;
    for (int what = 0; what < 6; what++) {
        Heap heap;
        OzGrains grains;
        OzSnapshot back;
        OzStatus last;
        make_heap(&heap);
        OzElements *elements = heap.grains.elements;
        what == 0 ? (void)(elements->beam_b[2] = 5) : (void)0; /* a wall's */
        what == 1 ? (void)(elements->outline_element[1] = -1) : (void)0;
        what == 2 ? (void)(elements->outline_edge[1] = 3) : (void)0;
        what == 3 ? (void)(elements->mass[2] = 0) : (void)0;
        what == 4 ? (void)(elements->corner[9] = NAN) : (void)0;
        what == 5 ? (void)(elements->first[1] = 9) : (void)0;
        if (what < 5) {
            write_frames(&heap);
        } else { /* frames cannot be joined any more */
            OzFrames *frames = NULL;
            assert_int_equal(
                oz_frames_create(&frames, in_folder("frames.bin"), &heap.scene, &heap.grains),
                OZ_OK);
            assert_int_equal(oz_frames_finish(frames), OZ_OK);
        }
        assert_int_equal(count_frames(&back, &grains, &heap.scene, &last), -1);
        assert_non_null(strstr(oz_status_text(), "impossible elements"));
        assert_null(grains.elements);
        heap_free(&heap);
    }
}

static const char *const scene_text =
    "model: trigrains\n"
    "title: Drawn again\n"
    "gravity: [0, -9.81]\n"
    "time: {step: 1e-6, duration: 1}\n"
    "grains: [{kind: single, shape: square, edge: 2e-3, position: [1e-3, 2e-3]}]\n"
    "walls: [{kind: floor, point: [0, 0], width: 8e-3}]\n"
    "snapshots: {strobe: 0.25}\n";

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void frames_are_drawn_again(void **state)
{
    (void)state;
    Heap heap;
    OzFrames *frames = NULL;
    OzOptions options = {.paths = {folder}, .path_count = 1, .until = -1};
    make_heap(&heap);
    assert_int_equal(oz_frames_create(&frames, in_folder("frames.bin"), &heap.scene, &heap.grains),
                     OZ_OK);
    for (int k = 0; k < FRAMES; k++) {
        int purpose = OZ_FRAME_STROBE | (k == 1 ? OZ_FRAME_SNAPSHOT : 0);
        heap.snapshot.time = 0.25 * k;
        heap_move(&heap, 0, 2e-3, 0, 0.5);
        assert_int_equal(oz_frames_add(frames, &heap.snapshot, purpose), OZ_OK);
    }
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
    write_text(in_folder("scene.yaml"), scene_text);
    if (oz_redraw_folder(&options) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    assert_true(oz_file_exists(in_folder("draw/snapshots/strobe.png")));
    assert_true(oz_file_exists(in_folder("draw/snapshots/time_0.250000.png")));
    heap_free(&heap);
}

static int end(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){
        "draw/snapshots/strobe.png", "draw/snapshots/time_0.250000.png", "draw/snapshots",
        "draw/.orzo", "draw", "scene.yaml", "frames.bin", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_come_back),
        cmocka_unit_test(contacts_come_back),
        cmocka_unit_test(old_files_are_read),
        cmocka_unit_test(any_damage_is_found),
        cmocka_unit_test(impossible_elements_are_refused),
        cmocka_unit_test(frames_are_drawn_again),
    };
    return cmocka_run_group_tests(tests, make_folder, end);
}
