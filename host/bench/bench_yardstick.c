/* Running the yardstick. */
#include "bench/bench_yardstick.h"

#include "base/file.h"
#include "base/log.h"
#include "observe/final.h"
#include "scene/wall_shape.h"

#include <libgen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { RUNS = 5, TAPS = 3 };

/* *path receives the program in new memory, NULL when there is none. */
static OzStatus find_program(char **path, const OzOptions *options)
{
    static const char *const places[] = {"yardstick", "tests/yardstick"};
    char own[4096] = "";
    *path = NULL;
    if (options->yardstick) {
        return oz_file_join(path, NULL, options->yardstick);
    }
    if (readlink("/proc/self/exe", own, sizeof own - 1) < 0) {
        return OZ_OK;
    }
    const char *folder = dirname(own);
    for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
        OZ_PASS(oz_file_join(path, folder, places[k]));
        if (access(*path, X_OK) == 0) {
            return OZ_OK;
        }
        free(*path);
        *path = NULL;
    }
    return OZ_OK;
}

static OzStatus write_bed(const OzBenchBed *bed, const char *path)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    size_t count = (size_t)bed->grains.count;
    OZ_TRY(oz_snapshot_create(&now, &bed->scene, &bed->grains));
    memcpy(now.position, bed->grains.position, 3 * count * sizeof(double));
    memcpy(now.quaternion, bed->grains.quaternion, 4 * count * sizeof(double));
    memcpy(now.velocity, bed->grains.velocity, 3 * count * sizeof(double));
    memcpy(now.angular_velocity, bed->grains.angular_velocity, 3 * count * sizeof(double));
    oz_snapshot_turn_axes(&now);
    OZ_TRY(oz_final_write(&now, path));
done:
    oz_snapshot_free(&now);
    return status;
}

/* The number after `key=` in the program's one line; NAN without it. */
static double find_number(const char *line, const char *key)
{
    const char *at = strstr(line, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

/* Diameter of the cylinder, m; 0 without one: the yardstick then takes its own. */
static double container_of(const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (oz_wall_shape_is_upright(&scene->walls[w])) {
            return scene->walls[w].diameter;
        }
    }
    return 0;
}

/* One run of the program, as a row. */
static OzStatus run_once(const char *program, const char *bed, double container, OzBenchRow *row)
{
    char command[9000], line[4096] = "";
    double *value = row->value;
    snprintf(command, sizeof command, "'%s' -t %d -c %.9g '%s'", program, TAPS, container, bed);
    FILE *output = popen(command, "r");
    bool read = output && fgets(line, sizeof line, output);
    bool ended = output && pclose(output) == 0;
    *row = oz_bench_row_empty("yardstick");
    value[OZ_BENCH_US_STEP] = find_number(line, " us_per_step=");
    value[OZ_BENCH_US_CPU] = find_number(line, " cpu_us_per_step=");
    value[OZ_BENCH_REBUILD] = find_number(line, " steps_per_rebuild=");
    value[OZ_BENCH_TOUCHING] = find_number(line, " contacts_per_grain=");
    if (!read || !ended || !(value[OZ_BENCH_US_STEP] > 0)) {
        return oz_status_fail(OZ_ERR_FILE, "the yardstick failed: %s", command);
    }
    return OZ_OK;
}

/* By processor time, which other programs disturb less. */
static int compare(const void *a, const void *b)
{
    double x = ((const OzBenchRow *)a)->value[OZ_BENCH_US_CPU];
    double y = ((const OzBenchRow *)b)->value[OZ_BENCH_US_CPU];
    return (x > y) - (x < y);
}

OzStatus oz_bench_yardstick_measure(OzBenchRow *row, bool *found, const OzBenchBed *bed,
                                    const OzOptions *options, const char *folder)
{
    OzStatus status = OZ_OK;
    char *program = NULL, *path = NULL;
    OzBenchRow runs[RUNS];
    double *value = row->value, grains = (double)bed->grains.count;
    *found = false;
    OZ_TRY(find_program(&program, options));
    if (!program) {
        oz_log_line("no yardstick beside orzo: see --yardstick");
        goto done;
    }
    OZ_TRY(oz_file_join(&path, folder, "bed.csv"));
    OZ_TRY(write_bed(bed, path));
    for (int k = 0; k < RUNS; k++) {
        OZ_TRY(run_once(program, path, container_of(&bed->scene), &runs[k]));
    }
    qsort(runs, RUNS, sizeof runs[0], compare);
    *row = runs[RUNS / 2];
    value[OZ_BENCH_GRAINS] = grains;
    value[OZ_BENCH_MEMBERS] = value[OZ_BENCH_THREADS] = 1;
    value[OZ_BENCH_NS_GRAIN] = 1e3 * value[OZ_BENCH_US_STEP] / grains;
    value[OZ_BENCH_TAPS] = RUNS * TAPS;
    value[OZ_BENCH_PIECES] = RUNS;
    *found = true;
done:
    free(program);
    free(path);
    return status;
}

void oz_bench_yardstick_compare(const OzBenchRow *yardstick, const OzBenchRow *rows, int count,
                                FILE *file)
{
    const double *slow = yardstick->value;
    for (int r = 0; r < count; r++) {
        const double *fast = rows[r].value;
        char name[128];
        if (isfinite(fast[OZ_BENCH_BITS]) && fast[OZ_BENCH_GRAINS] == slow[OZ_BENCH_GRAINS]) {
            oz_bench_row_describe(&rows[r], name, sizeof name);
            fprintf(file, "%s: %.2f times the yardstick's speed; %.2f by processor time\n", name,
                    slow[OZ_BENCH_NS_GRAIN] / fast[OZ_BENCH_NS_GRAIN],
                    slow[OZ_BENCH_US_CPU] * fast[OZ_BENCH_MEMBERS] / fast[OZ_BENCH_US_CPU]);
        }
    }
}
