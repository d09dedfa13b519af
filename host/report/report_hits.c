/* Meetings of two grains, one for each member of the scene's plan, and what they come to in words,
 * numbers and a picture. */
#include "report/report_hits.h"

#include "base/folder.h"
#include "base/gnuplot.h"
#include "base/log.h"
#include "base/memory.h"
#include "model/beam_limits.h"
#include "observe/hits.h"
#include "run/members.h"
#include "sim/element_reference.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One meeting of two grains. */
typedef struct Meeting {
    OzHits hits;                /* still touching: the scene ends too early           */
    double speed;               /* m/s, relative, at the start                        */
    double angular_velocity[2]; /* at the scene's end, x edge / speed: the edge of the
                                   square of the grain's area                         */
} Meeting;

enum { LOOKS = 25, PATH_SIZE = 1024, SHARES_SIZE = 12 * OZ_HITS_SPANS };

/* From which the number of hits is always told too: where it changes hangs on the rule. */
static const double shares_told[] = {0.03, 0.05, 0.1};

static double share_of(const OzOptions *options)
{
    return options->share > 0 ? options->share : OZ_HITS_SHARE;
}

static OzStatus refuse(const OzScene *scene, const OzGrains *grains)
{
    if (scene->model != OZ_MODEL_TRIGRAINS || grains->count != 2 || scene->wall_count > 0 ||
        scene->settle.present) {
        return oz_status_fail(
            OZ_ERR_INPUT,
            "%s: hits are counted of two grains alone; expected model: trigrains, "
            "2 grains (there are %lld), no walls and no settle",
            scene->path, (long long)grains->count);
    }
    return OZ_OK;
}

/* Steps from look to look: so far apart that a meeting is followed quickly, and close enough that
 * no hit is missed. */
static OzStatus find_stride(int64_t *stride, const OzScene *scene, const OzGrains *grains)
{
    OzBeamLimit limit;
    OzStatus status = oz_beam_limits_find(&limit, scene, grains);
    double period = status == OZ_OK && limit.rate > 0 ? 8 * atan(1) / limit.rate : 0;
    *stride = (int64_t)(period / (LOOKS * scene->step));
    *stride = *stride > 1 ? *stride : 1;
    return status;
}

static double edge_of(const OzElements *elements, int64_t grain)
{
    double area = 0;
    for (int64_t i = elements->first[grain]; i < elements->first[grain + 1]; i++) {
        area += elements->area[i];
    }
    return sqrt(area);
}

static OzStatus walk(Meeting *meeting, OzElementReference *reference, OzSnapshot *now,
                     int64_t stride)
{
    int64_t last = llround(now->scene->duration / now->scene->step);
    for (int64_t step = 0;; step = step + stride < last ? step + stride : last) {
        OZ_PASS(oz_element_reference_advance(reference, step));
        OZ_PASS(oz_element_reference_snapshot(reference, now));
        oz_hits_look(&meeting->hits, now);
        if (step == last) {
            break;
        }
    }
    return OZ_OK;
}

/* Follows the scene's two grains to its end, looking at them 25 times in a period of their fastest
 * vibration, at every step at most. */
static OzStatus follow(Meeting *meeting, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    OzElementReference *reference = NULL;
    OzSnapshot now = {0};
    int64_t stride;
    *meeting = (Meeting){0};
    OZ_TRY(refuse(scene, grains));
    const double *v = grains->velocity;
    meeting->speed = hypot(v[0] - v[3], v[1] - v[4]);
    if (meeting->speed <= 0) {
        OZ_TRY(oz_status_fail(OZ_ERR_INPUT,
                              "%s: the two grains have one velocity; expected a "
                              "velocity of either",
                              scene->path));
    }
    OZ_TRY(find_stride(&stride, scene, grains));
    OZ_TRY(oz_element_reference_create(&reference, scene, grains));
    OZ_TRY(oz_snapshot_create(&now, scene, grains));
    OZ_TRY(walk(meeting, reference, &now, stride));
    for (int g = 0; g < 2; g++) {
        meeting->angular_velocity[g] =
            now.angular_velocity[3 * g + 2] * edge_of(grains->elements, g) / meeting->speed;
    }
done:
    oz_snapshot_free(&now);
    oz_element_reference_free(reference);
    return status;
}

