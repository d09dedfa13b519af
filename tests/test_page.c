/* The page of a run, over sockets: what it answers, whom it lets in, and that neither nonsense nor
 * slow clients keep it from others. */
#include "page_client.h"

static bool taken; /* the last change was one that fake_set takes */

static bool fake_set(void *context, const char *key, const char *value, char *message, size_t size)
{
    (void)context;
    taken = strcmp(key, "contact.friction") == 0 && strtod(value, NULL) <= 1;
    snprintf(message, size, taken ? "%s 0.1 -> %s" : "%s: %s is <too> much", key, value);
    return taken;
}

static int open_page(void **state)
{
    (void)state;
    client_open_page(fake_set);
    return 0;
}

static int close_page(void **state)
{
    (void)state;
    oz_page_close(page);
    return 0;
}

/* Each line of defence alone, the others kept. */
static void test_who_is_let_in(void **state)
{
    (void)state;
    char other[33];
    snprintf(other, sizeof other, "%s", token);
    other[31] = other[31] == '0' ? '1' : '0';
    expect_code(200, "GET", "/", token, "", "");
    expect_code(403, "GET", "/", other, "", "");
    expect_code(403, "GET", "/", "", "", "");
    expect_code(403, "GET", "/nowhere", other, "", "");
    expect_code(200, "GET", "/state", token, origin_line("http://127.0.0.1", port), "");
    expect_code(403, "GET", "/state", token, origin_line("http://127.0.0.1", port + 1), "");
    expect_code(403, "GET", "/state", token, "Origin: http://evil.example\r\n", "");
    expect_code(403, "GET", "/state", token, "Origin: null\r\n", "");
    expect_code(403, "POST", "/set", token, "Origin: http://evil.example\r\n", CHANGE);
    const char *const hosts[][2] = {{"localhost:9000", "200"},
                                    {"127.0.0.1", "200"},
                                    {"evil.example", "403"},
                                    {"127.0.0.1.evil.example", "403"},
                                    {"localhost.evil.example:80", "403"},
                                    {"localhost:80x", "403"}};
    for (size_t i = 0; i < sizeof hosts / sizeof *hosts; i++) {
        char request[400];
        snprintf(request, sizeof request, "GET /state?token=%s HTTP/1.1\r\nHost: %s\r\n\r\n", token,
                 hosts[i][0]);
        expect_answer(atoi(hosts[i][1]), request);
    }
    assert_non_null(strstr(ask("GET", "/", token, "", ""), "nonce-"));
    assert_null(strstr(answer, "NONCE"));
    assert_non_null(strstr(answer, "default-src 'none'"));
    assert_non_null(strstr(answer, "Referrer-Policy: no-referrer"));
}

static void test_what_is_refused(void **state)
{
    (void)state;
    char big[6000];
    taken = false;
    memset(big, 'x', sizeof big - 1);
    big[sizeof big - 1] = '\0';
    expect_code(404, "GET", "/nowhere", token, "", "");
    expect_code(404, "GET", "/../etc/passwd", token, "", "");
    expect_code(404, "GET", "/page.html", token, "", "");
    expect_code(405, "GET", "/set", token, "", "");
    expect_code(405, "POST", "/state", token, "", CHANGE);
    expect_code(405, "DELETE", "/set", token, "", "");
    expect_code(413, "POST", "/set", token, "", big);
    expect_code(411, "POST", "/set", token, "Transfer-Encoding: chunked\r\n", "");
    const char *const bodies[] = {"{}",
                                  "[1]",
                                  "{\"key\": \"a\"}",
                                  "{\"key\": \"a\", \"value\": {}}",
                                  "{\"key\": 1, \"value\": 2}",
                                  "{\"key\": \"a\", \"value\": 1, \"value\": 2}",
                                  "{\"key\": \"a\", \"value\": 1} x",
                                  "{\"key\": \"a\", \"value\": 1",
                                  "{\"key\": \"a\\u0000\", \"value\": 1}",
                                  "{\"key\": \"a\", \"value\": 01}"};
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        expect_code(400, "POST", "/set", token, "", bodies[i]);
    }
    assert_false(taken);
}

static void test_state_tells(void **state)
{
    (void)state;
    const char *const parts[] = {
        "\"step\": 1234",
        "\"time\": 0.5",
        "\"tap\": null",
        "\"done\": false",
        "\"stopped\": false",
        "{\"key\": \"contact.friction\", \"value\": 0.1, \"unit\": \"\", \"low\": 0, \"high\": 10,",
        "\"value\": \"hooke\", \"unit\": \"\", \"low\": null, \"high\": null, "
        "\"choices\": [\"hooke\", \"hertz\"]",
        "\"columns\": [\"time\", \"angle\", \"density\"]"};
    ask("GET", "/state", token, "", "");
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (!strstr(answer, parts[i])) {
            fail_msg("no %s in %s", parts[i], answer);
        }
    }
}

static void test_set(void **state)
{
    (void)state;
    ask("POST", "/set", token, "", CHANGE);
    assert_non_null(
        strstr(answer, "{\"applied\": true, \"message\": \"contact.friction 0.1 -> 0.3\"}"));
    ask("POST", "/set", token, "", "{ \"value\": \"2\", \"key\": \"contact.friction\" }");
    assert_non_null(strstr(answer, "{\"applied\": false, \"message\": "
                                   "\"contact.friction: 2 is \\u003ctoo> much\"}"));
    ask("GET", "/state", token, "", "");
    assert_non_null(strstr(answer, "\"applied\": true, \"text\": \"contact.friction 0.1 -> 0.3\""));
    assert_non_null(strstr(answer, "\"applied\": false, \"text\": \"contact.friction: 2 is"));
}

