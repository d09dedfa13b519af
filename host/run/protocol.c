/* Phases as a replay of changes. */
#include "run/protocol.h"

#include "base/memory.h"
#include "model/step_clock.h"
#include "run/members.h"
#include "scene/phases.h"

#include <stdio.h>
#include <stdlib.h>

static bool counts_taps(const OzScene *scene)
{
    bool counts = false;
    for (int i = 0; i < scene->phase_count; i++) {
        counts |= scene->phases[i].taps > 0;
    }
    return counts;
}

static OzStatus refuse(const OzScene *scene, int phase)
{
    char why[2048];
    snprintf(why, sizeof why, "%s", oz_status_text());
    return oz_status_fail(OZ_ERR_INPUT, "%s:%d: phases.%d.set: %s", scene->path,
                          scene->phases[phase].line, phase, why);
}

/* What runs from a change on; before is what runs until then. */
static OzStatus change(OzScene *next, const OzScene *before, const OzGrains *grains, bool forced,
                       const OzReplayChange *how)
{
    OZ_PASS(oz_scene_change(next, before, how->settings, how->count));
    if (next->period != before->period && counts_taps(before)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "the period changes, in which phases are counted; expected time "
                              "instead of taps");
    }
    return oz_members_judge_step(next, grains, forced);
}

/* Later cycles go without a word. */
static OzStatus name_phase(char **what, const OzScene *scene, int64_t phase)
{
    if (phase >= scene->phase_count) {
        return OZ_OK;
    }
    const char *name = scene->phases[phase].name;
    if (asprintf(what, "phase %d%s%s", (int)phase + 1, name ? ", " : "", name ? name : "") < 0) {
        *what = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a phase's name");
    }
    return OZ_OK;
}

/* The change with which a phase begins; without settings there is none. */
static OzStatus add(OzReplay *protocol, const OzScene *scene, int64_t phase)
{
    OzReplayChange *change = &protocol->changes[protocol->count];
    const OzStepClock clock = oz_step_clock_begin(scene->step);
    change->is_quiet = phase >= scene->phase_count;
    double begin = oz_phases_begin(scene, phase);
    change->step = oz_step_clock_nearest(&clock, begin);
    change->step -=
        oz_step_clock_time(&clock, change->step) > begin + OZ_PHASES_SLACK * scene->step;
    protocol->count++;
    OZ_PASS(oz_phases_settings(&change->settings, &change->count,
                               &scene->phases[phase % scene->phase_count]));
    protocol->count -= change->count == 0;
    return change->count > 0 ? name_phase(&change->what, scene, phase) : OZ_OK;
}

OzStatus oz_protocol_make(OzReplay *protocol, const OzScene *scene, const OzGrains *grains,
                          bool forced, int64_t taken)
{
    OzStatus status = OZ_OK;
    OzScene now = {0}, next = {0};
    int judged = 0; /* the last phase's changes are followed by the first one's */
    *protocol = (OzReplay){0};
    if (scene->phase_count == 0) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&protocol->changes, oz_phases_count(scene)));
    OZ_TRY(oz_scene_copy(&now, scene));
    for (int64_t i = 0; i < oz_phases_count(scene); i++) {
        int before = protocol->count;
        OZ_TRY(add(protocol, scene, i));
        bool is_known = before < taken || judged > scene->phase_count;
        if (protocol->count == before || is_known) {
            continue;
        }
        judged++;
        status = change(&next, &now, grains, forced, &protocol->changes[before]);
        if (status != OZ_OK) {
            status =
                status == OZ_ERR_MEMORY ? status : refuse(scene, (int)(i % scene->phase_count));
            goto done;
        }
        oz_scene_free(&now);
        now = next;
        next = (OzScene){0};
    }
done:
    oz_scene_free(&now);
    oz_scene_free(&next);
    return status;
}
