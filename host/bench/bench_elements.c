/* Measuring a step of trigrains part by part. */
#include "bench/bench_elements.h"

#include "base/clock.h"
#include "base/folder.h"
#include "base/subprocess.h"
#include "sim/element_stage_timing.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"
#include "sim/sim.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TURNS = 5, TIMED = 5000, TIMED_QUICK = 1000 };

/* Simulated seconds after settling, at which things have begun to move. */
static const double warm_time = 0.1;

typedef struct Result {
    double step;                          /* s a step, the median of turns               */
    double phase[OZ_ELEMENT_PHASE_COUNT]; /* s a call                                    */
    double refreshes, rebuilds;           /* a step                                      */
    int64_t elements, beams;
    int64_t touches[OZ_CONTACT_KINDS];
} Result;

typedef struct Job {
    const OzBenchBed *bed;
    const OzOptions *options;
    OzSim *sim;
    Result *result;
} Job;

static double clock_of(const OzDevice *device)
{
    return device->is_cpu ? oz_clock_processor() : oz_clock_now();
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static OzStatus time_steps(Job *job, const OzDevice *device)
{
    double times[TURNS];
    int64_t each = job->options->quick ? TIMED_QUICK : TIMED;
    OzSimCounts before = oz_sim_counts(job->sim);
    for (int k = 0; k < TURNS; k++) {
        double start = clock_of(device);
        OZ_PASS(oz_sim_advance(job->sim, oz_sim_step(job->sim) + each));
        times[k] = (clock_of(device) - start) / (double)each;
    }
    OzSimCounts after = oz_sim_counts(job->sim);
    qsort(times, TURNS, sizeof times[0], compare);
    job->result->step = times[TURNS / 2];
    job->result->refreshes = (double)(after.refreshes - before.refreshes) / (double)(TURNS * each);
    job->result->rebuilds = (double)(after.rebuilds - before.rebuilds) / (double)(TURNS * each);
    return OZ_OK;
}

static OzStatus count_touches(Job *job)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    OZ_TRY(oz_snapshot_create(&now, &job->bed->scene, &job->bed->grains));
    OZ_TRY(oz_read_snapshot_snapshot(job->sim, 0, &now, true));
    OzContactSums sums = oz_contact_list_sum(&now.contacts);
    memcpy(job->result->touches, sums.kinds, sizeof sums.kinds);
    job->result->elements = job->bed->grains.elements->count;
    job->result->beams = job->bed->grains.elements->beam_count;
done:
    oz_snapshot_free(&now);
    return status;
}

static OzStatus measure(void *context)
{
    OzStatus status = OZ_OK;
    Job *job = context;
    OzDevice device = {0};
    OzMember member = {&job->bed->scene, &job->bed->grains};
    const OzOptions *options = job->options;
    double settled = 0;
    OZ_TRY(oz_device_open(&device, options->device, options->threads ? options->threads : 1));
    OZ_TRY(oz_sim_create(&job->sim, &device, &member, 1, options->source_dir));
    OZ_TRY(oz_settle_run(job->sim, &settled, NULL, NULL));
    OZ_TRY(
        oz_sim_advance(job->sim, oz_step_clock_nearest(oz_sim_clock(job->sim),
                                                       fmin(warm_time, member.scene->duration))));
    OZ_TRY(time_steps(job, &device));
    OZ_TRY(count_touches(job));
    OZ_TRY(oz_element_stage_timing_measure(job->result->phase, job->sim, options->source_dir));
done:
    oz_sim_free(job->sim);
    oz_device_close(&device);
    return status;
}

static double calls_of(const Result *result, int phase)
{
    return phase == OZ_ELEMENT_PHASE_REFRESH   ? result->refreshes
           : phase == OZ_ELEMENT_PHASE_REBUILD ? result->rebuilds
                                               : 1;
}

static void print_row(const char *name, double us, double calls, double step, FILE *text, FILE *csv)
{
    double share = 100 * us * calls / step;
    fprintf(text, "%-22s %10.2f %12.5f %10.2f %8.1f %%\n", name, us, calls, us * calls, share);
    fprintf(csv, "%s,%.6g,%.6g,%.6g,%.6g\n", name, us, calls, us * calls, share);
}

/* Contacts' forces are computed by one element of code for all kinds, so its time is theirs by
 * number. */
static void print_kinds(const Result *result, double us, double step, FILE *text, FILE *csv)
{
    static const char *const names[OZ_CONTACT_KINDS] = {
        "", "  kind i", "  kind ii", "  kind iii", "  kind iv", "  kind v", "  kind vi", "  discs"};
    double all = 0;
    for (int k = 0; k < OZ_CONTACT_KINDS; k++) {
        all += (double)result->touches[k];
    }
    for (int k = 0; k < OZ_CONTACT_KINDS; k++) {
        if (result->touches[k] > 0) {
            print_row(names[k], us * (double)result->touches[k] / all, 1, step, text, csv);
        }
    }
}

static void print_table(const Result *result, const char *name, FILE *text, FILE *csv)
{
    double step = 1e6 * result->step, rest = step;
    fprintf(csv, "part,us_per_call,calls_per_step,us_per_step,percent_of_step\n");
    fprintf(text, "\nshares of %s: %lld elements, %lld beams (of a CPU: processor time)\n", name,
            (long long)result->elements, (long long)result->beams);
    fprintf(text, "%-22s %10s %12s %10s %10s\n", "part", "us a call", "calls a step", "us a step",
            "of a step");
    for (int p = 0; p < OZ_ELEMENT_PHASE_COUNT; p++) {
        double us = 1e6 * result->phase[p];
        rest -= us * calls_of(result, p);
        print_row(oz_element_stage_timing_name((OzElementPhase)p), us, calls_of(result, p), step,
                  text, csv);
        if (p == OZ_ELEMENT_PHASE_CONTACTS) {
            print_kinds(result, us, step, text, csv);
        }
    }
    print_row("the rest", rest, 1, step, text, csv);
    print_row("whole step", step, 1, step, text, csv);
}

OzStatus oz_bench_elements_print(const OzBenchBed *bed, const OzOptions *options,
                                 const char *folder, FILE *text)
{
    OzStatus status = OZ_OK;
    Result result = {0};
    Job job = {.bed = bed, .options = options, .result = &result};
    char name[256];
    FILE *csv = NULL;
    snprintf(name, sizeof name, "pieces_%s.csv", bed->scene.name);
    OZ_TRY(oz_subprocess_run(measure, &job, &result, sizeof result));
    OZ_TRY(oz_folder_create_file(&csv, folder, name));
    print_table(&result, bed->scene.name, text, csv);
done:
    if (csv) {
        fclose(csv);
    }
    return status;
}
