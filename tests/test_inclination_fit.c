/* A constant and a power of a drum's speed: the fit of exact and of noisy points, and what the end
 * of an ensemble makes of its members' series. */
#include "program.h"

#include "base/log.h"
#include "base/random.h"
#include "observe/power_fit.h"
#include "run/ensemble_tables.h"

#include <math.h>

enum { SPEEDS = 9 };
static const double speeds[SPEEDS] = {0.05, 0.1, 0.2, 0.5, 1, 2, 3, 4, 5};

static double curve(double constant, double factor, double exponent, double x)
{
    return constant + factor * pow(x, exponent);
}

/* The sum of squares is flat within the square root of rounding, 1e-8, about its least. */
static void test_exact(void **state)
{
    (void)state;
    const double rows[][3] = {{24, 0.7, 2}, {30, -1.5, 0.5}, {-3, 12, 1}, {20, 1e-3, 5.5}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double y[SPEEDS];
        OzPowerFit fit;
        for (int k = 0; k < SPEEDS; k++) {
            y[k] = curve(rows[i][0], rows[i][1], rows[i][2], speeds[k]);
        }
        assert_true(oz_power_fit_find(&fit, speeds, y, SPEEDS));
        /* ten times 1e-8, for what the other two give to each */
        assert_true(fabs(fit.constant / rows[i][0] - 1) < 1e-7);
        assert_true(fabs(fit.factor / rows[i][1] - 1) < 1e-7);
        assert_true(fabs(fit.exponent / rows[i][2] - 1) < 1e-7);
        assert_true(fit.residual < 1e-7);
        assert_false(fit.open);
    }
}

/* Of many noisy sets 95 % of the intervals must hold the true exponent: of 400, 380 with a standard
 * deviation of 4.4; four of them are allowed. Residuals of 9 points and 3 free numbers are, root
 * mean square, sqrt(6 / 9) of the noise. */
static void test_noise(void **state)
{
    (void)state;
    enum { SETS = 400 };
    const double noise = 0.5;
    OzRandom random = oz_random_stream(1, 0);
    double squares = 0;
    int inside = 0;
    for (int i = 0; i < SETS; i++) {
        double y[SPEEDS];
        OzPowerFit fit;
        for (int k = 0; k < SPEEDS; k++) {
            double normal = 0;
            for (int n = 0; n < 12; n++) {
                normal += oz_random_uniform(&random, -0.5, 0.5);
            }
            y[k] = curve(24, 0.7, 2, speeds[k]) + noise * normal;
        }
        assert_true(oz_power_fit_find(&fit, speeds, y, SPEEDS));
        inside += fit.exponent_low < 2 && fit.exponent_high > 2;
        squares += fit.residual * fit.residual / SETS;
    }
    print_message("true exponent inside %d of %d; residual %.3f\n", inside, SETS, sqrt(squares));
    assert_in_range(inside, 380 - 18, 380 + 18);
    /* 400 x 6 squares: their mean is known to sqrt(2 / 2400) = 3 %, its root to half of that. */
    assert_true(fabs(sqrt(squares) / (noise * sqrt(6.0 / 9)) - 1) < 0.06);
}

static void test_too_little(void **state)
{
    (void)state;
    const double x[] = {1, 2, 3, 3}, y[] = {1, 4, 9, 9}, level[SPEEDS] = {0};
    OzPowerFit fit;
    assert_false(oz_power_fit_find(&fit, x, y, 4));
    assert_true(oz_power_fit_find(&fit, speeds, level, SPEEDS));
    assert_true(fit.open);
    assert_true(fit.factor == 0);
}

/* Members of a sweep whose last row is on the curve, two seeds on either side of it; the first row
 * must not count. */
static void end_ensemble(const char *key, int count)
{
    OzEnsemble *ensemble = NULL;
    OzLog *log = NULL;
    assert_int_equal(OZ_OK, oz_log_create(&log, NULL, false));
    assert_int_equal(OZ_OK, oz_log_open(log, "log.txt"));
    oz_log_use(log);
    assert_int_equal(OZ_OK, oz_ensemble_tables_create(&ensemble, ".", key));
    for (int m = 0; m < 2 * count; m++) {
        char name[32], file[64], value[32];
        double speed = speeds[m / 2];
        snprintf(name, sizeof name, "member_%d", m);
        snprintf(file, sizeof file, "%s/series.csv", name);
        snprintf(value, sizeof value, "-%g", speed);
        mkdir(name, 0777);
        write_file(file, "step,time,tap,inclination_mean\n0,0,,1\n9,1,,%.17g\n",
                   curve(24, 0.7, 2, speed) + (m % 2 ? 3 : -3));
        OzEnsembleRow row = {name, (uint64_t)(m % 2), value, "done", true, NULL};
        assert_int_equal(OZ_OK, oz_ensemble_tables_add(ensemble, &row));
    }
    assert_int_equal(OZ_OK, oz_ensemble_tables_finish(ensemble));
    oz_log_use(NULL);
    oz_log_free(log);
}

static void test_ensemble(void **state)
{
    (void)state;
    double constant, factor, exponent, low, high, residual;
    int count;
    end_ensemble("walls.0.motion.frequency", SPEEDS);
    assert_false(contains("log.txt", "Theta_c"));
    end_ensemble("contact.friction,walls.0.motion.angular_velocity", SPEEDS);
    assert_false(contains("log.txt", "Theta_c"));
    end_ensemble("walls.0.motion.angular_velocity", 3);
    assert_true(contains("log.txt", "needs 4 different speeds"));
    assert_false(is_there("inclination_fit.csv"));
    end_ensemble("walls.0.motion.angular_velocity", SPEEDS);
    assert_true(contains("log.txt", "Theta_c 24 degrees, b 0.7, p 2 "));
    char *text = read_file("inclination_fit.csv", NULL);
    assert_int_equal(sscanf(text,
                            "theta_c,b,p,p_low,p_high,residual_rms,speeds\n"
                            "%lf,%lf,%lf,%lf,%lf,%lf,%d\n",
                            &constant, &factor, &exponent, &low, &high, &residual, &count),
                     7);
    free(text);
    /* as above; the file has nine digits */
    assert_true(fabs(constant - 24) < 1e-7 && fabs(factor - 0.7) < 1e-7 &&
                fabs(exponent - 2) < 1e-7);
    assert_int_equal(count, SPEEDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact),
        cmocka_unit_test(test_noise),
        cmocka_unit_test(test_too_little),
        cmocka_unit_test(test_ensemble),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