static void test_picture_and_rows(void **state)
{
    (void)state;
    assert_false(oz_page_wants_picture(page));
    expect_code(204, "GET", "/frame.png", token, "", "");
    assert_true(oz_page_wants_picture(page));
    oz_page_show_picture(page, strdup("PNG"), 3);
    ask("GET", "/frame.png", token, "", "");
    assert_non_null(strstr(answer, "X-Number: 1"));
    assert_non_null(strstr(answer, "\r\n\r\nPNG"));
    snprintf(more_arguments, sizeof more_arguments, "&after=1");
    expect_code(204, "GET", "/frame.png", token, "", "");
    for (int i = 0; i < 3000; i++) {
        oz_page_show_row(page, (double[]){i, i == 0 ? NAN : 2.5 * i, 0.5});
    }
    snprintf(more_arguments, sizeof more_arguments, "&columns=angle,nothing,time");
    ask("GET", "/series", token, "", "");
    more_arguments[0] = '\0';
    assert_non_null(strstr(answer, "{\"columns\": [\"angle\", \"time\"], \"rows\": [[null, 0], "));
    assert_non_null(strstr(answer, "[7490, 2996]]}")); /* each fourth row */
}

/* Bytes of a small generator of its own, so that a failure can be repeated. */
static unsigned roll(void)
{
    static unsigned seed = 12345;
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

/* Requests with some bytes changed, cut or put in; what comes is an answer or nothing, and only a
 * body as it was may have set something. */
static void test_nonsense(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        char request[1024];
        int length = client_request(request, sizeof request, i % 2 ? "POST" : "GET",
                                    i % 2 ? "/set" : "/state", token, "", i % 2 ? CHANGE : "");
        for (unsigned k = roll() % 6; k > 0; k--) {
            request[roll() % (unsigned)length] = (char)roll();
        }
        length = roll() % 4 ? length : (int)(roll() % (unsigned)length) + 1;
        send_and_leave(request, (size_t)length);
    }
    test_state_tells(NULL);
}

/* Silent clients hold every connection there is, half-open ones among them: who comes beyond those
 * is sent away, and served again after the time that a silent one has (5 s). */
static void test_slow_clients(void **state)
{
    (void)state;
    int slow[20];
    for (int i = 0; i < 20; i++) {
        slow[i] = client_connect();
        if (i % 2) {
            assert_int_equal(send(slow[i], "GET /st", 7, MSG_NOSIGNAL), 7);
        }
    }
    double begin = now_seconds();
    int refused = -1;
    do {
        refused++;
        nanosleep(&(struct timespec){.tv_nsec = 100000000}, NULL);
        ask("GET", "/state", token, "", "");
    } while (!strstr(answer, "\"step\": 1234") && now_seconds() - begin < 20);
    assert_true(refused > 0); /* the clients were enough */
    assert_true(now_seconds() - begin < 8);
    for (int i = 0; i < 20; i++) {
        close(slow[i]);
    }
}

/* One that always sends a little more is ended all the same, 20 s after it came. */
static void test_dripping_client(void **state)
{
    (void)state;
    int drip = client_connect();
    double begin = now_seconds();
    send(drip, "GET / HTTP/1.1\r\nHost: ", 22, MSG_NOSIGNAL);
    while (send(drip, "x", 1, MSG_NOSIGNAL) == 1 && now_seconds() - begin < 30) {
        nanosleep(&(struct timespec){.tv_nsec = 500000000}, NULL);
    }
    double lived = now_seconds() - begin;
    close(drip);
    assert_true(lived > 15 && lived < 25);
}

static void test_bound_to_the_loopback(void **state)
{
    (void)state;
    char line[256], own[32];
    int found = 0;
    FILE *file = fopen("/proc/net/tcp", "r");
    assert_non_null(file);
    snprintf(own, sizeof own, ":%04X 00000000:0000 0A", port);
    while (fgets(line, sizeof line, file)) {
        if (strstr(line, own)) {
            assert_non_null(strstr(line, " 0100007F:"));
            found++;
        }
    }
    fclose(file);
    assert_int_equal(found, 1);
    OzPage *second = NULL;
    OzPageSettings taken_port = {.port = port, .title = "x"};
    assert_int_equal(oz_page_open(&second, &taken_port), OZ_ERR_FILE);
    assert_null(second);
    assert_non_null(strstr(oz_status_text(), "give another port"));
}

/* A watched page tells the run's end before it closes, and does not wait long. */
static void test_end(void **state)
{
    (void)state;
    ask("GET", "/state", token, "", "");
    oz_page_show(page, &(OzPageStatus){.step = 99, .done = true, .progress = 1});
    double begin = now_seconds();
    oz_page_close(page);
    page = NULL;
    double spent = now_seconds() - begin;
    assert_true(spent > 1 && spent < 3); /* nobody looked again */
    int gone = client_try();
    assert_int_equal(gone, -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_who_is_let_in),         cmocka_unit_test(test_what_is_refused),
        cmocka_unit_test(test_state_tells),           cmocka_unit_test(test_set),
        cmocka_unit_test(test_picture_and_rows),      cmocka_unit_test(test_nonsense),
        cmocka_unit_test(test_slow_clients),          cmocka_unit_test(test_dripping_client),
        cmocka_unit_test(test_bound_to_the_loopback), cmocka_unit_test(test_end),
    };
    return cmocka_run_group_tests(tests, open_page, close_page);
}
