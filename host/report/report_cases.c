/* Values and exact answers of the report's scenes. The snapshot's grains are the start. */
#include "report/report_cases.h"

#include "model/contact.h"
#include "report/report_element_cases.h"
#include "report/report_energy.h"
#include "report/report_parallel.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Velocity of grain 1 relative to grain 0 along the line that joined their centres. */
static double parting(const OzSnapshot *end, const double *velocity)
{
    double speed = 0, length = 0;
    for (int c = 0; c < 3; c++) {
        double way = end->grains->position[3 + c] - end->grains->position[c];
        speed += (velocity[3 + c] - velocity[c]) * way;
        length += way * way;
    }
    return speed / sqrt(length);
}

static double value_restitution(const OzSnapshot *end)
{
    return -parting(end, end->velocity) / parting(end, end->grains->velocity);
}

static double exact_restitution(const OzSnapshot *end)
{
    return oz_contact_constants(&end->scene->contact).restitution;
}

static double value_spin(const OzSnapshot *end)
{
    return end->angular_velocity[1];
}

static double value_way(const OzSnapshot *end)
{
    return end->position[0] - end->grains->position[0];
}

/* A free symmetric top: its axis turns about the angular momentum at |L| / I_perp (Rodrigues 1840).
 */
static void precess(const OzGrains *grains, double time, double axis[3])
{
    double start[3], momentum[3];
    oz_grains_axis(grains->quaternion, start);
    double excess =
        (grains->inertia_axis[0] - grains->inertia[0]) * dot(grains->angular_velocity, start);
    for (int c = 0; c < 3; c++) {
        momentum[c] = grains->inertia[0] * grains->angular_velocity[c] + excess * start[c];
    }
    double length = sqrt(dot(momentum, momentum)), angle = length / grains->inertia[0] * time;
    double along = dot(momentum, start) / (length * length);
    for (int c = 0; c < 3; c++) {
        int i = (c + 1) % 3, j = (c + 2) % 3;
        double across = (momentum[i] * start[j] - momentum[j] * start[i]) / length;
        axis[c] =
            along * momentum[c] * (1 - cos(angle)) + start[c] * cos(angle) + across * sin(angle);
    }
}

/* The chord between the axis and where it must be: as the angle, and exact when that is tiny. */
static double value_axis(const OzSnapshot *end)
{
    double axis[3], apart[3];
    precess(end->grains, end->time, axis);
    for (int c = 0; c < 3; c++) {
        apart[c] = end->axis[c] - axis[c];
    }
    return sqrt(dot(apart, apart));
}

/* Of a rod lying flat on the plane z = 0. */
static double value_overlap(const OzSnapshot *end)
{
    return 0.5 * end->grains->diameter[0] - end->position[2];
}

/* Two ends carry the weight; the stiffness is given per mass. */
static double exact_overlap(const OzSnapshot *end)
{
    double stiffness = oz_contact_constants(&end->scene->walls[0].contact).stiffness;
    return -end->scene->gravity[2] / (2 * stiffness);
}

/* How high the sphere will rise, or rose last. */
static double value_apex(const OzSnapshot *end)
{
    double speed = end->velocity[2];
    return end->position[2] - 0.5 * end->grains->diameter[0] -
           0.5 * speed * speed / end->scene->gravity[2];
}

/* What the ledger cannot account for, as a share of the energy at the start. */
static double value_residual(const OzSnapshot *end)
{
    double start = oz_report_energy_start(end);
    const OzLedger *ledger = &end->ledger;
#define ADD(NAME, member, column, meaning) +ledger->member
    double now =
        oz_report_energy_now(end) + ledger->elastic OZ_LEDGER_LOSSES(ADD) - ledger->work_walls;
#undef ADD
    return end->has_ledger ? (now - start) / start : NAN;
}

static const OzReportCase rows[] = {
    {"normal_hit", "restitution", "", true, .value = value_restitution, .exact = exact_restitution},
    {"oblique_smooth", "spin after the hit", "", true, .value = value_spin},
    {"oblique_rough", "spin after the hit", "", true, .value = value_spin},
    {"rolling_sphere", "way travelled", "", false, .value = value_way},
    {"rolling_rod", "way travelled", "", false, .value = value_way},
    {"free_rotation", "direction of the shaft", "rad", false, .value = value_axis, .zero = true},
    {"rest", "overlap at rest", "", false, .value = value_overlap, .exact = exact_overlap},
    {"bounce", "height of the third bounce", "", true, .value = value_apex},
    {"ten_rods", "energy", "of the energy", false, .value = value_residual, .zero = true},
    {"aligned", "energy", "of the energy", false, .study = oz_report_parallel_study},
    {NULL},
};

static const OzReportCase *const lists[] = {
    [OZ_MODEL_RODS] = rows, [OZ_MODEL_TRIGRAINS] = oz_report_element_cases_rows};

const OzReportCase *oz_report_cases_all(OzModelKind model)
{
    return lists[model];
}

const OzReportCase *oz_report_cases_find(const char *scene)
{
    for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++) {
        for (const OzReportCase *row = lists[k]; row->scene; row++) {
            if (strcmp(row->scene, scene) == 0) {
                return row;
            }
        }
    }
    return NULL;
}

void oz_report_cases_read(const OzReportCase *row, const OzSnapshot *end,
                          double values[OZ_REPORT_VALUES])
{
    if (row->values) {
        row->values(end, values);
    } else {
        values[0] = row->value(end);
    }
}

double oz_report_cases_error(const OzReportCase *row, const OzSnapshot *end,
                             const double truth[OZ_REPORT_VALUES])
{
    double values[OZ_REPORT_VALUES], squares = 0;
    if (!row->values) {
        double apart = fabs(row->value(end) - truth[0]);
        return row->unit[0] ? apart : apart / fabs(truth[0]);
    }
    int count = row->values(end, values);
    for (int i = 0; i < count; i++) {
        squares += (values[i] - truth[i]) * (values[i] - truth[i]);
    }
    return sqrt(squares);
}
