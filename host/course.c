/* Settling, walking from event to event, and the end; a thread for each course but the first. */
#include "course.h"

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/stage.h"
#include "compute/capture.h"
#include "compute/settle.h"
#include "compute/stiffness.h"
#include "model/calibrate.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_course_open(OzCourse *course, const OzDevice *device, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzMember *members = NULL;
    OZ_TRY(OZ_NEW(&members, course->member_count));
    for (int64_t m = 0; m < course->member_count; m++) {
        members[m] = (OzMember){&course->members[m]->scene, &course->members[m]->grains};
    }
    OZ_TRY(oz_device_branch(&course->device, device));
    OZ_TRY(oz_sim_create(&course->sim, &course->device, members, (int)course->member_count,
                         source_dir));
done:
    free(members);
    return status;
}

void oz_course_close(OzCourse *course)
{
    oz_sim_free(course->sim);
    oz_device_close(&course->device);
    course->sim = NULL;
}

/* A member of an ensemble that did not end well: said by name, remembered, and the others go on. */
static void lose(OzOutputs *member, OzStatus why, const char *text)
{
    member->outcome = why == OZ_ERR_BLOWUP ? OZ_OUTCOME_STOPPED : OZ_OUTCOME_FAILED;
    member->loss = why;
    oz_log_line("%s: %s", member->name, text);
}

/* Ends the outputs of members that a guard has stopped; a plain run says why at its end. */
static OzStatus drop_stopped(OzCourse *course)
{
    for (int64_t m = 0; course->is_ensemble && m < course->member_count; m++) {
        OzOutputs *member = course->members[m];
        const char *why = oz_sim_stopped(course->sim, (int)m);
        if (why && member->is_open) {
            lose(member, OZ_ERR_BLOWUP, why);
            OZ_PASS(oz_outputs_close(member));
        }
    }
    return OZ_OK;
}

static bool must_end(const OzCourse *course)
{
    return oz_interrupt_asked() || atomic_load(course->ended);
}

static bool watch_settling(void *context, double time, double ratio)
{
    OzCourse *course = context;
    if (course->leads) {
        oz_stage_say(&course->stage, "settling: %.3f s, kinetic energy %.3g N m g d", time, ratio);
    }
    return !must_end(course);
}

static OzStatus settle(OzCourse *course)
{
    double seconds = 0, start = oz_clock_now();
    if (course->leads) {
        oz_stage_begin(&course->stage, "settling");
    }
    OzStatus status = oz_settle_run(course->sim, &seconds, watch_settling, course);
    if (course->leads) {
        oz_stage_end(&course->stage);
    }
    OZ_AFTER(status, drop_stopped(course));
    if (status == OZ_OK && seconds > 0) {
        const char *first = course->members[0]->name;
        const char *others = course->member_count > 1 ? " and companions " : " ";
        oz_log_line("%s%ssettling took %.3f s (%.1f s of computing)", first, first[0] ? others : "",
                    seconds, oz_clock_now() - start);
    }
    return status;
}

/* What is doubtful about contacts at this step, for one member of those alike. */
static OzStatus tell_contacts(const OzCourse *course)
{
    OzStiffness stiffness;
    OzOutputs *first = course->members[0];
    if (!course->leads || !first->is_open || !oz_stiffness_applies(&first->scene)) {
        return OZ_OK;
    }
    oz_calibrate_say(&first->scene);
    OZ_PASS(oz_capture_snapshot(course->sim, 0, &first->now, false));
    OZ_PASS(oz_stiffness_measure(&stiffness, &first->now));
    oz_stiffness_say(&stiffness, &first->scene);
    return OZ_OK;
}

static OzStatus look_at(OzCourse *course, int64_t m, int due)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = course->members[m];
    OZ_TRY(oz_capture_snapshot(course->sim, (int)m, &member->now, (due & OZ_DUE_ROW) != 0));
    OZ_TRY(oz_outputs_look(member, due));
done:
    if (status == OZ_ERR_BLOWUP && course->is_ensemble) {
        lose(member, status, oz_status_text());
        status = oz_outputs_close(member);
    }
    return status;
}

/* What is due at this step of every member that goes on; *open receives how many do. */
static OzStatus look(OzCourse *course, int due, int64_t *open)
{
    *open = 0;
    for (int64_t m = 0; m < course->member_count; m++) {
        if (course->members[m]->is_open) {
            OZ_PASS(look_at(course, m, due));
        }
        *open += course->members[m]->is_open;
    }
    return OZ_OK;
}

static void show_progress(const OzCourse *course)
{
    double step = (double)oz_sim_step(course->sim), last = (double)course->schedule.last_step;
    double spent = oz_clock_now() - course->first_step, rate = spent > 0 ? step / spent : 0;
    char left[48];
    oz_clock_words(rate > 0 ? (last - step) / rate : 0, left, sizeof left);
    oz_log_progress("%.1f %%: %.4g s simulated, %.0f steps/s, %s left",
                    last > 0 ? 100 * step / last : 100, oz_sim_time(course->sim), rate, left);
}

