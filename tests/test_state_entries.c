/* The inventory of state: what is saved comes back whatever its kind, what does not fit is refused
 * by name, and every owner of state in the sources is visited. */
#include "hand_bed.h"

#include "base/file.h"
#include "base/state.h"
#include "observe/series.h"

#include <ctype.h>
#include <glob.h>
#include <stdbool.h>

/* One of each kind. */
typedef struct Owner {
    int64_t big;
    int small;
    bool flag;
    double numbers[3];
    float words[2];
    unsigned char bytes[5];
    double *grown;
    int64_t grown_count;
    char *text;
    int64_t index;
} Owner;

static const Owner full = {.big = INT64_C(1) << 60,
                           .small = -7,
                           .flag = true,
                           .numbers = {1.5, -0.0, INFINITY},
                           .words = {0.1f, -2},
                           .bytes = {1, 2, 255, 0, 9},
                           .index = 4};

static OzStatus owner_state(Owner *owner, OzStateVisit *visit, int32_t version)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_state_enter(visit, "owner", version));
    OZ_TRY(oz_state_int64(visit, "big", "none", &owner->big));
    OZ_TRY(oz_state_int(visit, "small", "none", &owner->small));
    OZ_TRY(oz_state_bool(visit, "flag", &owner->flag));
    oz_state_enter_one(visit, "inner", 3);
    OZ_TRY(oz_state_double(visit, "numbers", "m", owner->numbers, 3));
    oz_state_leave(visit);
    OZ_TRY(oz_state_items(visit, "words", "s", OZ_STATE_FLOAT, owner->words, 2));
    OZ_TRY(oz_state_items(visit, "bytes", "none", OZ_STATE_BYTES, owner->bytes, 5));
    OZ_TRY(
        oz_state_array(visit, "grown", "J", OZ_STATE_DOUBLE, &owner->grown, &owner->grown_count));
    OZ_TRY(oz_state_text(visit, "text", &owner->text));
    OZ_TRY(oz_state_index(visit, "index", &owner->index, 0, 9));
    oz_state_leave(visit);
done:
    return status;
}

static void free_owner(Owner *owner)
{
    free(owner->grown);
    free(owner->text);
}

static OzState saved_of(Owner *owner)
{
    OzState state = {0};
    OzStateVisit visit = oz_state_save(&state);
    assert_int_equal(owner_state(owner, &visit, 2), OZ_OK);
    assert_string_equal(visit.path, "");
    return state;
}

static void test_all_kinds_come_back(void **state)
{
    (void)state;
    double grown[2] = {3, 4};
    char words[] = "why";
    Owner owner = full, back = {.text = strdup("old"), .grown = malloc(1)};
    owner.grown = grown;
    owner.grown_count = 2;
    for (int k = 0; k < 2; k++) {
        owner.text = k == 0 ? words : NULL;
        OzState saved = saved_of(&owner);
        OzStateVisit visit = oz_state_load(&saved);
        assert_int_equal(owner_state(&back, &visit, 2), OZ_OK);
        assert_int_equal(oz_state_finish(&visit), OZ_OK);
        assert_true(k == 0 ? strcmp(back.text, "why") == 0 : back.text == NULL);
        assert_non_null(oz_state_find(&saved, "owner/inner_3/numbers"));
        oz_state_free(&saved);
    }
    assert_int_equal(back.grown_count, 2);
    assert_memory_equal(back.grown, grown, sizeof grown);
    assert_memory_equal(back.numbers, owner.numbers, sizeof owner.numbers);
    assert_memory_equal(back.words, owner.words, sizeof owner.words);
    assert_memory_equal(back.bytes, owner.bytes, sizeof owner.bytes);
    assert_true(back.big == owner.big && back.small == -7 && back.flag && back.index == 4);
    free_owner(&back);
}

static void assert_refused(OzState *saved, int32_t version, const char *words)
{
    Owner back = {0};
    OzStateVisit visit = oz_state_load(saved);
    OzStatus status = owner_state(&back, &visit, version);
    status = status == OZ_OK ? oz_state_finish(&visit) : status;
    assert_int_equal(status, OZ_ERR_INPUT);
    if (!strstr(oz_status_text(), words)) {
        fail_msg("\"%s\" does not tell \"%s\"", oz_status_text(), words);
    }
    free_owner(&back);
}

