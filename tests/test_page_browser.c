/* The page in a browser: headless Chromium, driven through its own pipe by
 * keyboard alone. Skipped where there is no Chromium. */
#include "page_client.h"

#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <png.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

static pid_t browser;
static int to_browser, from_browser, call_number;
static char reply[1 << 24], session[80], profile[] = "/tmp/orzo-browser-XXXXXX";
static char friction[32] = "0.1";

static void show_keys(void)
{
    const OzPageKey key = {"contact.friction", friction, "", "Coulomb's coefficient", 0, 10, NULL};
    assert_int_equal(oz_page_show_keys(page, &key, 1), OZ_OK);
}

static bool fake_set(void *context, const char *key, const char *value, char *message, size_t size)
{
    bool taken = strtod(value, NULL) <= 1;
    (void)context;
    snprintf(message, size, taken ? "%s %s -> %s" : "%s %s: %s is too much", key, friction, value);
    if (taken) {
        snprintf(friction, sizeof friction, "%s", value);
        show_keys();
    }
    return taken;
}

/* A picture of one colour. */
static void show_picture(unsigned char red, unsigned char green)
{
    static unsigned char pixels[320 * 180 * 3];
    for (size_t i = 0; i < sizeof pixels; i += 3) {
        pixels[i] = red;
        pixels[i + 1] = green;
    }
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = 320, .height = 180, .format = PNG_FORMAT_RGB};
    png_alloc_size_t length = sizeof pixels + 10000;
    char *png = malloc(length);
    assert_non_null(png);
    assert_true(png_image_write_to_memory(&image, png, &length, 0, pixels, 0, NULL));
    oz_page_show_picture(page, png, length);
}

static void exec_browser(const int down[2], const int up[2])
{
    char data[64];
    snprintf(data, sizeof data, "--user-data-dir=%s", profile);
    int null = open("/dev/null", O_RDWR), read_end = fcntl(down[0], F_DUPFD, 10);
    int write_end = fcntl(up[1], F_DUPFD, 10);
    dup2(null, 1);
    dup2(null, 2);
    dup2(read_end, 3);
    dup2(write_end, 4);
    execlp("chromium", "chromium", "--headless", "--no-sandbox", "--disable-gpu",
           "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
           "--remote-debugging-pipe", "--window-size=1400,900", data, "about:blank", (char *)NULL);
    _exit(127);
}

static bool has_browser(void)
{
    return system("command -v chromium >/dev/null 2>&1") == 0;
}

/* One message of the browser's, into `reply`. */
static void read_message(void)
{
    size_t length = 0;
    do {
        struct pollfd waits = {.fd = from_browser, .events = POLLIN};
        assert_true(length < sizeof reply - 1);
        if (poll(&waits, 1, 60000) != 1 || read(from_browser, reply + length, 1) != 1) {
            fail_msg("Chromium has not answered within 60 s");
        }
    } while (reply[length++]);
}

/* Calls a method of the DevTools protocol and waits for its answer. */
static const char *call(const char *method, const char *parameters)
{
    char text[8192], number[32];
    int length = snprintf(text, sizeof text, "{\"id\":%d,\"method\":\"%s\",%s\"params\":%s}",
                          ++call_number, method, session, parameters);
    assert_true(length > 0 && (size_t)length < sizeof text);
    assert_int_equal(write(to_browser, text, (size_t)length + 1), length + 1);
    snprintf(number, sizeof number, "{\"id\":%d,", call_number);
    do {
        read_message();
    } while (strncmp(reply, number, strlen(number)) != 0);
    if (strstr(reply, "\"error\":{")) {
        fail_msg("%s: %.500s", text, reply);
    }
    return reply;
}

/* The text after "name":" up to the next quote. */
static void take(char *into, size_t size, const char *name)
{
    char mark[40];
    snprintf(mark, sizeof mark, "\"%s\":\"", name);
    const char *found = strstr(reply, mark);
    assert_non_null(found);
    found += strlen(mark);
    snprintf(into, size, "%.*s", (int)strcspn(found, "\""), found);
}

/* Waits until an expression of the page is true, ten seconds at most; one that
 * fails is not. */
