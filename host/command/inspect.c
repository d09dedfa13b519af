/* Printing what follows from a scene. */
#include "command/inspect.h"

#include "base/log.h"
#include "command/inspect_contacts.h"
#include "command/inspect_elements.h"
#include "command/inspect_motion.h"
#include "command/inspect_range.h"
#include "command/inspect_verdict.h"
#include "report/report_bed.h"
#include "run/members.h"
#include "run/protocol.h"
#include "scene/keys.h"
#include "scene/mixing.h"
#include "scene/phases.h"

#include <math.h>
#include <stdlib.h>

/* s of computing: 1000 rods come to rest in less on any machine of today. */
#define PATIENCE 4.0

/* s of timed steps: a thousand of 1000 rods, and some of as many as fit the machine. */
#define STRETCH 0.4

static void print_grains(FILE *file, const OzGrains *grains)
{
    fprintf(file, "grains             %lld\n", (long long)grains->count);
    oz_inspect_range_print_all(file, "diameter", grains->diameter, NULL, grains->count, "m");
    oz_inspect_range_print_all(file, "length", grains->length, NULL, grains->count, "m (shaft)");
    oz_inspect_range_print_all(file, "mass", grains->mass, NULL, grains->count, "kg");
    oz_inspect_range_print_all(file, "inertia", grains->inertia, NULL, grains->count,
                               "kg m^2, across the shaft");
    oz_inspect_range_print_all(file, "inertia_axis", grains->inertia_axis, NULL, grains->count,
                               "kg m^2, about it");
    oz_inspect_range_print_places(file, grains->position, grains->count, false);
}

static OzStatus judge_phases(const OzScene *scene, const OzGrains *grains, bool forced)
{
    OzReplay phases = {0};
    OzStatus status = oz_protocol_make(&phases, scene, grains, forced, 0);
    oz_replay_free(&phases);
    return status;
}

