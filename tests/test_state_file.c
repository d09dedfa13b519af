/* States in files: what is written comes back, any damaged byte and any cut is refused with its
 * reason, and the file before is kept. */
#include "hand_folder.h"

#include "base/file.h"
#include "run/state_file.h"

static void add(OzState *state, const char *name, OzStateKind kind, int64_t count)
{
    unsigned char data[512];
    char own_name[64], unit[] = "m/s";
    snprintf(own_name, sizeof own_name, "%s", name);
    for (size_t i = 0; i < sizeof data; i++) {
        data[i] = (unsigned char)(7 * i + strlen(name));
    }
    OzStateEntry entry = {
        .name = own_name, .unit = unit, .kind = kind, .count = count, .data = data};
    assert_int_equal(oz_state_add(state, &entry), OZ_OK);
}

static OzState make_state(void)
{
    OzState state = {0};
    add(&state, "version", OZ_STATE_INT32, 1);
    add(&state, "sim/member_0/place", OZ_STATE_INT64, 31);
    add(&state, "sim/member_0/velocity", OZ_STATE_FLOAT, 100);
    add(&state, "sim/member_1/velocity", OZ_STATE_DOUBLE, 17);
    add(&state, "series/none", OZ_STATE_DOUBLE, 0);
    add(&state, "series/text", OZ_STATE_BYTES, 300);
    return state;
}

static void must_read(OzState *state, const char *path)
{
    if (oz_state_file_read(state, path) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

static void assert_same(const OzState *a, const OzState *b)
{
    assert_int_equal(a->count, b->count);
    for (int64_t i = 0; i < a->count; i++) {
        const OzStateEntry *one = &a->entries[i], *other = &b->entries[i];
        assert_string_equal(one->name, other->name);
        assert_string_equal(one->unit, other->unit);
        assert_int_equal(one->kind, other->kind);
        assert_int_equal(one->count, other->count);
        size_t bytes = (size_t)one->count * oz_state_kind_bytes(one->kind);
        assert_memory_equal(one->data, other->data, bytes);
    }
}

static void test_comes_back(void **state)
{
    (void)state;
    OzState saved = make_state(), back;
    assert_int_equal(oz_state_file_write(&saved, in_folder("state.h5")), OZ_OK);
    assert_false(oz_file_exists(in_folder("state.h5.part")));
    assert_false(oz_file_exists(in_folder("state.h5.previous")));
    must_read(&back, in_folder("state.h5"));
    assert_same(&saved, &back);
    oz_state_free(&back);
    add(&saved, "more", OZ_STATE_INT32, 2);
    assert_int_equal(oz_state_file_write(&saved, in_folder("state.h5")), OZ_OK);
    must_read(&back, in_folder("state.h5"));
    assert_same(&saved, &back);
    oz_state_free(&back);
    must_read(&back, in_folder("state.h5.previous"));
    assert_int_equal(back.count, saved.count - 1);
    oz_state_free(&back);
    assert_int_equal(oz_state_file_write(&saved, "/nowhere/state.h5"), OZ_ERR_FILE);
    assert_non_null(strstr(oz_status_text(), "cannot write /nowhere/state.h5.part"));
    oz_state_free(&saved);
}

/* The file before stays as it is when a new one cannot be written. */
static void test_a_failure_leaves_the_file_before(void **state)
{
    (void)state;
    OzState saved = make_state(), back;
    char part[256];
    snprintf(part, sizeof part, "%s", in_folder("state.h5.part"));
    assert_int_equal(oz_state_file_write(&saved, in_folder("state.h5")), OZ_OK);
    assert_int_equal(oz_file_make_folder(part), OZ_OK); /* in the way */
    assert_int_equal(oz_state_file_write(&saved, in_folder("state.h5")), OZ_ERR_FILE);
    assert_int_equal(rmdir(part), 0);
    must_read(&back, in_folder("state.h5"));
    assert_same(&saved, &back);
    oz_state_free(&back);
    oz_state_free(&saved);
}

static void put_file(const char *bytes, size_t length)
{
    FILE *file = fopen(in_folder("bad.h5"), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

static void must_refuse(const char *words)
{
    OzState back;
    OzStatus status = oz_state_file_read(&back, in_folder("bad.h5"));
    if (status != OZ_ERR_INPUT || !strstr(oz_status_text(), words)) {
        fail_msg("status %d, \"%s\" does not tell \"%s\"", status, oz_status_text(), words);
    }
    assert_int_equal(back.count, 0);
}

/* Every byte of the head and of the HDF5 file's first block, then every 97th. */
static void test_damaged_cut_foreign_newer(void **state)
{
    (void)state;
    OzState saved = make_state();
    char *bytes = NULL, version[4];
    size_t length = 0;
    assert_int_equal(oz_state_file_write(&saved, in_folder("state.h5")), OZ_OK);
    assert_int_equal(oz_file_read(&bytes, &length, in_folder("state.h5")), OZ_OK);
    assert_true(length > 4096);
    for (size_t at = 0; at < length; at += at < 1024 ? 1 : 97) {
        bytes[at] ^= 0x40;
        put_file(bytes, length);
        must_refuse(at < 8 ? "no state of a run" : "bad.h5: ");
        bytes[at] ^= 0x40;
    }
    for (size_t cut = 0; cut < length; cut += cut < 1024 ? 1 : 97) {
        put_file(bytes, cut);
        must_refuse(cut < 512 ? "too short" : "cut short");
    }
    memcpy(version, bytes + 12, 4);
    bytes[12]++;
    put_file(bytes, length);
    must_refuse("written by a newer orzo");
    memcpy(bytes + 12, version, 4);
    put_file(bytes, length);
    OzState back;
    must_read(&back, in_folder("bad.h5"));
    assert_same(&saved, &back);
    oz_state_free(&back);
    free(bytes);
    oz_state_free(&saved);
}

/* libhdf5 is mapped by who writes or reads a state and by nobody else. */
static bool is_mapped(void)
{
    char line[512];
    bool found = false;
    FILE *file = fopen("/proc/self/maps", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        found = found || strstr(line, "libhdf5");
    }
    fclose(file);
    return found;
}

static void test_opened_when_needed(void **state)
{
    (void)state;
    OzState saved = make_state();
    assert_false(is_mapped());
    assert_int_equal(oz_state_file_write(&saved, in_folder("state.h5")), OZ_OK);
    assert_true(is_mapped());
    assert_int_equal(remove(in_folder("state.h5")), 0);
    oz_state_free(&saved);
}

static int clean_up(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"state.h5", "state.h5.previous", "bad.h5", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_opened_when_needed), /* first: it stays open */
        cmocka_unit_test(test_comes_back),
        cmocka_unit_test(test_a_failure_leaves_the_file_before),
        cmocka_unit_test(test_damaged_cut_foreign_newer),
    };
    return cmocka_run_group_tests(tests, make_folder, clean_up);
}