/* Each entry in turn: without it, of another kind, with one item more. */
static void test_what_does_not_fit_is_refused_by_name(void **state)
{
    (void)state;
    Owner owner = full;
    OzState saved = saved_of(&owner);
    for (int64_t i = 0; i < saved.count; i++) {
        OzStateEntry *entry = &saved.entries[i];
        char *name = entry->name, other[] = "other", said[64];
        bool any_length = strstr(name, "grown") || strstr(name, "text");
        snprintf(said, sizeof said, "state: %s is missing", name);
        entry->name = other;
        assert_refused(&saved, 2, said);
        entry->name = name;
        snprintf(said, sizeof said, "state: %s is of kind", name);
        OzStateKind kind = entry->kind;
        entry->kind = kind == OZ_STATE_FLOAT ? OZ_STATE_INT32 : OZ_STATE_FLOAT;
        assert_refused(&saved, 2, said);
        entry->kind = kind;
        snprintf(said, sizeof said, "state: %s holds", name);
        entry->count++;
        if (!any_length) {
            assert_refused(&saved, 2, said);
        }
        entry->count--;
    }
    assert_refused(&saved, 3, "state: owner/ is of version 2; expected version 3");
    oz_state_free(&saved);
}

static void test_foreign_entries_and_values_are_refused(void **state)
{
    (void)state;
    Owner owner = full;
    int64_t number = 10;
    OzStateEntry more = {
        .name = "owner/more", .unit = "none", .kind = OZ_STATE_INT64, .count = 1, .data = &number};
    OzState saved = saved_of(&owner);
    assert_int_equal(oz_state_add(&saved, &more), OZ_OK);
    assert_int_equal(oz_state_add(&saved, &more), OZ_ERR_INPUT);
    assert_non_null(strstr(oz_status_text(), "owner/more is there twice"));
    assert_refused(&saved, 2, "state: owner/more belongs to nothing");
    const OzStateEntry *index = oz_state_find(&saved, "owner/index");
    *(int64_t *)index->data = 10;
    assert_refused(&saved, 2, "state: owner/index is 10; expected 0 to 9");
    *(int64_t *)index->data = -1;
    assert_refused(&saved, 2, "state: owner/index is -1");
    *(int64_t *)index->data = 4;
    *(int64_t *)oz_state_find(&saved, "owner/flag")->data = 2;
    assert_refused(&saved, 2, "state: owner/flag is 2; expected 0 to 1");
    oz_state_free(&saved);
}

/* Rows go on in a file that has lost a part of those that were saved, or not. */
static void test_a_shorter_file_is_refused(void **state)
{
    (void)state;
    Bed bed;
    OzSeries *series = NULL;
    OzState saved = {0};
    char path[256];
    snprintf(path, sizeof path, "%s", in_folder("series.csv"));
    bed_create(&bed, 5, 0.5e-3, 2e-3);
    assert_int_equal(oz_series_create(&series, path, &bed.scene, &bed.grains), OZ_OK);
    OzStateVisit visit = oz_state_save(&saved);
    assert_int_equal(oz_series_state(series, &visit), OZ_OK);
    assert_int_equal(oz_series_free(series), OZ_OK);
    for (int cut = 0; cut < 2; cut++) {
        assert_int_equal(
            truncate(path, *(int64_t *)oz_state_find(&saved, "series/file_bytes")->data - cut), 0);
        assert_int_equal(oz_series_go_on(&series, path, &bed.scene, &bed.grains), OZ_OK);
        visit = oz_state_load(&saved);
        assert_int_equal(oz_series_state(series, &visit), cut ? OZ_ERR_FILE : OZ_OK);
        assert_int_equal(oz_series_free(series), OZ_OK);
    }
    assert_non_null(strstr(oz_status_text(), "series.csv is shorter than"));
    oz_state_free(&saved);
    bed_free(&bed);
}

/* The one function that visits and that no source calls: where a pass begins. */
static const char root[] = "oz_worker_state_visit";

enum { FILES_MOST = 1024 };
static char *sources[FILES_MOST], *paths[FILES_MOST];
static int source_count;