static void expect_true(const char *expression)
{
    char parameters[4096];
    double begin = now_seconds();
    snprintf(parameters, sizeof parameters, "{\"expression\":\"!!(%s)\"}", expression);
    while (!strstr(call("Runtime.evaluate", parameters), "\"value\":true")) {
        if (now_seconds() - begin > 10) {
            call("Runtime.evaluate", "{\"expression\":\"document.body.innerText\"}");
            fail_msg("not true: %s; the page says %.2000s", expression, reply);
        }
        nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    }
}

static void press(const char *key, int code, const char *text)
{
    char parameters[256];
    snprintf(parameters, sizeof parameters,
             "{\"type\":\"keyDown\",\"key\":\"%s\",\"windowsVirtualKeyCode\":%d,"
             "\"text\":\"%s\"}",
             key, code, text);
    call("Input.dispatchKeyEvent", parameters);
    snprintf(parameters, sizeof parameters,
             "{\"type\":\"keyUp\",\"key\":\"%s\",\"windowsVirtualKeyCode\":%d}", key, code);
    call("Input.dispatchKeyEvent", parameters);
}

static int start_browser(void **state)
{
    int down[2], up[2];
    char parameters[300], id[64];
    (void)state;
    if (!has_browser()) {
        return 0;
    }
    signal(SIGPIPE, SIG_IGN);
    if (!mkdtemp(profile) || pipe(down) != 0 || pipe(up) != 0) {
        return -1;
    }
    client_open_page(fake_set);
    show_keys();
    browser = fork();
    if (browser == 0) {
        exec_browser(down, up);
    }
    close(down[0]);
    close(up[1]);
    to_browser = down[1];
    from_browser = up[0];
    snprintf(parameters, sizeof parameters, "{\"url\":\"%s\"}", oz_page_address(page));
    call("Target.createTarget", parameters);
    take(id, sizeof id, "targetId");
    snprintf(parameters, sizeof parameters, "{\"targetId\":\"%s\",\"flatten\":true}", id);
    call("Target.attachToTarget", parameters);
    take(id, sizeof id, "sessionId");
    snprintf(session, sizeof session, "\"sessionId\":\"%s\",", id);
    return 0;
}

static int end_browser(void **state)
{
    char command[64];
    (void)state;
    if (browser > 0) {
        session[0] = '\0';
        call("Browser.close", "{}");
        waitpid(browser, NULL, 0);
        snprintf(command, sizeof command, "rm -rf '%s'", profile);
        oz_page_close(page);
        return system(command);
    }
    return 0;
}

static void need_browser(void)
{
    if (browser <= 0) {
        print_message("no chromium here: the page is not tried in a browser\n");
        skip();
    }
}

/* For people: with ORZO_SCREENSHOT=FILE.png the page as it is now. */
static void keep_screenshot(void)
{
    const char *path = getenv("ORZO_SCREENSHOT");
    if (path) {
        char command[400];
        call("Page.captureScreenshot", "{}");
        FILE *pipe = NULL;
        snprintf(command, sizeof command, "base64 -d >'%s'", path);
        pipe = popen(command, "w");
        char *data = strstr(reply, "\"data\":\"");
        assert_non_null(data);
        fwrite(data + 8, 1, strcspn(data + 8, "\""), pipe);
        pclose(pipe);
    }
}

static void test_shows_what_it_is_at(void **state)
{
    (void)state;
    need_browser();
    expect_true("document.getElementById('step').textContent === '1,234'");
    expect_true("document.title === 'a <bed>'");
    expect_true("document.getElementById('state').textContent === '25.0 %'");
    oz_page_show(page, &(OzPageStatus){.step = 5678, .time = 1, .tap = 2.5, .progress = 0.5});
    expect_true("document.getElementById('step').textContent === '5,678'");
}

