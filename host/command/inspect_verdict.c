/* The verdict of `orzo check`. */
#include "command/inspect_verdict.h"

#include "base/clock.h"
#include "command/inspect_columns.h"
#include "command/inspect_elements.h"
#include "command/inspect_materials.h"
#include "command/inspect_servos.h"
#include "command/inspect_walls.h"
#include "draw/renderer.h"
#include "model/beam_limits.h"
#include "model/prediction.h"
#include "observe/schedule.h"
#include "scene/trace.h"
#include "sim/batch_fit.h"
#include "sim/resolution.h"

#include <math.h>
#include <stdlib.h>

enum { WORDS = 48 };

/* s a pixel of encoding a movie: 9 ms for 1280 x 720 (x264, veryfast). */
#define ENCODING 1e-8

/* Beyond it a restitution is worth a word. */
#define RESTITUTION_OFF 0.01

/* The contact whose restitution is furthest from what was asked for. */
static const OzPrediction *worst_restitution(const OzPrediction *rows, int count, bool *alike)
{
    const OzPrediction *worst = &rows[0];
    *alike = true;
    for (int i = 1; i < count; i++) {
        const OzPrediction *row = &rows[i];
        *alike &= row->hits.mean == rows[0].hits.mean &&
                  row->values.restitution == rows[0].values.restitution;
        if (fabs(row->hits.mean - row->values.restitution) >
            fabs(worst->hits.mean - worst->values.restitution)) {
            worst = row;
        }
    }
    return worst;
}

static void print_advice(FILE *file, const OzScene *scene, const OzPrediction *row)
{
    double off = row->hits.mean - row->values.restitution;
    bool calibrates = scene->contact.law == OZ_LAW_HOOKE &&
                      scene->contact.restitution_calibration == OZ_CALIBRATION_NONE;
    if (fabs(off) > RESTITUTION_OFF) {
        fprintf(file, ": off by %.2g; %s gets nearer", fabs(off),
                calibrates ? "restitution_calibration: discrete or a smaller step"
                           : "a smaller step");
    }
}

static void print_restitution(FILE *file, const OzScene *scene, const OzPrediction *rows, int count)
{
    char text[WORDS];
    bool alike;
    const OzPrediction *row = worst_restitution(rows, count, &alike);
    oz_inspect_materials_place(text, sizeof text, scene, row);
    fputs("  restitution      ", file);
    if (row->values.law == OZ_LAW_HERTZ) { /* which asks for none */
        fprintf(file, "%.4g comes out at %.4g m/s\n", rows[0].hits.mean, rows[0].speed);
        return;
    }
    fprintf(file, "%.4g asked, %.4g comes out", row->values.restitution, row->hits.mean);
    if (row->hits.high - row->hits.low > 1e-3) {
        fprintf(file, " (%.3g ... %.3g by phase)", row->hits.low, row->hits.high);
    }
    if (!alike) {
        fprintf(file, ", of %s, the worst", text);
    }
    print_advice(file, scene, row);
    fputc('\n', file);
}

/* largest: s; of: the contacts that set it. */
static void print_stable(FILE *file, const OzScene *scene, double largest, const char *of)
{
    fprintf(file, "  stable           %s: step %.4g s, largest %.4g s (%s), margin %.3g\n",
            scene->step < largest ? "yes" : "NO", scene->step, largest, of, largest / scene->step);
}

static void print_stability(FILE *file, const OzVerdict *v, const OzPrediction *rows, int count)
{
    char text[WORDS];
    const OzPrediction *worst = &rows[0];
    const OzStiffness *bed = &v->rehearsal->stiffness;
    for (int i = 1; i < count; i++) {
        worst = rows[i].margin < worst->margin ? &rows[i] : worst;
    }
    oz_inspect_materials_place(text, sizeof text, v->scene, worst);
    bool of_bed =
        v->rehearsal->has_stiffness && bed->contacts > 0 && bed->largest_step < worst->largest_step;
    print_stable(file, v->scene, of_bed ? bed->largest_step : worst->largest_step,
                 of_bed ? "all contacts of the bed together" : text);
    for (int i = 0; i < count; i++) {
        if (!rows[i].tangential_stable) {
            oz_inspect_materials_place(text, sizeof text, v->scene, &rows[i]);
            fprintf(file, "  warning          the sticking spring of %s is unstable\n", text);
        }
    }
}

