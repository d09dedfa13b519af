/* final.csv and frames.bin: what is written comes back, what is damaged is refused by name. */
#include "hand_bed.h"

#include "base/file.h"
#include "model/restart_csv.h"
#include "observe/final.h"
#include "observe/frame_reader.h"

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void test_final_comes_back(void **state)
{
    (void)state;
    Bed bed;
    OzGrains back;
    bed_create(&bed, 50, 0.523e-3, 2.092e-3);
    fill_randomly(&bed);
    assert_int_equal(oz_final_write(&bed.snapshot, in_folder("final.csv")), OZ_OK);
    assert_false(oz_file_exists(in_folder("final.csv.part")));
    assert_int_equal(oz_restart_csv_read(&back, in_folder("final.csv")), OZ_OK);
    assert_int_equal(back.count, 50);
    assert_memory_equal(back.position, bed.snapshot.position, 150 * sizeof(double));
    assert_memory_equal(back.quaternion, bed.snapshot.quaternion, 200 * sizeof(double));
    assert_memory_equal(back.velocity, bed.snapshot.velocity, 150 * sizeof(double));
    assert_memory_equal(back.angular_velocity, bed.snapshot.angular_velocity, 150 * sizeof(double));
    assert_memory_equal(back.mass, bed.grains.mass, 50 * sizeof(double));
    assert_memory_equal(back.length, bed.grains.length, 50 * sizeof(double));
    /* Inertia from mass / volume: two more roundings than the original. */
    assert_near(back.inertia[3] / bed.grains.inertia[3], 1, 1e-14);
    oz_grains_free(&back);
    assert_int_equal(oz_final_write(&bed.snapshot, "/nowhere/final.csv"), OZ_ERR_FILE);
    bed_free(&bed);
}

static void test_bed_refuses(void **state)
{
    (void)state;
#define STATE ",0,0,1,1,0,0,0,0,0,1,0,0,0,0,0,0,"
    static const struct {
        const char *rows, *text;
    } bad[] = {
        {"0" STATE "1,2\n", "bed.csv:2: too few numbers"},
        {"0" STATE "1,2,3,4\n", "bed.csv:2: too many numbers"},
        {"0" STATE "1,2,3\n0" STATE "1,2,3\n", "bed.csv:3: this id came before"},
        {"1" STATE "1,2,3\n", "bed.csv:2: no such id"},
        {"0.5" STATE "1,2,3\n", "bed.csv:2: no such id"},
        {"0" STATE "1,x,3\n", "bed.csv:2: not a number"},
        {"0" STATE "1,,3\n", "bed.csv:2: not a number"},
        {"0" STATE "1,nan,3\n", "bed.csv:2: nan, infinite"},
        {"0" STATE "1,2,1e999\n", "bed.csv:2: nan, infinite"},
        {"0" STATE "0,2,3\n", "bed.csv:2: impossible size"},
        {"0" STATE "1,-2,3\n", "bed.csv:2: impossible size"},
        {"0" STATE "1e200,2,3\n", "bed.csv:2: this size"},
        {"0,0,0,1,1,1,0,0,0,0,1,0,0,0,0,0,0,1,2,3\n", "bed.csv:2: the quaternion's length"},
        {"0,0,0,1,1,0,0,0,1,0,0,0,0,0,0,0,0,1,2,3\n", "bed.csv:2: ux,uy,uz"},
    };
    OzGrains grains;
    char text[512];
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        snprintf(text, sizeof text, "%s\n%s", OZ_RESTART_CSV_HEADER, bad[k].rows);
        write_text(in_folder("bed.csv"), text);
        assert_int_equal(oz_restart_csv_read(&grains, in_folder("bed.csv")), OZ_ERR_INPUT);
        if (!strstr(oz_status_text(), bad[k].text)) {
            fail_msg("%s lacks %s", oz_status_text(), bad[k].text);
        }
        assert_null(grains.position);
    }
    static const struct {
        const char *file, *text;
    } headers[] = {
        {"id,x\n0,1\n", "bed.csv:1: without the column y"},
        {"position\n0,1\n", "bed.csv:1: this is no final.csv"},
        {OZ_RESTART_CSV_HEADER ",colour\n", "bed.csv:1: no such column: colour"},
        {OZ_RESTART_CSV_HEADER ",x\n", "bed.csv:1: twice the column x"},
        {OZ_RESTART_CSV_HEADER "\n", "bed.csv:1: no grain"},
        {"", "bed.csv:1: this is no final.csv"},
    };
    for (size_t k = 0; k < sizeof headers / sizeof *headers; k++) {
        write_text(in_folder("bed.csv"), headers[k].file);
        assert_int_equal(oz_restart_csv_read(&grains, in_folder("bed.csv")), OZ_ERR_INPUT);
        if (!strstr(oz_status_text(), headers[k].text)) {
            fail_msg("%s lacks %s", oz_status_text(), headers[k].text);
        }
    }
    assert_int_equal(oz_restart_csv_read(&grains, in_folder("none.csv")), OZ_ERR_FILE);
    write_text(in_folder("bed.csv"),
               OZ_RESTART_CSV_HEADER "\r\n1" STATE "1,2,3\r\n\r\n0" STATE "4,5,6");
    assert_int_equal(oz_restart_csv_read(&grains, in_folder("bed.csv")), OZ_OK);
    assert_int_equal(grains.count, 2);
    assert_near(grains.diameter[0], 4, 0);
    oz_grains_free(&grains);
}