/* Shares of all spans in order of time, as in "0.62 0.001 0.38". */
static void list_shares(const OzHits *hits, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < hits->span_count && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%.3g", i ? " " : "",
                                 oz_hits_share(hits, i));
    }
}

static void write_row(FILE *csv, const OzMembers *plan, int64_t i, const Meeting *m)
{
    char shares[SHARES_SIZE];
    const char *value = oz_members_value(plan, i);
    int count = oz_hits_count(&m->hits, share_of(plan->options));
    list_shares(&m->hits, shares, sizeof shares);
    printf("  %12s %8.4g %5d %9.3f %9.3f  %s%s\n", value ? value : "-", m->speed, count,
           m->angular_velocity[0], m->angular_velocity[1], shares,
           m->hits.touching ? " (still touching at the end: a longer time.duration is needed)"
                            : "");
    fprintf(csv, "%s,%" PRIu64 ",%.9g,%d,%d,%.9g,%.9g,%s\n", value ? value : "",
            oz_members_seed(plan, i), m->speed, count, m->hits.touching, m->angular_velocity[0],
            m->angular_velocity[1], shares);
    fflush(stdout);
}

static OzStatus follow_all(Meeting *meetings, const OzMembers *plan, FILE *csv)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    const char *key = plan->scene.sweep.key;
    printf("%s: hits of two grains; one counts from %g %% of the impulse of all on\n"
           "  %12.12s %8s %5s %9s %9s  shares of the impulse, in order of time\n",
           plan->scene.path, 100 * share_of(plan->options), key ? "value" : "", "m/s", "hits",
           "spin 0", "spin 1");
    fprintf(csv, "%s,seed,speed,hits,touching,spin_0,spin_1,shares\n", key ? key : "value");
    for (int64_t i = 0; i < plan->count; i++) {
        OZ_TRY(oz_members_load(plan, i, &scene, &grains));
        OZ_TRY(follow(&meetings[i], &scene, &grains));
        write_row(csv, plan, i, &meetings[i]);
        oz_grains_free(&grains);
        oz_scene_free(&scene);
    }
done:
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

/* Neighbours in the order written, of one seed. */
static void say_changes(const Meeting *meetings, const OzMembers *plan, double share)
{
    const char *key = plan->scene.sweep.key;
    bool changed = false;
    for (int64_t i = 0; i + plan->seed_count < plan->count; i++) {
        const Meeting *one = &meetings[i], *next = &meetings[i + plan->seed_count];
        int before = oz_hits_count(&one->hits, share), after = oz_hits_count(&next->hits, share);
        if (before != after) {
            printf("counted from %g %% of the impulse: hits change from %d to %d between %s = %s "
                   "and %s, %.4g and %.4g m/s (seed %" PRIu64 ")\n",
                   100 * share, before, after, key, oz_members_value(plan, i),
                   oz_members_value(plan, i + plan->seed_count), one->speed, next->speed,
                   oz_members_seed(plan, i));
            changed = true;
        }
    }
    if (!changed && plan->scene.sweep.count > 1) {
        printf("counted from %g %% of the impulse: hits do not change over %s\n", 100 * share, key);
    }
}

static void say_all_changes(const Meeting *meetings, const OzMembers *plan)
{
    double asked = share_of(plan->options);
    say_changes(meetings, plan, asked);
    for (size_t k = 0; k < sizeof shares_told / sizeof shares_told[0]; k++) {
        if (shares_told[k] != asked) {
            say_changes(meetings, plan, shares_told[k]);
        }
    }
    printf("spin: at the end, x edge / speed\n");
}

