/* A run on its page, as a user meets it: the address is said once, the page follows the run to its
 * end, and the run is the same without it. ORZO_NEEDS_DEVICE. */
#include "program.h"

#include "page_client.h"
#include "run_bed.h"

static int make_bed(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("shown.yaml", "%s%s", bed, pictures);
    return orzo("run shown.yaml -o plain");
}

/* Reads the address from what the program said. */
static void find_page(void)
{
    const char *found = NULL;
    char *said = NULL;
    for (int i = 0; i < 1000 && !found; i++) {
        sleep_a_little();
        free(said);
        said = is_there("said") ? read_file("said", NULL) : NULL;
        found = said ? strstr(said, "page: http") : NULL;
        found = found && strchr(found, '\n') ? found : NULL;
    }
    assert_non_null(found);
    assert_int_equal(sscanf(found, "page: http://127.0.0.1:%d/?token=%32s", &port, token), 2);
    free(said);
}

static void test_follows_the_run(void **state)
{
    char last[sizeof answer] = "";
    bool pictured = false;
    (void)state;
    remove("said");
    pid_t child = start_orzo("run shown.yaml -o served --serve");
    find_page();
    ask("POST", "/set", token, "", CHANGE); /* which is what runs */
    assert_non_null(strstr(answer, "\"applied\": "));
    for (int handle; (handle = client_try()) >= 0;) {
        close(handle);
        ask("GET", "/frame.png", token, "", "");
        pictured = pictured || memmem(answer, sizeof answer, "\x89PNG", 4);
        ask("GET", "/state", token, "", "");
        if (*answer) {
            memcpy(last, answer, sizeof last);
        }
    }
    assert_int_equal(wait_for(child, 10), 0);
    assert_true(pictured);
    if (!strstr(last, "\"done\": true") || !strstr(last, "\"progress\": 1,") ||
        !strstr(last, "\"angle\"")) {
        fail_msg("the last state was %s", last);
    }
    assert_false(contains("served/log.txt", token));
    assert_true(same_files("plain/series.csv", "served/series.csv"));
    assert_true(same_files("plain/final.csv", "served/final.csv"));
    assert_true(same_files("plain/movie.mp4", "served/movie.mp4"));
}

/* What is set there is the transaction that an edit of the scene would be. */
static void test_sets_keys(void **state)
{
    (void)state;
    remove("said");
    pid_t child = start_orzo("run shown.yaml -o changed --serve --set time.taps=2000 --no-video");
    find_page();
    ask("GET", "/state", token, "", "");
    assert_non_null(strstr(answer, "{\"key\": \"contact.friction\", \"value\": "));
    assert_null(strstr(answer, "\"key\": \"seed\""));
    ask("POST", "/set", token, "", "{\"key\": \"contact.friction\", \"value\": 0.45}");
    if (!strstr(answer, "{\"applied\": true, \"message\": \"contact.friction ")) {
        fail_msg("%s", answer);
    }
    ask("POST", "/set", token, "", "{\"key\": \"seed\", \"value\": 7}");
    assert_non_null(strstr(answer, "{\"applied\": false, "));
    assert_non_null(strstr(answer, "which cannot change"));
    ask("GET", "/state", token, "", "");
    assert_non_null(strstr(answer, "{\"key\": \"contact.friction\", \"value\": 0.45,"));
    for (int i = 0; i < 500 && !contains("said", "): contact.friction "); i++) {
        sleep_a_little();
    }
    kill(child, SIGINT);
    assert_int_equal(wait_for(child, 10), 130);
    assert_true(contains("changed/reloads.csv", "contact.friction"));
}

static void await_answer(const char *text)
{
    for (int i = 0; i < 500 && !strstr(ask("GET", "/state", token, "", ""), text); i++) {
        sleep_a_little();
    }
    if (!strstr(answer, text)) {
        fail_msg("%s is not in %s", text, answer);
    }
}

/* A change of the file, taken or refused, is on the page too; keys that take their value from
 * others, or have none, are in its table. */
static void test_hears_of_edits(void **state)
{
    (void)state;
    write_file("edited.yaml", "extends: shown.yaml\ncontact: {friction: 0.2}\n");
    remove("said");
    pid_t child =
        start_orzo("run edited.yaml -o edited --watch --serve --set time.taps=2000 --no-video");
    find_page();
    await_answer("{\"key\": \"walls.1.contact.friction\", \"value\": 0.2,");
    await_answer("{\"key\": \"export_interval\", \"value\": null,");
    for (int i = 0; i < 500 && !contains("said", "first step"); i++) {
        sleep_a_little();
    }
    write_file("edited.yaml", "extends: shown.yaml\ncontact: {friction: 0.35}\n");
    await_answer("\"applied\": true, \"text\": \"contact.friction 0.2 -> 0.35\"");
    await_answer("{\"key\": \"walls.1.contact.friction\", \"value\": 0.35,");
    ask("POST", "/set", token, "", "{\"key\": \"walls.1.contact.friction\", \"value\": 0.6}");
    assert_non_null(strstr(answer, "{\"applied\": true, "));
    await_answer("{\"key\": \"walls.1.contact.friction\", \"value\": 0.6,");
    write_file("edited.yaml", "extends: shown.yaml\ncontact: {frictoin: 0.35}\n");
    await_answer("\"applied\": false, \"text\": \"edited.yaml:2: ");
    kill(child, SIGINT);
    assert_int_equal(wait_for(child, 10), 130);
}

static void test_words(void **state)
{
    (void)state;
    expect(2, "expected --serve with a port from 1 to 65535, or none",
           "run shown.yaml -o bad --serve 65536");
    assert_false(is_there("bad"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_follows_the_run), cmocka_unit_test(test_sets_keys),
        cmocka_unit_test(test_hears_of_edits), cmocka_unit_test(test_words)};
    return cmocka_run_group_tests(tests, make_bed, leave_work);
}