/* What spreadsheets make of a final.csv: a byte-order mark, quotes, spaces, columns in another
 * order. */
static void test_bed_as_others_write_it(void **state)
{
    (void)state;
    OzGrains grains;
    write_text(in_folder("bed.csv"), "\xef\xbb\xbf\"mass\", \"id\",x,y,z "
                                     ",qw,qx,qy,qz,ux,uy,uz,vx,vy,vz,wx,wy,wz,diameter,length\r\n"
                                     "3,0, 7 ,8,9,1,0,0,0,0,0,1,0,0,\"4\",0,0,0,1,2\r\n");
    assert_int_equal(oz_restart_csv_read(&grains, in_folder("bed.csv")), OZ_OK);
    assert_int_equal(grains.count, 1);
    assert_near(grains.mass[0], 3, 0);
    assert_near(grains.position[0], 7, 0);
    assert_near(grains.position[2], 9, 0);
    assert_near(grains.velocity[2], 4, 0);
    assert_near(grains.length[0], 2, 0);
    oz_grains_free(&grains);
}

static void assert_floats(const double *got, const double *expected, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        assert_near(got[i], (double)(float)expected[i], 0);
    }
}

static void write_frames(Bed *bed)
{
    OzFrames *frames = NULL;
    const char *path = in_folder("frames.bin");
    assert_int_equal(oz_frames_create(&frames, path, &bed->scene, &bed->grains), OZ_OK);
    for (int k = 0; k < 3; k++) {
        bed->snapshot.step = k * INT64_C(10000000000);
        bed->snapshot.time = k / 3.0;
        bed->snapshot.wall_offset[0] = k * 1e-3;
        assert_int_equal(oz_frames_add(frames, &bed->snapshot, 1 + k), OZ_OK);
    }
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
}

/* The number of frames that the file gives; the last one stays in back. */
static int count_frames(OzSnapshot *back, OzGrains *grains, const OzScene *scene, OzStatus *last)
{
    OzFrames *frames = NULL;
    int purpose = 0, count = 0;
    bool more = true;
    *last = oz_frame_reader_open(&frames, in_folder("frames.bin"), grains);
    if (*last != OZ_OK) {
        return -1;
    }
    assert_int_equal(oz_snapshot_create(back, scene, grains), OZ_OK);
    while (*last == OZ_OK && more) {
        *last = oz_frame_reader_next(frames, back, &purpose, &more);
        count += *last == OZ_OK && more;
        assert_true(*last != OZ_OK || purpose == count);
    }
    assert_int_equal(oz_frames_finish(frames), OZ_OK);
    return count;
}