/* The middle pixel's red, and later its green. */
static void test_picture_changes(void **state)
{
    static const char middle[] =
        "(() => { const c = document.createElement('canvas'), i = "
        "document.getElementById('picture'); "
        "if (!i.complete || !i.naturalWidth) return false; c.width = 1; c.height "
        "= 1; "
        "const d = c.getContext('2d'); d.drawImage(i, 160, 90, 1, 1, 0, 0, 1, "
        "1); "
        "const p = d.getImageData(0, 0, 1, 1).data; return p[0] === %d && p[1] "
        "=== %d; })()";
    char expression[1000];
    (void)state;
    need_browser();
    expect_true("document.getElementById('picture').getBoundingClientRect().height === 0");
    show_picture(200, 10);
    snprintf(expression, sizeof expression, middle, 200, 10);
    expect_true(expression);
    show_picture(20, 180);
    snprintf(expression, sizeof expression, middle, 20, 180);
    expect_true(expression);
}

static void test_plots(void **state)
{
    (void)state;
    need_browser();
    for (int i = 0; i < 100; i++) {
        oz_page_show_row(page, (double[]){0.01 * i, 20 + 10 * sin(0.1 * i), 0.5 + 0.001 * i});
    }
    expect_true("document.querySelectorAll('#plots path').length === 2");
    expect_true("[...document.querySelectorAll('#plots path')].every(p => "
                "p.getAttribute('d').split('L').length === 100)");
    /* One more column, between the others. */
    static const char *const more[] = {"time", "angle", "work_walls", "density"};
    assert_int_equal(oz_page_show_columns(page, more, 4), OZ_OK);
    oz_page_show_row(page, (double[]){1, 20, 7, 0.5});
    expect_true("document.querySelectorAll('#columns input').length === 3");
    expect_true("[...document.querySelectorAll('#plots path')].every(p => "
                "p.getAttribute('d').split('L').length === 101)");
    expect_true("[...document.querySelectorAll('#plots figcaption span')].map(s => "
                "s.textContent).join() === '0.5,20'");
}

/* Typed and sent with keys: Tab, text, Enter. */
static void type(const char *value)
{
    char parameters[100];
    call("Runtime.evaluate", "{\"expression\":\"document.getElementById('filter').focus()\"}");
    press("Tab", 9, "");
    for (int i = 0; i < 3 && !strstr(call("Runtime.evaluate",
                                          "{\"expression\":\"document."
                                          "activeElement.id === 'key-contact.friction'\"}"),
                                     "\"value\":true");
         i++) {
        press("Tab", 9, "");
    }
    call("Runtime.evaluate", "{\"expression\":\"document.activeElement.select()\"}");
    snprintf(parameters, sizeof parameters, "{\"text\":\"%s\"}", value);
    call("Input.insertText", parameters);
    press("Enter", 13, "\\r");
}

static void test_sets_and_shows_refusal(void **state)
{
    (void)state;
    need_browser();
    type("0.3");
    expect_true("document.querySelector('#log li.applied').textContent === "
                "'applied: contact.friction 0.1 -> 0.3'");
    assert_string_equal(friction, "0.3");
    type("7");
    expect_true("document.querySelector('#log li.refused').textContent === "
                "'refused: contact.friction 0.3: 7 is too much'");
    assert_string_equal(friction, "0.3");
    keep_screenshot();
}

/* A script that was not in the page does not run, and nothing from elsewhere is
 * loaded. */
static void test_policy_holds(void **state)
{
    (void)state;
    need_browser();
    call("Runtime.evaluate", "{\"expression\":\"{ const s = document.createElement('script'); "
                             "s.textContent = "
                             "'window.broken = 1'; document.body.append(s); } window.stopped = 0; "
                             "fetch('http://localhost:1/').catch(() => { window.stopped = 1; }); "
                             "0\"}");
    expect_true("window.stopped === 1 && window.broken === undefined");
}

static void test_end_is_shown(void **state)
{
    (void)state;
    need_browser();
    oz_page_show(page, &(OzPageStatus){.step = 9999, .done = true, .progress = 1});
    expect_true("document.getElementById('state').textContent === 'done'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shows_what_it_is_at),
        cmocka_unit_test(test_picture_changes),
        cmocka_unit_test(test_plots),
        cmocka_unit_test(test_sets_and_shows_refusal),
        cmocka_unit_test(test_policy_holds),
        cmocka_unit_test(test_end_is_shown),
    };
    return cmocka_run_group_tests(tests, start_browser, end_browser);
}