static OzStatus print_contacts(FILE *file, const OzVerdict *v)
{
    OzStatus status = OZ_OK;
    OzPrediction *rows = NULL;
    int count = 0;
    OZ_TRY(oz_prediction_rows(&rows, &count, v->scene, v->grains));
    print_restitution(file, v->scene, rows, count);
    print_stability(file, v, rows, count);
    OZ_TRY(oz_inspect_walls_print(file, v->scene, v->grains, rows));
    OZ_TRY(oz_resolution_print(file, v->scene, v->grains));
done:
    free(rows);
    return status;
}

static OzStatus print_beams(FILE *file, const OzVerdict *v)
{
    OzBeamLimit limit;
    char of[WORDS];
    OZ_PASS(oz_beam_limits_find(&limit, v->scene, v->grains));
    if (!isinf(limit.largest_step)) {
        snprintf(of, sizeof of, "%s of grain %lld", limit.beam < 0 ? "a contact" : "a beam",
                 (long long)limit.grain);
        print_stable(file, v->scene, limit.largest_step, of);
    }
    OZ_PASS(oz_inspect_elements_warn(file, v->scene, v->grains));
    if (v->scene->precision == OZ_PRECISION_FLOAT) {
        fputs("  resolution       float rounds away what a small step moves: energies and rest are "
              "not to be trusted\n",
              file);
    }
    return OZ_OK;
}

/* s of computing that a member's run takes; steps and settling are printed as its parts. */
static double print_computing(FILE *file, const OzVerdict *v, int64_t steps)
{
    const OzRehearsal *r = v->rehearsal;
    char words[WORDS], settling[WORDS];
    double a_step = r->spent / (double)r->steps, before = r->settled_in + r->settling_left;
    oz_clock_words((double)steps * a_step, words, sizeof words);
    oz_clock_words(before, settling, sizeof settling);
    fprintf(file, "  cost             %lld steps at %.3g us: %s", (long long)steps, 1e6 * a_step,
            words);
    if (v->scene->settle.present) {
        fprintf(file, ", after %s%s of settling", r->cut ? "at most " : "", settling);
    }
    fprintf(file, " (timed over %lld steps %s: right within a factor of two or so)\n",
            (long long)r->steps, r->cut ? "of settling" : "from the start");
    return (double)steps * a_step + before;
}

/* Seconds for a picture with its encoding; the second of two, as the first prepares the driver. */
static OzStatus time_picture(const OzVerdict *v, double *seconds)
{
    OzStatus status = OZ_OK;
    OzRenderer *renderer = NULL;
    OzImage image = {0};
    const OzSnapshot *now = &v->rehearsal->now;
    OzLook look = oz_renderer_look(v->scene, now);
    OZ_TRY(oz_renderer_create(&renderer, v->options->gl, v->options->source_dir));
    OZ_TRY(oz_image_create(&image, look.width, look.height));
    for (int i = 0; i < 2; i++) {
        double start = oz_clock_now();
        OZ_TRY(oz_renderer_draw(renderer, now, &look, &image));
        *seconds = oz_clock_now() - start + ENCODING * look.width * look.height;
    }
done:
    oz_image_free(&image);
    oz_renderer_free(renderer);
    return status;
}

/* s that the movie's pictures take beside the computing; 0 without one. */
static double print_movie(FILE *file, const OzVerdict *v, const OzSchedule *schedule)
{
    double seconds = 0;
    char words[WORDS];
    if (!v->scene->movie.present) {
        return 0;
    }
    double end = oz_step_clock_time(&schedule->clock, schedule->last_step);
    double count = floor(end / schedule->track[OZ_TRACK_FRAME].interval + 1e-9) + 1;
    fprintf(file, "  movie            %.0f pictures of %d x %d", count, v->scene->movie.width,
            v->scene->movie.height);
    if (time_picture(v, &seconds) != OZ_OK) {
        fprintf(file, "; they cannot be drawn here: %s\n", oz_status_text());
        return 0;
    }
    oz_clock_words(count * seconds, words, sizeof words);
    fprintf(file, " at %.0f ms: %s, on another core beside the computing\n", 1e3 * seconds, words);
    return count * seconds;
}

