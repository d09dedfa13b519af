/* Runs the yardstick: a bed from orzo's final.csv or one of its own, then the timed taps.
 *
 * yardstick [-n grains] [-t taps] [-s skin in diameters] [-c container's diameter in m] [final.csv]
 *
 * The container's cross-section grows with the number of grains, so that every bed is as high as
 * an6's. Prints one line of key=value. */
#include "yardstick.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#define PI     3.14159265358979
#define HALF   OZ_YARDSTICK_HALF
#define RADIUS (OZ_YARDSTICK_DIAMETER / 2)

typedef struct Bed {
    OzRod *rods;
    int count;
    double container, skin;
} Bed;

static void give_up(const char *why)
{
    fprintf(stderr, "yardstick: %s\n", why);
    exit(2);
}

static void start(Bed *bed, int count)
{
    bed->count = count;
    if (bed->container <= 0) {
        bed->container = 8e-3 * sqrt(count / 1000.0);
    }
    if (!(bed->skin > 0 && bed->skin <= 1.5 * (double)(2 * RADIUS))) {
        give_up("the skin must be above 0 and at most 1.5 diameters");
    }
    bed->rods = count > 0 ? oz_yardstick_start(count, bed->container, bed->skin) : NULL;
    if (!bed->rods) {
        give_up("no rods, or no memory for them");
    }
}

/* Rods at random, a fifth of the column filled, overlapping. */
static void scatter(const Bed *bed)
{
    double inside = bed->container / 2 - (double)RADIUS, volume = (double)OZ_YARDSTICK_MASS / 2500;
    double height = 5 * volume * bed->count / (PI * bed->container * bed->container / 4);
    for (int i = 0; i < bed->count; i++) {
        double u = 2 * drand48() - 1, across = sqrt(1 - u * u), angle = 2 * PI * drand48();
        double turn = 2 * PI * drand48(), off = inside * sqrt(drand48()), half = (double)HALF;
        bed->rods[i].shaft = (OzVec){(float)(half * across * cos(angle)),
                                     (float)(half * across * sin(angle)), (float)(half * u)};
        bed->rods[i].place = (OzVec){(float)(off * cos(turn)), (float)(off * sin(turn)),
                                     (float)(half + height * drand48())};
    }
}

/* First without inertia, which parts overlapping rods gently; then falling with drag 70 1/s, which
 * ends with a kinetic energy below 1e-4 N m g d; then at rest without drag. */
static void settle(const Bed *bed)
{
    OzYardstickWork work = {0};
    scatter(bed);
    while (work.steps < 33000) {
        float drag = 1 - 70 * OZ_YARDSTICK_STEP;
        float damping = work.steps < 3000 ? 0 : work.steps < 23000 ? drag : 1;
        oz_yardstick_step(&work, 0, 0, damping);
    }
}

static int count_rows(FILE *file)
{
    int rows = -1; /* the header is no rod */
    for (char line[1024]; fgets(line, sizeof line, file);) {
        rows++;
    }
    rewind(file);
    return rows;
}

static void read_bed(Bed *bed, const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) {
        give_up("cannot open the bed");
    }
    start(bed, count_rows(file));
    int read = fscanf(file, "%*[^\n]");
    for (int i = 0; i < bed->count; i++) {
        OzRod *rod = &bed->rods[i];
        float u[3], diameter;
        read = fscanf(file, "%*d,%f,%f,%f,%*f,%*f,%*f,%*f,%f,%f,%f,%f,%f,%f,%f,%f,%f,%f,%*f,%*f",
                      &rod->place.x, &rod->place.y, &rod->place.z, &u[0], &u[1], &u[2],
                      &rod->velocity.x, &rod->velocity.y, &rod->velocity.z, &rod->spin.x,
                      &rod->spin.y, &rod->spin.z, &diameter);
        if (read != 13 || fabsf(diameter - 2 * RADIUS) > 1e-8F) {
            give_up("the bed is no final.csv of an6's rods");
        }
        rod->shaft = (OzVec){HALF * u[0], HALF * u[1], HALF * u[2]};
    }
    fclose(file);
}

static double mean_angle(const Bed *bed)
{
    double sum = 0;
    for (int i = 0; i < bed->count; i++) {
        sum += asin(fmin(1, fabs((double)(bed->rods[i].shaft.z / HALF))));
    }
    return sum / bed->count * 180 / PI;
}

/* Highest point of all rods; NaN when a rod has left the container or is lost itself. */
static double highest(const Bed *bed)
{
    double top = 0;
    for (int i = 0; i < bed->count; i++) {
        OzVec at = bed->rods[i].place;
        bool held = hypot((double)at.x, (double)at.y) < bed->container / 2 && at.z > -HALF;
        top = held ? fmax(top, (double)(at.z + fabsf(bed->rods[i].shaft.z) + RADIUS)) : (double)NAN;
        if (!held) {
            break;
        }
    }
    return top;
}

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int measure(const Bed *bed, double taps)
{
    OzYardstickWork work = {0};
    double angle = mean_angle(bed), step = (double)OZ_YARDSTICK_STEP, rate = 2 * PI * 30;
    double wall = seconds(CLOCK_MONOTONIC), cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
    while (work.steps < lround(taps / 30 / step)) {
        oz_yardstick_step(&work, rate * step * (double)work.steps, 2, 1);
    }
    double each = 1.0 / (double)work.steps, top = highest(bed);
    wall = seconds(CLOCK_MONOTONIC) - wall;
    cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
    printf(
        "grains=%d steps=%ld us_per_step=%.1f cpu_us_per_step=%.1f ns_per_grain_step=%.1f "
        "steps_per_rebuild=%.1f contacts_per_grain=%.2f angle_start=%.2f angle=%.2f highest=%.5f\n",
        bed->count, work.steps, 1e6 * wall * each, 1e6 * cpu * each, 1e9 * cpu * each / bed->count,
        (double)work.steps / (double)work.rebuilds, (double)work.contacts * each / bed->count,
        angle, mean_angle(bed), top);
    return isnan(top);
}

int main(int argc, char **argv)
{
    double value[128] = {['n'] = 1000, ['t'] = 30, ['s'] = 0.8};
    for (int option; (option = getopt(argc, argv, "n:t:s:c:")) != -1;) {
        if (option == '?') {
            return 2;
        }
        value[option] = atof(optarg);
    }
    Bed bed = {.container = value['c'], .skin = value['s'] * (double)(2 * RADIUS)};
    if (optind < argc) {
        read_bed(&bed, argv[optind]);
    } else {
        start(&bed, (int)value['n']);
        settle(&bed);
    }
    return measure(&bed, value['t']);
}
