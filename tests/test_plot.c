/* `orzo plot`: a curve a column, of an ensemble one more for each member and the mean; what cannot
 * be drawn is said. ORZO_NEEDS_DEVICE. */
#include "program.h"

static const char scene[] = "model: rods\n"
                            "time: {step: 1e-4, duration: 0.1}\n"
                            "contact: {contact_time: 5e-3, restitution: 0.5}\n"
                            "grains: [{kind: random, count: 2, diameter: 1e-3}]\n"
                            "walls: [{kind: plane}]\n"
                            "observe: {interval: 0.02, walls: true}\n";

static int begin(void **state)
{
    int status = enter_work(state);
    write_file("scene.yaml", "%s", scene);
    return status;
}

/* How often a text stands in a file. */
static int count_of(const char *name, const char *text)
{
    char *all = read_file(name, NULL);
    int count = 0;
    for (const char *at = strstr(all, text); at; at = strstr(at + 1, text)) {
        count++;
    }
    free(all);
    return count;
}

/* In gnuplot's SVG every curve is a group of its own. */
static const char curve[] = "<g id=\"gnuplot_plot_";

static void a_run_is_drawn(void **state)
{
    (void)state;
    expect(0, "run/series.png", "run scene.yaml -o run");
    assert_true(is_there("run/series.png"));
    expect(0, "run/plot.svg", "plot run kinetic speed_max contact_count");
    assert_int_equal(count_of("run/plot.svg", curve), 3);
    assert_true(contains("run/plot.svg", "kinetic, J") && contains("run/plot.svg", "time, s"));
    expect(0, "run/plot.svg", "plot run wall0_fz wall0_tx");
    assert_true(contains("run/plot.svg", "wall0_fz, N<") &&
                contains("run/plot.svg", "wall0_tx, N m"));
    expect(0, "run/plot.svg", "plot run deep_count"); /* which stays 0 */
    assert_false(contains("said", "Warning"));
    char *png = read_file("run/plot.png", NULL);
    assert_memory_equal(png, "\x89PNG", 4);
    free(png);
    expect(0, "other/plot.svg", "plot run kinetic --against step -o other");
    assert_true(contains("other/plot.svg", "step"));
    expect(0, "", "run scene.yaml -o run --overwrite --no-video");
    assert_false(is_there("run/plot.png")); /* it was orzo's, and of the run before */
    assert_false(is_there("run/series.png"));
    expect(0, "", "run scene.yaml -o run --overwrite --until 0.02"); /* two rows are no curve */
    assert_false(is_there("run/series.png"));
}

static void an_ensemble_is_drawn(void **state)
{
    (void)state;
    expect(0, "", "run scene.yaml --seeds 1..3 -o many");
    assert_true(is_there("many/series.png"));
    assert_false(is_there("many/seed_00001/series.png"));
    expect(0, "", "plot many kinetic");
    assert_int_equal(count_of("many/plot.svg", curve),
                     3 + 2 + 1); /* members, interval and mean, end */
    expect(0, "", "run scene.yaml --set 'sweep={contact.friction: [0, 0.1]}' -o swept");
    expect(0, "", "plot swept kinetic");
    assert_true(contains("swept/plot.svg", "contact.friction 0.1"));
}

static void what_cannot_be_drawn_is_said(void **state)
{
    (void)state;
    expect(0, "", "run scene.yaml -o kept");
    expect(2, "has no column nonsense", "plot kept nonsense");
    expect(2, "`orzo keys --columns` says", "plot kept nonsense");
    expect(2, "column density is empty", "plot kept density");
    expect(2, "--against tap", "plot kept kinetic --against tap"); /* no wall moves */
    expect(1, "nowhere/series.csv", "plot nowhere");
    write_file("kept/plot.png", "a user's own\n");
    expect(2, "plot.png", "plot kept kinetic");
    assert_true(contains("kept/plot.png", "a user's own"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_is_drawn),
        cmocka_unit_test(an_ensemble_is_drawn),
        cmocka_unit_test(what_cannot_be_drawn_is_said),
    };
    return cmocka_run_group_tests(tests, begin, leave_work);
}