static OzStatus launch(OzCourse *course, int64_t step, double *shown)
{
    OzStatus status = oz_sim_launch(course->sim, step);
    OZ_AFTER(status, drop_stopped(course));
    if (status == OZ_OK && course->leads && oz_clock_now() - *shown > 0.2) {
        show_progress(course);
        *shown = oz_clock_now();
    }
    if (status == OZ_OK && must_end(course)) {
        status = oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted at step %lld, time %.9g s",
                                (long long)oz_sim_step(course->sim), oz_sim_time(course->sim));
    }
    return status;
}

static OzStatus walk(OzCourse *course)
{
    OzStatus status = OZ_OK;
    int64_t step = 0, open = course->member_count;
    int due = 0;
    double shown = 0;
    course->first_step = oz_clock_now();
    if (course->leads) {
        oz_log_line("first step %.2f s after start", course->first_step - course->started);
    }
    while (open > 0 && oz_schedule_next(&course->schedule, &step, &due)) {
        while (oz_sim_step(course->sim) < step) {
            OZ_TRY(launch(course, step, &shown));
        }
        OZ_TRY(look(course, due, &open));
    }
done:
    course->spent = oz_clock_now() - course->first_step;
    oz_log_progress(" ");
    return status;
}

/* Whether the device still has a state worth keeping: all went well, or what failed was not the
 * simulation. */
static bool has_state(OzStatus so_far)
{
    return so_far == OZ_OK || so_far == OZ_ERR_INTERRUPTED || so_far == OZ_ERR_FILE ||
           so_far == OZ_ERR_MOVIE || so_far == OZ_ERR_GRAPHICS;
}

/* The last state of a member, if there is one, and its outputs whole. */
static OzStatus end_member(OzCourse *course, int64_t m, OzStatus so_far)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = course->members[m];
    if (has_state(so_far)) {
        OZ_TRY(oz_capture_snapshot(course->sim, (int)m, &member->now, false));
        OZ_TRY(oz_outputs_write_final(member));
    }
done:
    OZ_AFTER(status, oz_outputs_close(member));
    member->outcome = so_far == OZ_OK && status == OZ_OK ? OZ_OUTCOME_DONE
                      : so_far == OZ_ERR_INTERRUPTED     ? OZ_OUTCOME_INTERRUPTED
                                                         : OZ_OUTCOME_FAILED;
    return status;
}

/* Pictures may still wait to be drawn. */
static void end_all(OzCourse *course, OzStatus *status)
{
    if (course->leads) {
        oz_stage_begin(&course->stage, "finishing files and pictures");
    }
    for (int64_t m = 0; m < course->member_count; m++) {
        if (course->members[m]->is_open) {
            OZ_AFTER(*status, end_member(course, m, *status));
        }
    }
    if (course->leads) {
        oz_stage_end(&course->stage);
    }
}

static void run_one(OzCourse *course)
{
    OzStatus status = settle(course);
    status = status == OZ_OK ? tell_contacts(course) : status;
    status = status == OZ_OK ? walk(course) : status;
    end_all(course, &status);
    /* All its members were stopped: others may do better. */
    course->status = status == OZ_ERR_BLOWUP && course->is_ensemble ? OZ_OK : status;
    snprintf(course->text, sizeof course->text, "%s", oz_status_text());
    if (course->status != OZ_OK) {
        atomic_store(course->ended, true);
    }
}

static void *run_thread(void *course)
{
    run_one(course);
    return NULL;
}

/* A course that was ended by another says that it was interrupted, which is not the reason. */
static OzStatus tell(const OzCourse *courses, int count)
{
    const OzCourse *guilty = NULL;
    for (int i = 0; i < count; i++) {
        const OzCourse *c = &courses[i];
        bool better = !guilty || guilty->status == OZ_ERR_INTERRUPTED;
        guilty = c->status != OZ_OK && better ? c : guilty;
    }
    return guilty ? oz_status_fail(guilty->status, "%s", guilty->text) : OZ_OK;
}

OzStatus oz_course_run(OzCourse *courses, int count)
{
    OzStatus status = OZ_OK;
    pthread_t *threads = NULL;
    int started = 1;
    OZ_TRY(OZ_NEW(&threads, count));
    for (; started < count; started++) {
        int code = pthread_create(&threads[started], NULL, run_thread, &courses[started]);
        if (code != 0) {
            oz_log_line("no more threads than %d: %s", started, strerror(code));
            break;
        }
    }
    run_one(&courses[0]);
    for (int i = 1; i < started; i++) {
        pthread_join(threads[i], NULL);
    }
    for (; started < count; started++) {
        run_one(&courses[started]);
    }
    status = tell(courses, count);
done:
    free(threads);
    return status;
}
