/* Running ensembles and reading a member's series.csv. */
#include "report/report_member.h"

#include "base/file.h"
#include "run/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Half of the touching pairs belong to either grain. */
static double half_count(const OzScene *scene, const OzGrains *grains)
{
    (void)scene;
    return 0.5 * (double)grains->count;
}

/* What lifts all grains by a mean diameter: N m g d. */
static double lift(const OzScene *scene, const OzGrains *grains)
{
    double mass = 0, diameter = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        mass += grains->mass[i];
        diameter += grains->diameter[i] / (double)grains->count;
    }
    const double *g = scene->gravity;
    return mass * diameter * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

const OzMemberQuantity oz_report_member_quantities[OZ_MEMBER_QUANTITIES] = {
    {"density", "", "density_tap_mean", false, NULL},
    {"angle", "degrees", "angle_tap_mean", false, NULL},
    {"contacts_per_grain", "", "contact_count", false, half_count},
    {"energy_per_tap", "N m g d", "work_walls", true, lift},
};

static int column_of(const char *header, const char *name)
{
    int column = 0;
    size_t length = strlen(name);
    for (const char *at = header; *at && *at != '\n';) {
        size_t cell = strcspn(at, ",\n");
        if (cell == length && strncmp(at, name, length) == 0) {
            return column;
        }
        at += cell + (at[cell] == ',');
        column++;
    }
    return -1;
}

/* NAN where a cell is empty or the row ends before it. */
static double cell_of(const char *row, int column)
{
    for (; column > 0; column--) {
        row += strcspn(row, ",\n");
        if (*row != ',') {
            return NAN;
        }
        row++;
    }
    return *row == ',' || *row == '\n' || !*row ? NAN : strtod(row, NULL);
}

static const char *next_row(const char *row)
{
    row += strcspn(row, "\n");
    return *row ? row + 1 : row;
}

static double last_tap(const char *text, int tap)
{
    double last = NAN;
    for (const char *row = next_row(text); *row; row = next_row(row)) {
        last = cell_of(row, tap);
    }
    return last;
}

/* Over the rows of the later half: the mean, or the growth in a tap. */
static double value_of(const char *text, int tap, int column, bool per_tap)
{
    double from = 0.5 * last_tap(text, tap), sum = 0, count = 0;
    double first = NAN, first_at = NAN, last = NAN, last_at = NAN;
    for (const char *row = next_row(text); *row; row = next_row(row)) {
        if (cell_of(row, tap) >= from) {
            last = cell_of(row, column);
            last_at = cell_of(row, tap);
            first = count > 0 ? first : last;
            first_at = count > 0 ? first_at : last_at;
            sum += last;
            count++;
        }
    }
    return per_tap ? (last - first) / (last_at - first_at) : sum / count;
}

OzStatus oz_report_member_read(double values[OZ_MEMBER_QUANTITIES], const char *path,
                               const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    char *text = NULL;
    OZ_TRY(oz_file_read(&text, NULL, path));
    int tap = column_of(text, "tap");
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        const OzMemberQuantity *quantity = &oz_report_member_quantities[q];
        int column = column_of(text, quantity->column);
        values[q] = tap < 0 || column < 0 ? NAN : value_of(text, tap, column, quantity->per_tap);
        values[q] /= quantity->unit_of ? quantity->unit_of(scene, grains) : 1;
    }
done:
    free(text);
    return status;
}

OzStatus oz_report_member_mean(double *value, const char *path, const char *column)
{
    char *text = NULL;
    OzStatus status = oz_file_read(&text, NULL, path);
    if (status == OZ_OK) {
        int time = column_of(text, "time"), at = column_of(text, column);
        *value = time < 0 || at < 0 ? NAN : value_of(text, time, at, false);
    }
    free(text);
    return status;
}

OzStatus oz_report_member_order(OzMemberOrder *order, const OzOptions *options, int seeds)
{
    *order = (OzMemberOrder){.options = *options};
    if (options->setting_count + OZ_MEMBER_SETTINGS > OZ_CLI_SETTINGS_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "orzo report: at most %d --set here",
                              OZ_CLI_SETTINGS_MAX - OZ_MEMBER_SETTINGS);
    }
    order->options.out = order->folder;
    order->options.no_video = order->options.overwrite = true;
    if (!options->has_seeds) {
        order->options.has_seeds = true;
        order->options.seed_first = 1;
        order->options.seed_last = (uint64_t)seeds;
    }
    return OZ_OK;
}

void oz_report_member_set(OzMemberOrder *order, const char *key, const char *value)
{
    char *own = order->own[order->own_count++];
    snprintf(own, sizeof order->own[0], "%s=%s", key, value);
    order->options.settings[order->options.setting_count++] = own;
}

void oz_report_member_set_number(OzMemberOrder *order, const char *key, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.17g", value);
    oz_report_member_set(order, key, text);
}

OzStatus oz_report_member_run(const OzMemberOrder *order, char *reason, size_t size, bool *any)
{
    OzStatus status = oz_run_scene(&order->options);
    *any = status == OZ_OK || status == OZ_ERR_BLOWUP;
    return oz_status_outcome(status, reason, size);
}

/* A member that a guard stopped leaves no final.csv. */
bool oz_report_member_ended(const OzMemberOrder *order, uint64_t seed,
                            char path[OZ_MEMBER_PATH + 64])
{
    int length = snprintf(path, OZ_MEMBER_PATH + 64, "%s/seed_%05llu/final.csv", order->folder,
                          (unsigned long long)seed);
    bool ended = access(path, R_OK) == 0;
    snprintf(path + length - strlen("final.csv"), 16, "series.csv");
    return ended;
}