static OzStatus print_memory(FILE *file, const OzVerdict *v)
{
    OzMember member = {v->scene, v->grains};
    int64_t most = 0;
    double bytes = 0;
    OzStatus status = oz_batch_fit_most(v->device, &member, &most, &bytes);
    fprintf(file, "  memory           %.3g MB of %s\n", bytes / 1e6, v->device->name);
    return status;
}

/* The longer of computing and drawing, which wait for each other only at the end. */
static void print_sum(FILE *file, const OzScene *scene, double computing, double drawing)
{
    char words[WORDS];
    oz_clock_words(fmax(computing, drawing), words, sizeof words);
    if (scene->sweep.count > 0) {
        fprintf(file,
                "  in all           about %s for each of %d members of the sweep, as many at "
                "a time as there are cores\n",
                words, scene->sweep.count);
    } else {
        fprintf(file, "  in all           about %s\n", words);
    }
}

/* How fast a run goes that has no end. */
static void print_pace(FILE *file, const OzVerdict *v)
{
    const OzRehearsal *r = v->rehearsal;
    double a_step = r->spent / (double)r->steps, a_second = a_step / v->scene->step;
    char words[WORDS];
    oz_clock_words(a_second, words, sizeof words);
    fprintf(file,
            "  cost             endless, at %.3g us a step: a simulated second takes %s, its "
            "pictures left out\n",
            1e6 * a_step, words);
}

static OzStatus print_cost(FILE *file, const OzVerdict *v)
{
    OzSchedule schedule = oz_schedule_create(v->scene, -1);
    bool ends = isfinite(v->scene->duration);
    if (v->rehearsal->steps == 0) {
        char steps[32] = "endless";
        if (ends) {
            snprintf(steps, sizeof steps, "%lld steps", (long long)schedule.last_step);
        }
        fprintf(file, "  cost             %s, not timed%s\n", steps,
                v->burst[0] ? ": a guard stops them" : "");
    } else if (!ends) {
        print_pace(file, v);
    } else {
        double computing = print_computing(file, v, schedule.last_step);
        double drawing = print_movie(file, v, &schedule);
        print_sum(file, v->scene, computing, drawing);
    }
    return print_memory(file, v);
}

static void print_missed(FILE *file, const OzScene *scene)
{
    char missed[512];
    OzSchedule schedule = oz_schedule_create(scene, -1);
    if (oz_schedule_missed(&schedule, missed, sizeof missed)) {
        fprintf(file, "  warning          %s\n", missed);
    }
}

/* What was meant is seen by size and mass best. */
static void print_grains(FILE *file, const OzGrains *grains)
{
    const double large = 0.5; /* m: rarer in a scene than millimetres that were not converted */
    double low = INFINITY, high = 0, mass = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        low = fmin(low, grains->diameter[i]);
        high = fmax(high, grains->diameter[i]);
        mass += grains->mass[i];
    }
    fprintf(file, "  grains           %lld, %.3g to %.3g m wide, %.3g kg together%s\n",
            (long long)grains->count, low, high, mass,
            high > large ? "; lengths are metres: were millimetres meant?" : "");
}

