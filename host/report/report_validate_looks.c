/* One function for each experiment. */
#include "report/report_validate_looks.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
static const double BEVERLOO_K = 1.4; /* diameters, of spheres */

enum {
    HALF_OF_LOOKS = 20, /* of silo and drum, which look 40 times */
    GAS_FROM = 30,      /* of 100                              */
    HEAP_POINTS = 100   /* along the tray's diameter: a tenth of a sphere of the heap's apart */
};

void oz_report_validate_looks_ball(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    double radius = now->grains->diameter[0] / 2, speed = now->velocity[0];
    const double *g = now->scene->gravity;
    if (look > 0) {
        numbers[OZ_LOOK_BALL_INCLINE] = -g[0] / g[2] / now->scene->contact.friction;
        numbers[OZ_LOOK_BALL_SPEED] = speed / (g[0] * now->time);
        numbers[OZ_LOOK_BALL_SLIP] = 1 - now->angular_velocity[1] * radius / speed;
    }
}

/* Of the two grains, or of grain 0 and the plane z = 0; below 0: the gap. */
static double overlap_of(const OzSnapshot *now)
{
    const double *x = now->position, *d = now->grains->diameter;
    if (now->count == 1) {
        return d[0] / 2 - x[2];
    }
    double way = hypot(hypot(x[3] - x[0], x[4] - x[1]), x[5] - x[2]);
    return (d[0] + d[1]) / 2 - way;
}

void oz_report_validate_looks_hit(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    double overlap = overlap_of(now), before = numbers[OZ_LOOK_HIT_BEFORE];
    const double *start = now->grains->velocity, *v = now->velocity;
    int normal = now->count == 1 ? 2 : 0;
    if (look > 0 && before > 0 && overlap <= 0) {
        double since = now->time / look * overlap / (overlap - before);
        numbers[OZ_LOOK_HIT_DURATION] = now->time - since;
    }
    numbers[OZ_LOOK_HIT_OVERLAP] = fmax(numbers[OZ_LOOK_HIT_OVERLAP], overlap);
    numbers[OZ_LOOK_HIT_RESTITUTION] = -v[normal] / start[normal];
    numbers[OZ_LOOK_HIT_TANGENTIAL] = v[0] / start[0];
    numbers[OZ_LOOK_HIT_SPIN] = fabs(now->angular_velocity[1]);
    numbers[OZ_LOOK_HIT_ASKED] = now->scene->contact.restitution;
    numbers[OZ_LOOK_HIT_BEFORE] = overlap;
}

static void centre_of_mass(const OzSnapshot *now, double centre[3], double *mass)
{
    *mass = centre[0] = centre[1] = centre[2] = 0;
    for (int64_t i = 0; i < now->count; i++) {
        *mass += now->grains->mass[i];
        for (int k = 0; k < 3; k++) {
            centre[k] += now->grains->mass[i] * now->position[3 * i + k];
        }
    }
    for (int k = 0; k < 3; k++) {
        centre[k] /= *mass;
    }
}

void oz_report_validate_looks_silo(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    double centre[3], mass, force[2][3];
    if (look <= HALF_OF_LOOKS) {
        return;
    }
    centre_of_mass(now, centre, &mass);
    oz_contact_list_push_walls(&now->contacts, force, 2);
    numbers[OZ_LOOK_SILO_FLOOR] -= force[0][2];
    numbers[OZ_LOOK_SILO_LOOKS]++;
    const OzWall *tube = &now->scene->walls[1];
    double weight = -mass * now->scene->gravity[2];
    double height = 2 * (centre[2] + now->wall_offset[0]); /* the floor goes down */
    numbers[OZ_LOOK_SILO_COLUMN] = weight / height * tube->diameter / (4 * tube->contact.friction);
}

/* Kinetic theory of inelastic spheres: the rate of cooling is (1 - e^2)/3 of the rate of hits, and
 * hits are as frequent as Enskog's theory says, with Carnahan and Starling's (1969) g at contact
 * (Brilliantov and Poeschel 2004, chapter 5). Deviations from Maxwell's velocities change it by
 * less than 0.3 % at e = 0.9. density: grains in a m^3. */
static double slope_by_theory(double restitution, double density, double diameter)
{
    double share = density * PI / 6 * pow(diameter, 3);
    double g = (1 - share / 2) / pow(1 - share, 3);
    return 2 * sqrt(PI) / 3 * (1 - restitution * restitution) * density * diameter * diameter * g;
}

