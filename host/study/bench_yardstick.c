/* Running the yardstick. */
#include "study/bench_yardstick.h"

#include "base/file.h"
#include "base/log.h"
#include "observe/final.h"

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
    OzStatus status = OZ_OK;
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
        OZ_TRY(oz_file_join(path, folder, places[k]));
        if (access(*path, X_OK) == 0) {
            return OZ_OK;
        }
        free(*path);
        *path = NULL;
    }
done:
    return status;
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
    memcpy(now.spin, bed->grains.spin, 3 * count * sizeof(double));
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

static OzStatus run_once(const char *program, const char *bed, double *us, double *rebuild)
{
    char command[9000], line[4096] = "";
    snprintf(command, sizeof command, "'%s' -t %d '%s'", program, TAPS, bed);
    FILE *output = popen(command, "r");
    bool read = output && fgets(line, sizeof line, output);
    bool ended = output && pclose(output) == 0;
    *us = find_number(line, "us_per_step=");
    *rebuild = find_number(line, "steps_per_rebuild=");
    if (!read || !ended || !(*us > 0)) {
        return oz_status_fail(OZ_ERR_FILE, "the yardstick failed: %s", command);
    }
    return OZ_OK;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

OzStatus oz_bench_yardstick_measure(OzBenchRow *row, bool *found, const OzBenchBed *bed,
                                    const OzOptions *options, const char *folder)
{
    OzStatus status = OZ_OK;
    char *program = NULL, *path = NULL;
    double times[RUNS], *value = row->value, grains = (double)bed->grains.count;
    *row = oz_bench_row_empty("yardstick");
    OZ_TRY(find_program(&program, options));
    *found = program != NULL;
    if (!*found) {
        oz_log_line("no yardstick beside orzo: see --yardstick");
        goto done;
    }
    OZ_TRY(oz_file_join(&path, folder, "bed.csv"));
    OZ_TRY(write_bed(bed, path));
    for (int k = 0; k < RUNS; k++) {
        OZ_TRY(run_once(program, path, &times[k], &value[OZ_BENCH_REBUILD]));
    }
    qsort(times, RUNS, sizeof times[0], compare);
    value[OZ_BENCH_GRAINS] = grains;
    value[OZ_BENCH_MEMBERS] = value[OZ_BENCH_THREADS] = 1;
    value[OZ_BENCH_US_STEP] = times[RUNS / 2];
    value[OZ_BENCH_US_LEAST] = times[0];
    value[OZ_BENCH_NS_GRAIN] = 1e3 * times[RUNS / 2] / grains;
    value[OZ_BENCH_TAPS] = RUNS * TAPS;
    value[OZ_BENCH_PIECES] = RUNS;
done:
    free(program);
    free(path);
    return status;
}

void oz_bench_yardstick_compare(const OzBenchRow *yardstick, const OzBenchRow *rows, int count,
                                FILE *file)
{
    for (int r = 0; r < count; r++) {
        const double *value = rows[r].value;
        char name[128];
        if (isfinite(value[OZ_BENCH_BITS]) &&
            value[OZ_BENCH_GRAINS] == yardstick->value[OZ_BENCH_GRAINS]) {
            oz_bench_row_describe(&rows[r], name, sizeof name);
            fprintf(file, "%s: %.2f times the yardstick's speed\n", name,
                    yardstick->value[OZ_BENCH_NS_GRAIN] / value[OZ_BENCH_NS_GRAIN]);
        }
    }
}
