/* Timing features. */
#include "bench/bench_features.h"

#include "base/folder.h"
#include "base/order.h"
#include "base/subprocess.h"
#include "model/insert.h"
#include "sim/counters.h"
#include "sim/sim.h"
#include "sim/stage_timing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    TURNS = 9,         /* odd: the median is one of them                                        */
    WARM_STEPS = 32,   /* lists made, arrays touched                                            */
    SHORT_STEPS = 250, /* 5 ms of an6: the bed hardly moves although what held it is gone       */
    QUICK_TURNS = 3
};

static OzWall *find_wall(OzScene *scene, OzWallKind kind)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].kind == kind) {
            return &scene->walls[w];
        }
    }
    return NULL;
}

/* The scene's own contact values and each wall's. */
static OzContactValues *contact_of(OzScene *scene, int index)
{
    return index < 0 ? &scene->contact : &scene->walls[index].contact;
}

static void drop_friction(OzBenchBed *bed)
{
    for (int w = -1; w < bed->scene.wall_count; w++) {
        contact_of(&bed->scene, w)->friction = 0;
    }
}

static void drop_springs(OzBenchBed *bed)
{
    for (int w = -1; w < bed->scene.wall_count; w++) {
        contact_of(&bed->scene, w)->tangential_stiffness = 0;
    }
}

static void drop_cylinder(OzBenchBed *bed)
{
    OzScene *scene = &bed->scene;
    OzWall *cylinder = find_wall(scene, OZ_WALL_CYLINDER);
    if (cylinder) {
        size_t after = (size_t)(scene->walls + scene->wall_count - cylinder - 1);
        memmove(cylinder, cylinder + 1, after * sizeof *cylinder);
        scene->wall_count--;
    }
}

static void stop_floor(OzBenchBed *bed)
{
    OzWall *floor = find_wall(&bed->scene, OZ_WALL_PLANE);
    if (floor) {
        floor->motion.present = false;
    }
}

/* One grain differs in a digit that matters to no one. */
static void unequal_sizes(OzBenchBed *bed)
{
    bed->grains.mass[0] *= 1 + 1e-12;
}

static void turn_gyroscopic(OzBenchBed *bed)
{
    bed->scene.gyroscopic = !bed->scene.gyroscopic;
}

static void keep_ledger(OzBenchBed *bed)
{
    bed->scene.observe.ledger = true;
}

static void touch_in_the_middle(OzBenchBed *bed)
{
    bed->scene.contact.contact_point = OZ_POINT_MIDPOINT;
}

static void clamp_attraction(OzBenchBed *bed)
{
    for (int w = -1; w < bed->scene.wall_count; w++) {
        contact_of(&bed->scene, w)->attraction = OZ_ATTRACTION_CLAMP;
    }
}

static void use_double(OzBenchBed *bed)
{
    bed->scene.precision = OZ_PRECISION_DOUBLE;
}

static void use_symplectic_euler(OzBenchBed *bed)
{
    bed->scene.integrator = OZ_INTEGRATOR_SYMPLECTIC_EULER;
}

static void use_velocity_verlet(OzBenchBed *bed)
{
    bed->scene.integrator = OZ_INTEGRATOR_VELOCITY_VERLET;
}

static void make_spheres(OzBenchBed *bed)
{
    bed->scene.populations[0].aspect = (OzRange){0, 0};
}

static void change_nothing(OzBenchBed *bed)
{
    (void)bed;
}

/* THE list of features: what the changed scene is called, how it is made. */
static const struct {
    const char *name;
    void (*change)(OzBenchBed *bed);
    bool brief;   /* the bed would fall apart: a few milliseconds only */
    bool own_bed; /* of other grains: placed, settled and shaken anew  */
} features[] = {
    {"the same (noise)", change_nothing, false, false},
    {"no friction", drop_friction, false, false},
    {"no tangential spring", drop_springs, false, false},
    {"no cylinder", drop_cylinder, true, false},
    {"floor at rest", stop_floor, true, false},
    {"spheres, own bed", make_spheres, false, true},
    {"sizes not all equal", unequal_sizes, false, false},
    {"gyroscopic term", turn_gyroscopic, false, false},
    {"energy ledger", keep_ledger, false, false},
    {"contact in the middle", touch_in_the_middle, false, false},
    {"attraction clamped", clamp_attraction, false, false},
    {"symplectic-euler", use_symplectic_euler, false, false},
    {"velocity-verlet", use_velocity_verlet, false, false},
    {"double", use_double, false, false},
};

enum { FEATURES = sizeof features / sizeof features[0] };

/* One scene's timings. */
typedef struct Side {
    double seconds[TURNS]; /* of a step */
    double pairs;          /* per grain */
} Side;

typedef struct Duel {
    const OzBenchBed *bed[2]; /* as it is, changed */
    const OzOptions *options;
    int turns, steps;
    Side *side; /* 2, borrowed */
} Duel;

