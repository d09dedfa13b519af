/* Seeds of one variant run side by side; variants follow each other, as each may need kernels of
 * its own. */
#include "report/report_trial.h"

#include "base/embed.h"
#include "base/log.h"
#include "base/memory.h"
#include "model/insert.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"
#include "sim/sim.h"

#include <stdlib.h>
#include <string.h>

enum {
    NAME_SIZE = 128,
    SEED_SETTING = 32,
    QUICK_SEEDS = 3 /* of two the 95 % interval is thirteen times their deviation */
};

/* The members of one variant. */
typedef struct Members {
    OzScene scenes[OZ_TRIAL_SEEDS];
    OzGrains grains[OZ_TRIAL_SEEDS];
    OzSnapshot now[OZ_TRIAL_SEEDS];
    OzMember members[OZ_TRIAL_SEEDS];
    int count;
    OzSim *sim;
} Members;

static int count_variants(const OzTrial *trial)
{
    int count = 0;
    while (count < OZ_TRIAL_VARIANTS && trial->variants[count][0]) {
        count++;
    }
    return count > 0 ? count : 1;
}

static int count_seeds(const OzTrial *trial, const OzOptions *options)
{
    int count = options->quick && trial->seeds > QUICK_SEEDS ? QUICK_SEEDS : trial->seeds;
    if (options->has_seeds && trial->seeds > 1) {
        uint64_t asked = options->seed_last - options->seed_first + 1;
        count = asked < OZ_TRIAL_SEEDS ? (int)asked : OZ_TRIAL_SEEDS;
    }
    return count;
}

static OzStatus read_text(char **text, const OzTrial *trial, const OzOptions *options)
{
    char name[NAME_SIZE];
    snprintf(name, sizeof name, "scenes/%s.yaml", trial->scene);
    return oz_embed_read(text, options->source_dir, name);
}

/* The scene of one seed, with the user's settings and the variant's. */
static OzStatus load(OzScene *scene, const OzTrial *trial, int variant, uint64_t seed,
                     const char *path, const OzOptions *options)
{
    char own[SEED_SETTING], *text = NULL, *settings[OZ_CLI_SETTINGS_MAX + OZ_TRIAL_SETTINGS + 1];
    int count = options->setting_count;
    memcpy(settings, options->settings, (size_t)count * sizeof *settings);
    for (int i = 0; i < OZ_TRIAL_SETTINGS && trial->variants[variant][i]; i++) {
        settings[count++] = (char *)(size_t)trial->variants[variant][i];
    }
    snprintf(own, sizeof own, "seed=%llu", (unsigned long long)seed);
    settings[count++] = own;
    if (path) {
        return oz_scene_load(scene, path, settings, count);
    }
    OZ_PASS(read_text(&text, trial, options));
    OzStatus status = oz_scene_parse(scene, trial->scene, text, settings, count);
    free(text);
    return status;
}

static void close_members(Members *members)
{
    oz_sim_free(members->sim);
    for (int i = 0; i < OZ_TRIAL_SEEDS; i++) {
        oz_snapshot_free(&members->now[i]);
        oz_grains_free(&members->grains[i]);
        oz_scene_free(&members->scenes[i]);
    }
    free(members);
}

static OzStatus open_members(Members *members, const OzTrial *trial, int variant, const char *path,
                             const OzOptions *options)
{
    uint64_t first = options->has_seeds && trial->seeds > 1 ? options->seed_first : 1;
    for (int i = 0; i < members->count; i++) {
        OzScene *scene = &members->scenes[i];
        OZ_PASS(load(scene, trial, variant, first + (uint64_t)i, path, options));
        OZ_PASS(oz_insert_grains(&members->grains[i], scene));
        OZ_PASS(oz_snapshot_create(&members->now[i], scene, &members->grains[i]));
        members->members[i] = (OzMember){scene, &members->grains[i]};
    }
    return OZ_OK;
}

static OzStatus see(Members *members, const OzTrial *trial, OzTrialOutcome *outcome, int variant,
                    int look)
{
    for (int i = 0; i < members->count; i++) {
        if (oz_sim_stopped(members->sim, i)) {
            return oz_status_fail(OZ_ERR_BLOWUP, "%s", oz_sim_stopped(members->sim, i));
        }
        OZ_PASS(oz_read_snapshot_snapshot(members->sim, i, &members->now[i], true));
        trial->look(outcome->numbers[i][variant], &members->now[i], look);
    }
    return OZ_OK;
}

static OzStatus run_members(Members *members, const OzTrial *trial, OzTrialOutcome *outcome,
                            int variant, const OzOptions *options, const OzDevice *device)
{
    double settled;
    OZ_PASS(oz_sim_create(&members->sim, device, members->members, members->count,
                          options->source_dir));
    if (members->scenes[0].settle.present) {
        OZ_PASS(oz_settle_run(members->sim, &settled, NULL, NULL));
    }
    OZ_PASS(see(members, trial, outcome, variant, 0));
    for (int look = 1; look <= trial->looks; look++) {
        double time = members->scenes[0].duration * look / trial->looks;
        OZ_PASS(
            oz_sim_advance(members->sim, oz_step_clock_nearest(oz_sim_clock(members->sim), time)));
        OZ_PASS(see(members, trial, outcome, variant, look));
    }
    return OZ_OK;
}

OzStatus oz_report_trial_run(OzTrialOutcome *outcome, const OzTrial *trial, const char *path,
                             const OzOptions *options, const OzDevice *device)
{
    OzStatus status = OZ_OK;
    *outcome =
        (OzTrialOutcome){.seeds = count_seeds(trial, options), .variants = count_variants(trial)};
    for (int v = 0; status == OZ_OK && v < outcome->variants; v++) {
        Members *members = NULL;
        const char *setting = trial->variants[v][0];
        oz_log_progress("%s%s%s", trial->scene, setting ? ": " : "", setting ? setting : "");
        OZ_PASS(OZ_NEW(&members, 1));
        members->count = outcome->seeds;
        status = open_members(members, trial, v, path, options);
        if (status == OZ_OK) {
            status = run_members(members, trial, outcome, v, options, device);
        }
        close_members(members);
    }
    oz_log_progress("%s", "");
    return status;
}