/* How fast grains fall through a fluid in the end: mg = 3 pi eta d v + pi/8 rho C_d d^2 v^2. */
static void print_fluid(FILE *file, const OzVerdict *v)
{
    const OzDrag *drag = &v->scene->drag;
    const double pi = 3.14159265358979323846, *g = v->scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]), low = INFINITY, high = 0;
    for (int64_t i = 0; i < v->grains->count; i++) {
        double d = cbrt(6 / pi * oz_grains_volume(v->grains->diameter[i], v->grains->length[i]));
        double linear = 3 * pi * drag->viscosity * d;
        double square = pi / 8 * drag->density * drag->coefficient * d * d;
        double weight = v->grains->mass[i] * gravity;
        double speed = 2 * weight / (linear + sqrt(linear * linear + 4 * square * weight));
        low = fmin(low, speed);
        high = fmax(high, speed);
    }
    if (drag->viscosity > 0 || drag->coefficient * drag->density > 0) {
        fprintf(file, "  fluid            a grain alone falls at %.3g to %.3g m/s in the end\n",
                low, high);
    }
}

/* The strongest pull of adhesion, of the largest sphere at a wall or of two, over the lightest's
 * weight. */
static void print_adhesion(FILE *file, const OzVerdict *v)
{
    const double pi = 3.14159265358979323846, *g = v->scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]), pull = 0, weight = INFINITY;
    for (int k = 0; k < oz_mixing_contacts(v->scene); k++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, v->scene, k);
        for (int64_t i = 0; i < v->grains->count; i++) {
            int kind = oz_mixing_kind(v->scene, v->grains->population[i]);
            double radius = v->grains->diameter[i] * (mixed.wall < 0 ? 0.25 : 0.5);
            bool is_one = kind == mixed.one || kind == mixed.other;
            pull = fmax(pull, is_one ? 2 * pi * mixed.values.surface_energy * radius : 0);
            weight = fmin(weight, v->grains->mass[i] * gravity);
        }
    }
    if (pull > 0) {
        fprintf(file, "  adhesion         up to %.3g N", pull);
        if (weight > 0) {
            fprintf(file, ", %.3g times the weight of the lightest grain", pull / weight);
        }
        fputc('\n', file);
    }
}

/* Whether all walls of rods are planes across gravity, or there are none. */
static bool is_open(const OzScene *scene)
{
    const double *g = scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    bool open = gravity > 0;
    for (int w = 0; w < scene->wall_count && open; w++) {
        const double *n = scene->walls[w].normal;
        double along = fabs(n[0] * g[0] + n[1] * g[1] + n[2] * g[2]);
        open = scene->walls[w].kind == OZ_WALL_PLANE && along > (1 - 1e-9) * gravity;
    }
    return open;
}

/* Rods and spheres, whose walls hold what lies between them; trigrains' say what they are. */
static void print_container(FILE *file, const OzVerdict *verdict)
{
    if (verdict->grains->count > 1 && is_open(verdict->scene)) {
        fprintf(file, "  container        %s: nothing holds grains sideways%s\n",
                verdict->scene->wall_count ? "level planes alone" : "none",
                verdict->scene->wall_count ? "" : " or from below");
    }
}

/* What measured walls do, by which a wrong column or unit shows. */
static void print_traces(FILE *file, const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        char text[512];
        if (scene->walls[w].motion.trace) {
            oz_trace_describe(&scene->walls[w].motion, text, sizeof text);
            fprintf(file, "  wall %d follows   the %s\n", w, text);
        }
    }
}

OzStatus oz_inspect_verdict_print(FILE *file, const OzVerdict *verdict)
{
    bool flat = verdict->scene->model == OZ_MODEL_TRIGRAINS;
    fputs("verdict\n", file);
    if (verdict->burst[0]) {
        fprintf(file, "  runs             NO: %s\n", verdict->burst);
    }
    if (verdict->grains->count > 0) {
        OZ_PASS(flat ? print_beams(file, verdict) : print_contacts(file, verdict));
        print_grains(file, verdict->grains);
        if (!flat) {
            print_adhesion(file, verdict);
            print_fluid(file, verdict);
            print_container(file, verdict);
            oz_inspect_servos_print(file, verdict->scene, verdict->grains);
        }
    }
    print_traces(file, verdict->scene);
    OZ_PASS(print_cost(file, verdict));
    if (verdict->grains->count > 0) {
        fputs("  empty columns    ", file);
        oz_inspect_columns_print(file, verdict->scene, verdict->grains);
    }
    print_missed(file, verdict->scene);
    return OZ_OK;
}