static void test_frames_come_back(void **state)
{
    (void)state;
    Bed bed;
    OzGrains grains;
    OzSnapshot back;
    OzStatus last;
    bed_create(&bed, 7, 0.5e-3, 2e-3);
    fill_randomly(&bed);
    bed.grains.population[4] = 3;
    write_frames(&bed);
    assert_int_equal(count_frames(&back, &grains, &bed.scene, &last), 3);
    assert_int_equal(last, OZ_OK);
    assert_int_equal(back.step, INT64_C(20000000000));
    assert_near(back.time, 2 / 3.0, 0);
    assert_floats(back.wall_offset, bed.snapshot.wall_offset, 2);
    assert_floats(back.position, bed.snapshot.position, 21);
    assert_floats(back.quaternion, bed.snapshot.quaternion, 28);
    assert_floats(back.velocity, bed.snapshot.velocity, 21);
    assert_floats(back.angular_velocity, bed.snapshot.angular_velocity, 21);
    assert_near(back.axis[20], bed.snapshot.axis[20], 1e-7); /* quaternions as floats: 6e-8 */
    assert_memory_equal(grains.length, bed.grains.length, 7 * sizeof(double));
    assert_memory_equal(grains.mass, bed.grains.mass, 7 * sizeof(double));
    assert_int_equal(grains.population[4], 3);
    oz_snapshot_free(&back);
    oz_grains_free(&grains);
    bed_free(&bed);
}

static void damage(const char *path, long at, unsigned char bits)
{
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    fseek(file, at, SEEK_SET);
    int byte = fgetc(file);
    fseek(file, at, SEEK_SET);
    fputc(byte ^ bits, file);
    fclose(file);
}

/* Any changed byte is found, and every cut gives the whole frames before it. */
static void test_frames_damaged(void **state)
{
    (void)state;
    Bed bed;
    OzGrains grains;
    OzSnapshot back;
    OzStatus last;
    long head = 32 + 2 * 28 + 8, frame = 32 + 2 * 8 + 2 * 52 + 8 + 8;
    bed_create(&bed, 2, 0.5e-3, 2e-3);
    fill_randomly(&bed);
    for (long at = 0; at < head + 3 * frame; at++) {
        write_frames(&bed);
        damage(in_folder("frames.bin"), at, 0x40);
        int whole = count_frames(&back, &grains, &bed.scene, &last);
        assert_int_equal(last, OZ_ERR_INPUT);
        assert_non_null(strstr(oz_status_text(), "frames.bin"));
        assert_int_equal(whole, at < head ? -1 : (at - head) / frame);
        if (whole >= 0) {
            oz_snapshot_free(&back);
            oz_grains_free(&grains);
        }
    }
    for (long size = head + 3 * frame; size >= 0; size--) {
        write_frames(&bed);
        assert_int_equal(truncate(in_folder("frames.bin"), size), 0);
        int whole = count_frames(&back, &grains, &bed.scene, &last);
        assert_int_equal(whole, size < head ? -1 : (size - head) / frame);
        assert_int_equal(last, size < head ? OZ_ERR_INPUT : OZ_OK);
        if (whole >= 0) {
            oz_snapshot_free(&back);
            oz_grains_free(&grains);
        }
    }
    bed_free(&bed);
}

/* A head that promises 2^29 grains must not be believed. */
static void test_frames_promise(void **state)
{
    (void)state;
    Bed bed;
    OzGrains grains;
    OzSnapshot back;
    OzStatus last;
    bed_create(&bed, 2, 0.5e-3, 2e-3);
    write_frames(&bed);
    damage(in_folder("frames.bin"), 16 + 3, 0x20);
    assert_int_equal(count_frames(&back, &grains, &bed.scene, &last), -1);
    assert_non_null(strstr(oz_status_text(), "cut short"));
    write_text(in_folder("frames.bin"), "time,angle and much more that is no frame at all\n");
    assert_int_equal(count_frames(&back, &grains, &bed.scene, &last), -1);
    assert_non_null(strstr(oz_status_text(), "not a file of frames"));
    bed_free(&bed);
}

static int clean_up(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"bed.csv", "final.csv", "frames.bin", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_final_comes_back),       cmocka_unit_test(test_bed_refuses),
        cmocka_unit_test(test_bed_as_others_write_it), cmocka_unit_test(test_frames_come_back),
        cmocka_unit_test(test_frames_damaged),         cmocka_unit_test(test_frames_promise),
    };
    return cmocka_run_group_tests(tests, make_folder, clean_up);
}