static void send_points(FILE *gnuplot, const Meeting *meetings, int64_t count, double share)
{
    fprintf(gnuplot, "$spins << EOD\n");
    for (int64_t i = 0; i < count; i++) {
        const Meeting *m = &meetings[i];
        fprintf(gnuplot, "%.9g %.9g %.9g %d\n", m->speed, fabs(m->angular_velocity[0]),
                fabs(m->angular_velocity[1]), oz_hits_count(&m->hits, share));
    }
    fprintf(gnuplot, "EOD\n$shares << EOD\nNaN NaN\n");
    for (int64_t i = 0; i < count; i++) {
        for (int k = 0; k < meetings[i].hits.span_count; k++) {
            fprintf(gnuplot, "%.9g %.9g\n", meetings[i].speed, oz_hits_share(&meetings[i].hits, k));
        }
    }
    fprintf(gnuplot, "EOD\n");
}

static OzStatus draw(const char *folder, const Meeting *meetings, int64_t count, double share)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_gnuplot_open(&gnuplot, folder, "hits.png"));
    if (!gnuplot) {
        return OZ_OK;
    }
    send_points(gnuplot, meetings, count, share);
    fprintf(gnuplot,
            "set terminal pngcairo size 1300,560 noenhanced font 'DejaVu Sans,11'\n"
            "set output '%s/hits.png'\nset multiplot layout 1,2\nset key below\nset bmargin 6\n"
            "set xlabel 'speed, m/s'\nset xrange [0:*]\nset offsets graph 0.02, graph 0.05, 0, 0\n"
            "set ylabel 'share of the impulse'\nset logscale y\nset yrange [1e-6:3]\nset format y "
            "'%%g'\n"
            "set title 'Spans of touching, and how many count (above)'\n"
            "plot $shares using 1:2 with points pt 7 ps 1.1 lc rgb '#0072b2' title 'each span', "
            "%g with lines dt 2 lc rgb '#d55e00' title 'counts as a hit from here on', "
            "$spins using 1:(1.8):(sprintf('%%d', $4)) with labels notitle\n"
            "unset logscale y\nset yrange [0:*]\nset offsets graph 0.02, graph 0.05, graph 0.1, 0\n"
            "set ylabel '|spin| x edge / speed'\nset title 'Spin at the end'\n"
            "plot $spins using 1:2 with linespoints pt 7 ps 1.3 lw 3 lc rgb '#0072b2' title 'first "
            "grain', "
            "$spins using 1:3 with linespoints pt 6 ps 1.8 dt 2 lc rgb '#e69f00' title 'second "
            "grain'\n",
            folder, share);
    return oz_gnuplot_close(gnuplot, folder, "hits.png");
}

OzStatus oz_report_hits_run(const OzOptions *options, const char *folder)
{
    OzStatus status = OZ_OK;
    OzMembers plan = {0};
    const OzFolderUse use = {.keep = true};
    OzFolder owned = {0};
    Meeting *meetings = NULL;
    FILE *csv = NULL;
    char path[PATH_SIZE];
    if (options->path_count != 1) {
        OZ_TRY(oz_status_fail(OZ_ERR_INPUT, "orzo report --hits: %d scenes; expected one",
                              options->path_count));
    }
    OZ_TRY(oz_members_create(&plan, options));
    OZ_TRY(OZ_NEW(&meetings, plan.count));
    OZ_TRY(oz_folder_open(&owned, folder, &use));
    OZ_TRY(oz_folder_create_file(&csv, folder, "hits.csv"));
    OZ_TRY(oz_folder_note(folder, "hits.png"));
    snprintf(path, sizeof path, "%s/hits.csv", folder);
    status = follow_all(meetings, &plan, csv);
    if (fclose(csv) != 0 && status == OZ_OK) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    OZ_TRY(status);
    say_all_changes(meetings, &plan);
    OZ_TRY(draw(folder, meetings, plan.count, share_of(options)));
    oz_log_line("%s and hits.png", path);
done:
    free(meetings);
    oz_members_free(&plan);
    oz_folder_close(&owned);
    return status;
}