/* Whether a run would refuse member i of a sweep; said by name. */
static OzStatus judge_member(const OzMembers *plan, int64_t i)
{
    OzScene scene = {0};
    OzGrains grains = {0};
    char *name = NULL;
    OzStatus status = oz_members_load(plan, i, &scene, &grains);
    status = status == OZ_OK ? judge_phases(&scene, &grains, plan->options->force) : status;
    if (status != OZ_OK && oz_members_name(plan, i, &name) == OZ_OK) {
        oz_log_line("%s: %s", name, oz_status_text());
    }
    free(name);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

/* Fails as a run of the scene would before its first step. */
static OzStatus judge(const OzOptions *options, const OzScene *scene, const OzGrains *grains)
{
    OzMembers plan = {0};
    OzStatus status = OZ_OK, loss = OZ_OK;
    int64_t lost = 0;
    if (scene->sweep.count == 0) {
        OZ_PASS(oz_members_judge(scene, grains, options->force));
        return judge_phases(scene, grains, options->force);
    }
    OZ_TRY(oz_members_create(&plan, options));
    for (int64_t i = 0; i < plan.count; i++) {
        OzStatus own = judge_member(&plan, i);
        loss = loss == OZ_OK ? own : loss;
        lost += own != OZ_OK;
    }
    if (lost > 0) {
        status = oz_status_fail(loss, "%lld of %lld members cannot be run", (long long)lost,
                                (long long)plan.count);
    }
done:
    oz_members_free(&plan);
    return status;
}

static void print_heading(FILE *file, const OzScene *scene)
{
    fprintf(file, "scene              %s%s%s\n", scene->path, scene->title ? ": " : "",
            scene->title ? scene->title : "");
}

static void print_steps(FILE *file, const OzScene *scene)
{
    char steps[32] = "endless";
    if (isfinite(scene->duration)) {
        snprintf(steps, sizeof steps, "%.0f steps", round(scene->duration / scene->step));
    }
    fprintf(file, "integrator         %s, step %g s, %s\n",
            oz_keys_choice_name("integrator", (int)scene->integrator), scene->step, steps);
    if (scene->step != scene->written_step) {
        fprintf(file, "  step             %.17g s, fitted to the contact time: %g was written\n",
                scene->step, scene->written_step);
    }
}

static void print_phases(FILE *file, const OzScene *scene)
{
    for (int i = 0; i < scene->phase_count; i++) {
        const OzPhase *phase = &scene->phases[i];
        double begin = oz_phases_begin(scene, i);
        fprintf(file, "phase %-12d %s%s%.6g ... %.6g s%s%s\n", i + 1,
                phase->name ? phase->name : "", phase->name ? ", " : "", begin,
                begin + phase->length, phase->set ? ": " : "", phase->set ? phase->set : "");
    }
    if (scene->cycles > 1) {
        fprintf(file, "cycles             %lld of %.6g s\n", (long long)scene->cycles,
                oz_phases_begin(scene, scene->phase_count));
    }
}

/* What the verdict rests on. */
static OzStatus print_details(FILE *file, const OzVerdict *v)
{
    print_steps(file, v->scene);
    print_phases(file, v->scene);
    if (v->scene->model == OZ_MODEL_TRIGRAINS) {
        return oz_inspect_elements_print(file, v->scene, v->grains);
    }
    print_grains(file, v->grains);
    if (v->scene->boundary.present) {
        double volume = 0;
        for (int64_t i = 0; i < v->grains->count; i++) {
            volume += oz_grains_volume(v->grains->diameter[i], v->grains->length[i]);
        }
        oz_inspect_range_print_cell(file, v->scene, volume);
    }
    oz_inspect_motion_print(file, v->scene);
    OZ_PASS(oz_inspect_contacts_print(file, v->scene, v->grains));
    oz_report_bed_print(file, v->scene, v->rehearsal);
    return OZ_OK;
}

/* What becomes of the scene on the device. */
static OzStatus print_kernels(FILE *file, const OzVerdict *v)
{
    const OzScene *scene = v->scene;
    if (!scene->movie.present && scene->snapshots.count == 0 && !(scene->snapshots.strobe > 0)) {
        fprintf(file, "not opened         GL and libav (neither movie nor snapshots)\n");
    }
    return oz_sim_describe(v->device, scene, v->grains, file);
}

static OzStatus print_all(FILE *file, const OzVerdict *v)
{
    print_heading(file, v->scene);
    OZ_PASS(oz_inspect_verdict_print(file, v));
    OZ_PASS(print_details(file, v));
    OZ_PASS(v->options->verbose ? print_kernels(file, v) : OZ_OK);
    fflush(file);
    return OZ_OK;
}

/* Everything that was opened for an inspection. Zeroed is valid. */
typedef struct Inspection {
    OzScene scene;
    OzGrains grains;
    OzDevice device;
    OzRehearsal rehearsal;
    char burst[1024]; /* why the rehearsal was stopped by a guard, if it was */
} Inspection;

static OzStatus open_all(Inspection *in, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_scene_load(&in->scene, options->paths[0], options->settings, options->setting_count));
    oz_mixing_say(&in->scene);
    OZ_TRY(oz_members_place(&in->grains, &in->scene));
    OZ_TRY(oz_device_open(&in->device, options->device, options->threads));
    status = oz_rehearsal_run(&in->rehearsal, &in->scene, &in->grains, &in->device,
                              options->source_dir, PATIENCE, STRETCH);
    if (status == OZ_ERR_BLOWUP) { /* which an unstable step explains, once it is judged */
        snprintf(in->burst, sizeof in->burst, "%s", oz_status_text());
        status = OZ_OK;
    }
done:
    return status;
}

static void close_all(Inspection *in)
{
    oz_rehearsal_free(&in->rehearsal);
    oz_device_close(&in->device);
    oz_grains_free(&in->grains);
    oz_scene_free(&in->scene);
}

OzStatus oz_inspect_scene(const OzOptions *options, FILE *file)
{
    OzStatus status = OZ_OK;
    Inspection in = {0};
    OZ_TRY(open_all(&in, options));
    const OzVerdict verdict = {options, &in.scene, &in.grains, &in.device, &in.rehearsal, in.burst};
    OZ_TRY(print_all(file, &verdict));
    OZ_TRY(judge(options, &in.scene, &in.grains));
    if (in.burst[0]) {
        status = oz_status_fail(OZ_ERR_BLOWUP, "%s", in.burst);
    }
done:
    close_all(&in);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