void oz_report_validate_looks_gas(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    double square = 0, diameter = 0, mean[3] = {0}, n = (double)now->count;
    if (look < GAS_FROM) {
        return;
    }
    for (int64_t i = 0; i < now->count; i++) {
        diameter += now->grains->diameter[i] / n;
        for (int k = 0; k < 3; k++) {
            square += pow(now->velocity[3 * i + k], 2) / n;
            mean[k] += now->velocity[3 * i + k] / n;
        }
    }
    double temperature = (square - mean[0] * mean[0] - mean[1] * mean[1] - mean[2] * mean[2]) / 3;
    double slow = 1 / sqrt(temperature);
    const double *size = now->scene->boundary.size;
    double density = n / (size[0] * size[1] * size[2]);
    double theory = slope_by_theory(now->scene->contact.restitution, density, diameter);
    numbers[OZ_LOOK_GAS_COUNT]++;
    numbers[OZ_LOOK_GAS_TIME] += now->time;
    numbers[OZ_LOOK_GAS_TIME2] += now->time * now->time;
    numbers[OZ_LOOK_GAS_SLOW] += slow;
    numbers[OZ_LOOK_GAS_PRODUCT] += now->time * slow;
    numbers[OZ_LOOK_GAS_THEORY] = theory;
}

void oz_report_validate_looks_drum(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    double centre[3], mass;
    if (look <= HALF_OF_LOOKS) {
        return;
    }
    const OzWall *drum = &now->scene->walls[0];
    centre_of_mass(now, centre, &mass);
    double aside = centre[0] - drum->point[0], down = drum->point[2] - centre[2];
    numbers[OZ_LOOK_DRUM_SLOPE] += 180 / PI * atan2(fabs(aside), down);
    numbers[OZ_LOOK_DRUM_LOOKS]++;
}

/* kg, of the grains whose centres lie between two heights; their share of all. */
static double mass_between(const OzSnapshot *now, double low, double high, double *share)
{
    double mass = 0, all = 0;
    for (int64_t i = 0; i < now->count; i++) {
        double z = now->position[3 * i + 2];
        all += now->grains->mass[i];
        mass += z >= low && z < high ? now->grains->mass[i] : 0;
    }
    *share = mass / all;
    return mass;
}

static void see_bed(OzTrialNumbers numbers, const OzSnapshot *now)
{
    const OzWall *tube = &now->scene->walls[1];
    double size = 0, share;
    for (int64_t i = 0; i < now->count; i++) {
        size += now->grains->diameter[i] / (double)now->count;
    }
    double low = tube->point[2] + 2 * size, height = 5 * size;
    double area = PI / 4 * tube->diameter * tube->diameter;
    numbers[OZ_LOOK_HOPPER_FREE] = now->scene->walls[0].diameters[0] - BEVERLOO_K * size;
    numbers[OZ_LOOK_HOPPER_DENSITY] =
        mass_between(now, low, low + height, &share) / (area * height);
}

void oz_report_validate_looks_hopper(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    double share, mass = mass_between(now, -INFINITY, now->scene->walls[0].point[2], &share);
    if (look == 0) {
        see_bed(numbers, now);
    }
    if (share < 0.15 || share > 0.45) {
        return;
    }
    if (numbers[OZ_LOOK_HOPPER_FROM] == 0) {
        numbers[OZ_LOOK_HOPPER_FROM] = now->time;
        numbers[OZ_LOOK_HOPPER_BEFORE] = mass;
    }
    numbers[OZ_LOOK_HOPPER_TO] = now->time;
    numbers[OZ_LOOK_HOPPER_AFTER] = mass;
}

/* m: of the spheres over a point of the plane; NAN: there are none. */
static double surface_over(const OzSnapshot *now, double x, double y)
{
    double highest = NAN;
    for (int64_t i = 0; i < now->count; i++) {
        const double *centre = &now->position[3 * i];
        double radius = now->grains->diameter[i] / 2;
        double square = radius * radius - pow(centre[0] - x, 2) - pow(centre[1] - y, 2);
        if (square >= 0) {
            highest = fmax(highest, centre[2] + sqrt(square));
        }
    }
    return highest;
}

void oz_report_validate_looks_heap(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    const OzWall *tray = &now->scene->walls[0];
    double radius = tray->diameter / 2, n = 0, r1 = 0, r2 = 0, h1 = 0, rh = 0;
    for (int i = 0; i < HEAP_POINTS * HEAP_POINTS && look > 0; i++) {
        double x = radius * (2.0 * (i % HEAP_POINTS) / (HEAP_POINTS - 1) - 1);
        double y = radius * (2.0 * (i / HEAP_POINTS) / (HEAP_POINTS - 1) - 1);
        double far = hypot(x, y);
        double height = far > 0.4 * radius && far < 0.9 * radius ? surface_over(now, x, y) : NAN;
        if (height > tray->point[2]) {
            n++;
            r1 += far;
            r2 += far * far;
            h1 += height;
            rh += far * height;
        }
    }
    numbers[OZ_LOOK_HEAP_SLOPE] = 180 / PI * atan((r1 * h1 - n * rh) / (n * r2 - r1 * r1));
}