static void read_sources(const char *pattern)
{
    char full_pattern[512];
    glob_t found;
    snprintf(full_pattern, sizeof full_pattern, "%s/%s", ORZO_SOURCE, pattern);
    if (glob(full_pattern, 0, NULL, &found) != 0) {
        return;
    }
    for (size_t f = 0; f < found.gl_pathc; f++) {
        assert_true(source_count < FILES_MOST);
        assert_int_equal(oz_file_read(&sources[source_count], NULL, found.gl_pathv[f]), OZ_OK);
        paths[source_count++] = strdup(found.gl_pathv[f]);
    }
    globfree(&found);
}

/* Whether any file but these two, header and source of one name, has the word. */
static bool is_called(const char *word, const char *header)
{
    size_t stem = strlen(header) - 1;
    for (int f = 0; f < source_count; f++) {
        if (strncmp(paths[f], header, stem) != 0 && strstr(sources[f], word)) {
            return true;
        }
    }
    return false;
}

/* Counts functions in a header that take a visit; those that nobody calls are printed. */
static void count_visitors(int header, int *visitors, int *forgotten)
{
    for (const char *at = sources[header]; (at = strstr(at, "OzStateVisit *visit")) != NULL; at++) {
        const char *open = at, *name;
        while (open > sources[header] && *open != '(') {
            open--;
        }
        for (name = open; name > sources[header] && (isalnum(name[-1]) || name[-1] == '_');
             name--) {
        }
        char word[128];
        snprintf(word, sizeof word, "%.*s", (int)(open - name), name);
        if (strncmp(word, "oz_", 3) != 0) {
            continue;
        }
        ++*visitors;
        if (strcmp(word, root) != 0 && !is_called(word, paths[header])) {
            print_error("%s is never visited\n", word);
            ++*forgotten;
        }
    }
}

static void test_every_owner_is_visited(void **state)
{
    (void)state;
    int visitors = 0, forgotten = 0;
    static const char *const patterns[] = {"host/*.[ch]", "host/*/*.[ch]", "host/*/*/*.[ch]"};
    for (int k = 0; k < 3; k++) {
        read_sources(patterns[k]);
    }
    assert_true(is_called("oz_series_state", "host/nothing.h"));
    assert_false(is_called("oz_series_forgotten", "host/nothing.h"));
    for (int f = 0; f < source_count; f++) {
        bool header = paths[f][strlen(paths[f]) - 1] == 'h';
        if (header && !strstr(paths[f], "base/state.h")) {
            count_visitors(f, &visitors, &forgotten);
        }
    }
    assert_true(visitors > 10); /* they were found at all */
    assert_int_equal(forgotten, 0);
}

/* A member's observers are those of OZ_OUTPUTS_OWNERS: any other thing that it points to is
 * borrowed. */
static void test_observers_are_in_the_list(void **state)
{
    (void)state;
    char *text = NULL;
    assert_int_equal(oz_file_read(&text, NULL, ORZO_SOURCE "/host/run/outputs.h"), OZ_OK);
    char *at = strstr(text, "typedef struct OzOutputs {"), *end = strstr(text, "} OzOutputs;");
    assert_true(at && end && strstr(at, "OZ_OUTPUTS_OWNERS("));
    int pointers = 0;
    for (char *line = strtok(at, "\n"); line && line < end; line = strtok(NULL, "\n")) {
        char *type = strstr(line, " Oz"), *star = type ? strchr(type, '*') : NULL;
        if (star && line[0] == ' ' && star[-1] == ' ') {
            pointers++;
            if (!strstr(line, "borrowed")) {
                fail_msg("%s: an observer belongs to OZ_OUTPUTS_OWNERS", line);
            }
        }
    }
    assert_true(pointers > 0);
    free(text);
}

static int clean_up(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"series.csv", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_kinds_come_back),
        cmocka_unit_test(test_what_does_not_fit_is_refused_by_name),
        cmocka_unit_test(test_foreign_entries_and_values_are_refused),
        cmocka_unit_test(test_a_shorter_file_is_refused),
        cmocka_unit_test(test_every_owner_is_visited),
        cmocka_unit_test(test_observers_are_in_the_list),
    };
    return cmocka_run_group_tests(tests, make_folder, clean_up);
}
