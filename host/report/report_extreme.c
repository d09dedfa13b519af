/* Running the stiff and extreme cases. */
#include "report/report_extreme.h"

#include "model/insert.h"
#include "report/report_extreme_elements.h"
#include "report/report_refuse.h"
#include "scene/keys.h"
#include "sim/read_snapshot.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_SIZE = 4096 };

static const char *const verdicts[] = {"right", "refused", "STOPPED", "SILENTLY WRONG"};

static OzStatus read_case(OzScene *scene, const OzExtremeCase *row, OzPrecision precision,
                          bool brief)
{
    char text[TEXT_SIZE], precision_setting[64];
    char *settings[OZ_EXTREME_SETTINGS_MAX + 2];
    int count = 0;
    const OzExtremeSuite *suite = row->model == OZ_MODEL_RODS ? &oz_report_extreme_cases_suite
                                                              : &oz_report_extreme_elements_suite;
    snprintf(text, sizeof text, "%swalls:\n%sgrains:\n%s", suite->common,
             row->walls ? row->walls : suite->walls, row->grains);
    for (int i = 0; i < OZ_EXTREME_SETTINGS_MAX && row->settings[i]; i++) {
        settings[count++] = (char *)(size_t)row->settings[i];
    }
    if (brief && row->brief) {
        settings[count++] = (char *)(size_t)row->brief;
    }
    snprintf(precision_setting, sizeof precision_setting, "precision=%s",
             oz_keys_choice_name("precision", (int)precision));
    settings[count++] = precision_setting;
    return oz_scene_parse(scene, "extreme", text, settings, count);
}

static OzStatus run_case(double *value, const OzExtremeCase *row, const OzDevice *device,
                         const OzScene *scene, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzGrains grains = {0};
    OzSim *sim = NULL;
    OzSnapshot end = {0};
    OzMember member = {scene, &grains};
    OZ_TRY(oz_insert_grains(&grains, scene));
    OZ_TRY(row->forced ? OZ_OK : oz_report_refuse_unstable(scene, &grains));
    OZ_TRY(oz_sim_create(&sim, device, &member, 1, source_dir));
    OZ_TRY(oz_sim_advance(sim, oz_step_clock_nearest(oz_sim_clock(sim), scene->duration)));
    OZ_TRY(oz_snapshot_create(&end, scene, &grains));
    OZ_TRY(oz_read_snapshot_snapshot(sim, 0, &end, true));
    *value = row->value ? row->value(&end) : NAN;
done:
    oz_snapshot_free(&end);
    oz_sim_free(sim);
    oz_grains_free(&grains);
    return status;
}

bool oz_report_extreme_serves(const OzExtremeCase *row, OzPrecision precision)
{
    return precision == OZ_PRECISION_DOUBLE || row->float_high >= 0;
}

static double bound(const OzExtremeCase *row, OzPrecision precision)
{
    bool coarse = precision == OZ_PRECISION_FLOAT && row->float_high > 0;
    return coarse ? row->float_high : row->high;
}

static OzVerdict judge(const OzExtremeCase *row, OzPrecision precision, OzStatus status,
                       double value)
{
    if (status != OZ_OK) {
        bool named = !row->says || strstr(oz_status_text(), row->says);
        return row->value || !named ? OZ_VERDICT_STOPPED : OZ_VERDICT_REFUSED;
    }
    bool right = row->value && value >= row->low && value <= bound(row, precision);
    return right ? OZ_VERDICT_RIGHT : OZ_VERDICT_WRONG;
}

OzStatus oz_report_extreme_try(OzExtremeOutcome *outcome, const OzExtremeCase *row,
                               const OzDevice *device, OzPrecision precision, bool brief,
                               const char *source_dir)
{
    OzScene scene = {0};
    *outcome = (OzExtremeOutcome){.value = NAN};
    OzStatus status = read_case(&scene, row, precision, brief);
    if (status == OZ_OK) {
        status = run_case(&outcome->value, row, device, &scene, source_dir);
    }
    outcome->verdict = judge(row, precision, status, outcome->value);
    if (status != OZ_OK) {
        snprintf(outcome->message, sizeof outcome->message, "%.*s",
                 (int)sizeof outcome->message - 1, oz_status_text());
    }
    oz_scene_free(&scene);
    return status == OZ_ERR_DEVICE || status == OZ_ERR_MEMORY ? status : OZ_OK;
}

static void print_row(const OzExtremeCase *row, OzPrecision precision,
                      const OzExtremeOutcome *outcome)
{
    char expected[96] = "a message", got[32] = "a message";
    if (row->value) {
        snprintf(expected, sizeof expected, "%s %g ... %g", row->measured, row->low,
                 bound(row, precision));
    }
    if (outcome->message[0] == '\0') {
        snprintf(got, sizeof got, "%.6g", outcome->value);
    }
    printf("%-40s %-7s %-44s %-13s %s\n", row->name,
           oz_keys_choice_name("precision", (int)precision), expected, got,
           verdicts[outcome->verdict]);
    if (outcome->message[0]) {
        printf("    %s\n", outcome->message);
    }
    fflush(stdout);
}

static OzStatus run_rows(const OzExtremeCase *rows, const OzOptions *options,
                         const OzDevice *device, OzPrecision precision, int *bad)
{
    OzExtremeOutcome outcome;
    for (const OzExtremeCase *row = rows; row->name; row++) {
        if (!oz_report_extreme_serves(row, precision)) {
            continue;
        }
        OZ_PASS(oz_report_extreme_try(&outcome, row, device, precision, options->quick,
                                      options->source_dir));
        print_row(row, precision, &outcome);
        *bad += outcome.verdict == OZ_VERDICT_WRONG || outcome.verdict == OZ_VERDICT_STOPPED;
    }
    return OZ_OK;
}

OzStatus oz_report_extreme_run(const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OzDevice device = {0};
    int bad = 0;
    OZ_TRY(oz_device_open(&device, options->device, options->threads));
    printf("%-40s %-7s %-44s %-13s %s\n", "case", "numbers", "expected", "got", "verdict");
    const OzExtremeCase *lists[] = {oz_report_extreme_cases_suite.rows,
                                    oz_report_extreme_elements_suite.rows};
    for (int k = 0; k < 2; k++) {
        OZ_TRY(run_rows(lists[k], options, &device, OZ_PRECISION_FLOAT, &bad));
        if (device.has_double) {
            OZ_TRY(run_rows(lists[k], options, &device, OZ_PRECISION_DOUBLE, &bad));
        }
    }
    if (bad > 0) {
        status = oz_status_fail(OZ_ERR_BLOWUP, "%d rows are not as they should be", bad);
    }
done:
    oz_device_close(&device);
    return status;
}