static OzStatus run_side(Duel *duel, const OzDevice *device, int which, int turn)
{
    OzStatus status = OZ_OK;
    const OzBenchBed *bed = duel->bed[which];
    OzMember member = {&bed->scene, &bed->grains};
    OzSim *sim = NULL;
    OzCounters probe;
    OZ_TRY(oz_sim_create(&sim, device, &member, 1, duel->options->source_dir));
    OZ_TRY(oz_sim_advance(sim, WARM_STEPS));
    double start = oz_stage_timing_clock(device);
    OZ_TRY(oz_sim_advance(sim, WARM_STEPS + duel->steps));
    duel->side[which].seconds[turn] = (oz_stage_timing_clock(device) - start) / duel->steps;
    OZ_TRY(oz_counters_read(&probe, sim));
    duel->side[which].pairs = (double)probe.pairs / (double)probe.grains;
done:
    oz_sim_free(sim);
    return status;
}

static OzStatus fight(void *context)
{
    OzStatus status = OZ_OK;
    Duel *duel = context;
    OzDevice device = {0};
    int threads = duel->options->threads ? duel->options->threads : 1;
    OZ_TRY(oz_device_open(&device, duel->options->device, threads));
    for (int turn = 0; turn < duel->turns; turn++) {
        int first = turn % 2; /* A B B A: a drift of the machine favours neither */
        OZ_TRY(run_side(duel, &device, first, turn));
        OZ_TRY(run_side(duel, &device, 1 - first, turn));
    }
done:
    oz_device_close(&device);
    return status;
}

/* an6 with the feature changed, in the state of bed unless it needs its own. */
static OzStatus make_changed(OzBenchBed *changed, const OzBenchBed *bed, const OzOptions *options,
                             int feature)
{
    OZ_PASS(oz_bench_bed_load(changed, options, NULL));
    if (features[feature].own_bed) {
        features[feature].change(changed);
        oz_grains_free(&changed->grains);
        OZ_PASS(oz_insert_grains(&changed->grains, &changed->scene));
        return oz_bench_bed_settle(changed, options, OZ_BENCH_BED_TAPS);
    }
    oz_bench_bed_take(changed, bed);
    features[feature].change(changed);
    return OZ_OK;
}

/* The value below which a share of them lies. */
static double quantile(const double *values, int count, double share)
{
    double sorted[TURNS];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    oz_order_sort(sorted, count);
    return sorted[(int)lround(share * (count - 1))];
}

static void print_duel(int feature, const Side side[2], int turns, FILE *text, FILE *csv)
{
    double difference[TURNS];
    for (int k = 0; k < turns; k++) {
        difference[k] = side[1].seconds[k] - side[0].seconds[k];
    }
    double own = 1e6 * quantile(side[0].seconds, turns, 0.5);
    double changed = 1e6 * quantile(side[1].seconds, turns, 0.5);
    double more = 1e6 * quantile(difference, turns, 0.5);
    double spread = 0.5e6 * (quantile(difference, turns, 0.75) - quantile(difference, turns, 0.25));
    fprintf(text, "%-22s %9.2f %9.2f %10.2f %8.2f %8.1f %% %9.2f %9.2f\n", features[feature].name,
            own, changed, more, spread, 100 * more / own, side[0].pairs, side[1].pairs);
    fprintf(csv, "%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", features[feature].name, own, changed,
            more, spread, 100 * more / own, side[0].pairs, side[1].pairs);
    fflush(text);
}

static OzStatus run_feature(int feature, const OzBenchBed *bed, const OzOptions *options,
                            FILE *text, FILE *csv)
{
    OzStatus status = OZ_OK;
    OzBenchBed changed = {0};
    Side side[2] = {{{0}, 0}, {{0}, 0}};
    int tap = (int)lround(bed->scene.period / bed->scene.step);
    OZ_TRY(make_changed(&changed, bed, options, feature));
    Duel duel = {.bed = {bed, &changed},
                 .options = options,
                 .turns = options->quick ? QUICK_TURNS : TURNS,
                 .steps = features[feature].brief || options->quick ? SHORT_STEPS : tap,
                 .side = side};
    OZ_TRY(oz_subprocess_run(fight, &duel, side, sizeof side));
    print_duel(feature, side, duel.turns, text, csv);
done:
    oz_bench_bed_free(&changed);
    return status;
}

OzStatus oz_bench_features_print(const OzBenchBed *bed, const OzOptions *options,
                                 const char *folder, FILE *text)
{
    OzStatus status = OZ_OK;
    FILE *csv = NULL;
    OZ_TRY(oz_folder_create_file(&csv, folder, "features.csv"));
    fprintf(csv, "changed,us_per_step,changed_us_per_step,difference_us,spread_us,percent,"
                 "pairs_per_grain,changed_pairs_per_grain\n");
    fprintf(text,
            "\nfeatures of %s, in turns, float, us a step (of a CPU: processor time)\n%-22s %9s "
            "%9s %10s %8s %10s %9s %9s\n",
            bed->scene.name, "changed", "as it is", "changed", "difference", "+-", "", "pairs",
            "changed");
    for (int f = 0; f < FEATURES; f++) {
        OZ_TRY(run_feature(f, bed, options, text, csv));
    }
done:
    if (csv) {
        fclose(csv);
    }
    return status;
}
