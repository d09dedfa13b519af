/* THE list of observables and the functions of rods' (those of flat grains are in observe/flat.c).
 * Knows nothing of files and of tap means, which it is handed. */
#include "observe/observables.h"

#include "observe/element_energy.h"
#include "observe/flat.h"
#include "observe/moment.h"
#include "observe/rod_energy.h"
#include "observe/stress.h"
#include "observe/wall_columns.h"
#include "scene/servo.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool density(const OzObservation *o, double *value)
{
    return oz_measure_density(o->measure, o->snapshot, value);
}

static bool density_all(const OzObservation *o, double *value)
{
    return oz_measure_density_all(o->measure, o->snapshot, value);
}

static bool tap_mean(const OzObservation *o, double *value)
{
    *value = o->mean[o->index];
    return o->has_mean[o->index];
}

static bool density_com(const OzObservation *o, double *value)
{
    return oz_measure_density_com(o->measure, o->snapshot, value);
}

static bool density_slab(const OzObservation *o, double *value)
{
    return oz_measure_density_slab(o->measure, o->snapshot, value);
}

static bool angle(const OzObservation *o, double *value)
{
    return oz_measure_angle(o->snapshot, value);
}

static bool angle_layer(const OzObservation *o, double *value)
{
    const OzLayer *layer = &o->layers[o->index];
    *value = layer->rod_count > 0 ? layer->angle_sum / (double)layer->rod_count : 0;
    return layer->rod_count > 0;
}

static bool count_layer(const OzObservation *o, double *value)
{
    *value = (double)o->layers[o->index].count;
    return o->measure->floor >= 0;
}

static bool nematic(const OzObservation *o, double *value)
{
    return oz_measure_nematic(o->snapshot, value);
}

static bool order(const OzObservation *o, double *value)
{
    const OzBedOrder *found = o->order;
    const double values[] = {found->nematic_axis, found->psi6, (double)found->rattlers};
    *value = values[o->index];
    return o->index < 2 ? found->rods > 0 : found->has_contacts;
}

OzTapSample oz_observables_sample(OzMeasure *measure, const OzSnapshot *snapshot)
{
    OzTapSample s = {0};
    double *value = s.value;
    s.present[OZ_TAP_DENSITY_ALL] =
        oz_measure_density_all(measure, snapshot, &value[OZ_TAP_DENSITY_ALL]);
    s.present[OZ_TAP_DENSITY] = s.present[OZ_TAP_DENSITY_ALL];
    value[OZ_TAP_DENSITY] = oz_measure_density_of_all(value[OZ_TAP_DENSITY_ALL]);
    s.present[OZ_TAP_DENSITY_COM] =
        oz_measure_density_com(measure, snapshot, &value[OZ_TAP_DENSITY_COM]);
    s.present[OZ_TAP_DENSITY_SLAB] =
        oz_measure_density_slab(measure, snapshot, &value[OZ_TAP_DENSITY_SLAB]);
    s.present[OZ_TAP_ANGLE] = oz_measure_angle(snapshot, &value[OZ_TAP_ANGLE]);
    return s;
}

static bool is_flat(const OzSnapshot *snapshot)
{
    return snapshot->grains->elements != NULL;
}

static bool contact_count(const OzObservation *o, double *value)
{
    *value = (double)o->contacts.pairs;
    return o->snapshot->has_contacts;
}

static bool contact_number(const OzObservation *o, double *value)
{
    const OzSnapshot *s = o->snapshot;
    *value = 2 * (double)o->contacts.pairs / fmax((double)s->count, 1);
    return s->has_contacts && s->count > 0;
}

static bool overlap_max(const OzObservation *o, double *value)
{
    *value = o->contacts.overlap_max;
    return o->snapshot->has_contacts;
}

static bool overlap_mean(const OzObservation *o, double *value)
{
    int64_t count = o->contacts.pairs + o->contacts.walls;
    *value = count > 0 ? o->contacts.overlap_sum / (double)count : 0;
    return o->snapshot->has_contacts;
}

static bool deep_count(const OzObservation *o, double *value)
{
    *value = (double)o->snapshot->deep_count;
    return true;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool speed_max(const OzObservation *o, double *value)
{
    double square = 0;
    for (int64_t i = 0; i < o->snapshot->count; i++) {
        double next = dot(&o->snapshot->velocity[3 * i], &o->snapshot->velocity[3 * i]);
        square = next <= square || isnan(square) ? square : next; /* a NaN is taken and kept */
    }
    *value = sqrt(square);
    return true;
}

static double kinetic_energy(const OzSnapshot *s)
{
    return is_flat(s) ? oz_element_energy_translational(s) : oz_rod_energy_translational(s);
}

static double rotational_energy(const OzSnapshot *s)
{
    return is_flat(s) ? oz_element_energy_rotational(s) : oz_rod_energy_rotational(s);
}

static double potential_energy(const OzSnapshot *s)
{
    return is_flat(s) ? oz_element_energy_potential(s) : oz_rod_energy_potential(s);
}

static double work_of_walls(const OzSnapshot *s)
{
    return is_flat(s) ? s->element_ledger.work_walls : s->ledger.work_walls;
}

#define ADD(NAME, member, column, meaning) +ledger->member

double oz_observables_lost(const OzSnapshot *snapshot)
{
    const OzLedger *ledger = &snapshot->ledger;
    double lost = is_flat(snapshot) ? oz_element_energy_lost(snapshot) : 0 OZ_LEDGER_LOSSES(ADD);
    return snapshot->has_ledger ? lost : 0;
}

double oz_observables_energy(const OzSnapshot *snapshot)
{
    const OzLedger *ledger = &snapshot->ledger;
    double now =
        kinetic_energy(snapshot) + rotational_energy(snapshot) + potential_energy(snapshot);
    now = is_flat(snapshot)
              ? now + oz_element_energy_stored(snapshot) + oz_observables_lost(snapshot)
              : now + ledger->elastic OZ_LEDGER_LOSSES(ADD);
    return now + oz_wall_columns_kinetic(snapshot) - work_of_walls(snapshot);
}

static bool kinetic(const OzObservation *o, double *value)
{
    *value = kinetic_energy(o->snapshot);
    return true;
}

static bool rotational(const OzObservation *o, double *value)
{
    *value = rotational_energy(o->snapshot);
    return true;
}

static bool potential(const OzObservation *o, double *value)
{
    *value = potential_energy(o->snapshot);
    return true;
}

static bool elastic(const OzObservation *o, double *value)
{
    *value = o->snapshot->ledger.elastic;
    return o->snapshot->has_ledger;
}

static bool walls_work(const OzObservation *o, double *value)
{
    *value = work_of_walls(o->snapshot);
    return o->snapshot->has_ledger;
}

#define VALUE(NAME, member, column, meaning) l->member,

static bool loss(const OzObservation *o, double *value)
{
    const OzLedger *l = &o->snapshot->ledger;
    const double entries[] = {OZ_LEDGER_LOSSES(VALUE)};
    *value = entries[o->index];
    return o->snapshot->has_ledger;
}

static bool element_loss(const OzObservation *o, double *value)
{
    const OzElementLedger *l = &o->snapshot->element_ledger;
    const double entries[] = {OZ_ELEMENT_LEDGER_LOSSES(VALUE)};
    *value = entries[o->index];
    return o->snapshot->has_ledger;
}

static bool residual(const OzObservation *o, double *value)
{
    *value = o->has_start ? oz_observables_energy(o->snapshot) - o->energy_start : 0;
    return o->snapshot->has_ledger;
}

#define ALWAYS     OZ_COLUMN_ALWAYS
#define LEDGER     OZ_COLUMN_LEDGER
#define ORDER      OZ_COLUMN_ORDER
#define PHASES     OZ_COLUMN_PHASES
#define CELL       OZ_COLUMN_CELL
#define SHEAR      OZ_COLUMN_SHEAR
#define STRENGTH   OZ_COLUMN_STRENGTH
#define BROKEN     OZ_COLUMN_STRENGTH_LEDGER
#define YIELD      OZ_COLUMN_YIELD_LEDGER
#define LAYERS     OZ_COLUMN_LAYERS
#define WALLS      OZ_COLUMN_WALLS
#define WALL_TURNS OZ_COLUMN_WALL_TURNS
#define SERVOS     OZ_COLUMN_SERVOS
#define RODS       OZ_COLUMN_RODS
#define FLAT       OZ_COLUMN_TRIGRAINS
#define ALL        OZ_COLUMN_ALL

/* clang-format off */
static const OzColumn list[] = {
    {"step", "1", "steps since the settled bed", ALL, ALWAYS, true, oz_moment_step, 0},
    {"time", "s", "time since the settled bed", ALL, ALWAYS, false, oz_moment_time, 0},
    {"tap", "1", "time / period of the first moving wall; empty without one", ALL, ALWAYS, false, oz_moment_tap, 0},
    {"phase", "1", "number of the phase that has begun, from 1; only with phases", ALL, PHASES, true, oz_moment_phase, 0},
    {"cycle", "1", "number of the cycle of phases that has begun, from 1", ALL, PHASES, true, oz_moment_phase, 1},
    {"density", "1", "0.95 V/(area H): H above the moving floor, without the top 5 % of the volume; "
     "this and every density is empty without upright cylinder or box, or floor", RODS, ALWAYS, false, density, 0},
    {"density_all", "1", "V/(area H), the same H", RODS, ALWAYS, false, density_all, 0},
    {"density_tap_mean", "1", "mean of density over the samples of the last two periods of the first moving "
     "wall: samples_per_tap a period, or one at the phase of observe.at", RODS, ALWAYS, false, tap_mean,
     OZ_TAP_DENSITY},
    {"density_all_tap_mean", "1", "the same mean of density_all", RODS, ALWAYS, false, tap_mean,
     OZ_TAP_DENSITY_ALL},
    {"density_com", "1", "V/(area x twice the centre of mass's height above the moving floor)",
     RODS, ALWAYS, false, density_com, 0},
    {"density_com_tap_mean", "1", "the same mean of density_com", RODS, ALWAYS, false, tap_mean,
     OZ_TAP_DENSITY_COM},
    {"density_slab", "1", "share of the container filled from 2 to 10 mm above the moving floor",
     RODS, ALWAYS, false, density_slab, 0},
    {"density_slab_tap_mean", "1", "the same mean of density_slab", RODS, ALWAYS, false, tap_mean,
     OZ_TAP_DENSITY_SLAB},
    {"angle", "degrees", "mean angle between shaft and floor, rods only: 0 flat, 90 upright", RODS, ALWAYS,
     false, angle, 0},
    {"angle_tap_mean", "degrees", "the same mean of angle", RODS, ALWAYS, false, tap_mean, OZ_TAP_ANGLE},
    {"angle_layer<i>", "degrees", "angle in the layers 1 to 4, from the floor's place at rest up, by grain centre; "
     "empty without rods or a floor", RODS, LAYERS, false, angle_layer, 0},
    {"count_layer<i>", "1", "grains whose centre lies in a layer; empty without a floor", RODS, LAYERS, true, count_layer, 0},
    {"nematic_s", "1", "largest eigenvalue of <3uu - 1>/2, rods only: 1 aligned, 0 isotropic", RODS, ALWAYS,
     false, nematic, 0},
    {"nematic_axis", "1", "mean of (3 (u.a)^2 - 1)/2, rods only, a the axis of the first cylinder, else z; this "
     "and the next two with observe.order", RODS, ORDER, false, order, 0},
    {"psi6", "1", "hexagonal order across that axis, mean over the rods: |mean of exp(6 i theta)| over "
     "neighbours beside each: 1 in a hexagonal packing of upright rods", RODS, ORDER, false, order, 1},
    {"rattler_count", "1", "grains that touch less than two others or walls", RODS, ORDER, true, order, 2},
    {"contact_count", "1", "touching pairs of grains", ALL, ALWAYS, true, contact_count, 0},
    {"overlap_max", "m", "deepest overlap of pairs and walls", RODS, ALWAYS, false, overlap_max, 0},
    {"overlap_mean", "m", "mean overlap of pairs and walls; 0 when nothing touches", RODS, ALWAYS, false,
     overlap_mean, 0},
    {"speed_max", "m/s", "speed of the fastest centre", ALL, ALWAYS, false, speed_max, 0},
    {"speed_mean", "m/s", "mean speed of the grains' centres", FLAT, ALWAYS, false,
     oz_flat_speed_mean, 0},
    {"spin_mean", "rad/s", "mean of the grains' spins without their signs", FLAT, ALWAYS, false,
     oz_flat_spin_mean, 0},
    {"spin_0", "rad/s", "spin of the first grain", FLAT, ALWAYS, false, oz_flat_spin, 0},
    {"spin_1", "rad/s", "spin of the second grain", FLAT, ALWAYS, false, oz_flat_spin, 1},
    {"kinetic", "J", "kinetic energy of the centres (trigrains: of their elements')", ALL, ALWAYS, false, kinetic, 0},
    {"rotational", "J", "kinetic energy of the spins (trigrains: of their elements')", ALL, ALWAYS, false, rotational, 0},
    {"energy_contact", "J", "stored in overlaps now", FLAT, ALWAYS, false, oz_flat_stored, 0},
    {"energy_beam", "J", "stored in beams now", FLAT, ALWAYS, false, oz_flat_stored, 1},
    {"contact_number", "1", "grains that a grain touches, on average", ALL, ALWAYS, false, contact_number, 0},
    {"wall_touches", "1", "contacts of elements with walls", FLAT, ALWAYS, true, oz_flat_wall_touches, 0},
    {"touches_i", "1", "contacts of triangles, kind i: two crossings on one edge", FLAT, ALWAYS, true,
     oz_flat_touches, OZ_CONTACT_I},
    {"touches_ii", "1", "two crossings on different edges of both", FLAT, ALWAYS, true,
     oz_flat_touches, OZ_CONTACT_II},
    {"touches_iii", "1", "four crossings, two on each of two edges of both", FLAT, ALWAYS, true,
     oz_flat_touches, OZ_CONTACT_III},
    {"touches_iv", "1", "four crossings, one triangle cut on all edges", FLAT, ALWAYS, true,
     oz_flat_touches, OZ_CONTACT_IV},
    {"touches_v", "1", "six crossings", FLAT, ALWAYS, true, oz_flat_touches, OZ_CONTACT_V},
    {"touches_vi", "1", "four crossings, both triangles cut on all edges", FLAT, ALWAYS, true,
     oz_flat_touches, OZ_CONTACT_VI},
    {"touches_disc", "1", "contacts of discs", FLAT, ALWAYS, true, oz_flat_touches, OZ_CONTACT_DISC},
    {"share_i", "1", "kind i among the contacts of triangles; empty without any", FLAT, ALWAYS, false,
     oz_flat_touch_share, OZ_CONTACT_I},
    {"share_ii", "1", "the same, kind ii", FLAT, ALWAYS, false, oz_flat_touch_share, OZ_CONTACT_II},
    {"share_iii", "1", "the same, kind iii", FLAT, ALWAYS, false, oz_flat_touch_share, OZ_CONTACT_III},
    {"share_iv", "1", "the same, kind iv", FLAT, ALWAYS, false, oz_flat_touch_share, OZ_CONTACT_IV},
    {"share_v", "1", "the same, kind v", FLAT, ALWAYS, false, oz_flat_touch_share, OZ_CONTACT_V},
    {"share_vi", "1", "the same, kind vi", FLAT, ALWAYS, false, oz_flat_touch_share, OZ_CONTACT_VI},
    {"overlap_area_max", "m^2", "largest overlap of triangles", FLAT, ALWAYS, false,
     oz_flat_overlap_max, 0},
    {"overlap_area_mean", "m^2", "mean overlap of triangles; 0 when none touch", FLAT, ALWAYS, false,
     oz_flat_overlap_mean, 0},
    {"stretch_min", "1", "shortest beam over its length at rest", FLAT, ALWAYS, false, oz_flat_beams, 0},
    {"stretch_max", "1", "longest beam over its length at rest", FLAT, ALWAYS, false, oz_flat_beams, 1},
    {"bend_max", "degrees", "largest bending angle of a beam's end", FLAT, ALWAYS, false,
     oz_flat_beams, 2},
    {"grain_count", "1", "grains now: what beams still join is one", FLAT, STRENGTH, true, oz_flat_breakage, 0},
    {"broken_beams", "1", "beams that broke so far", FLAT, STRENGTH, true, oz_flat_breakage, 1},
    {"outflow_count", "1", "grains whose centre is below observe.outlet; this and the next two are "
     "empty without it", FLAT, ALWAYS, true, oz_flat_outflow, 0},
    {"outflow_mass", "kg", "their mass, a metre deep", FLAT, ALWAYS, false, oz_flat_outflow, 1},
    {"outflow_rate", "kg/s", "its growth since the row before", FLAT, ALWAYS, false,
     oz_flat_outflow, 2},
    {"inclination", "degrees", "slope of a line fitted to the bed's surface in the middle half of a "
     "drum, positive up to where the drum carries it; this and the next are empty without a drum",
     FLAT, ALWAYS, false, oz_flat_inclination, 0},
    {"inclination_centre", "degrees", "direction from the drum's axis to the centre of mass, against "
     "the vertical: the inclination of an even bed, with less noise", FLAT, ALWAYS, false,
     oz_flat_inclination, 1},
    {"inclination_mean", "degrees", "mean of inclination over the later half of the rows so far",
     FLAT, ALWAYS, false, oz_flat_inclination, 2},
    {"inclination_deviation", "degrees", "its standard deviation over them", FLAT, ALWAYS, false,
     oz_flat_inclination, 3},
    {"avalanche_count", "1", "falls of inclination_centre by half a degree or more that have ended "
     "in a rise by half of that", FLAT, ALWAYS, true, oz_flat_inclination, 4},
    {"avalanche_size", "degrees", "how far the last of them went down; empty before the first", FLAT,
     ALWAYS, false, oz_flat_inclination, 5},
    {"strain", "1", "by which the cell was sheared so far; only with boundary.shear_rate", RODS, SHEAR, false, oz_stress_strain, 0},
    {"stress_xx", "Pa", "in a cell periodic in x, y and z, > 0 where it presses: force along the first letter, across a plane normal to the second", RODS, CELL, false, oz_stress_value, 0},
    {"stress_yy", "Pa", "the same; the pressure is the mean of these three", RODS, CELL, false, oz_stress_value, 1},
    {"stress_zz", "Pa", "the same", RODS, CELL, false, oz_stress_value, 2},
    {"stress_xy", "Pa", "the same; minus it over the pressure is mu, times shear_rate and volume the shear's power", RODS, CELL, false, oz_stress_value, 3},
    {"stress_xz", "Pa", "the same", RODS, CELL, false, oz_stress_value, 4},
    {"stress_yz", "Pa", "the same", RODS, CELL, false, oz_stress_value, 5},
    {"deep_count", "1", "contacts deeper than guards.overlap.warn so far, each counted once a step",
     ALL, ALWAYS, true, deep_count, 0},
    {"wall<i>_f<x>", "N", "force of all grains on walls.<i> along an axis, x, y or z, with observe.walls: "
     "mean over the time since the row before, or instant (trigrains: x and y, a metre deep)", ALL, WALLS, false, oz_wall_columns_force, 0},
    {"wall<i>_t<x>", "N m", "torque of these forces about the wall's point, which moves with it "
     "(trigrains: z)", ALL, WALL_TURNS, false, oz_wall_columns_torque, 0},
    {"servo<i>_place", "m", "of the piston walls.<i>: how far along its normal from where it was built", RODS, SERVOS, false,
     oz_wall_columns_place, 0},
    {"servo<i>_velocity", "m/s", "of it, likewise", RODS, SERVOS, false, oz_wall_columns_velocity, 0},
    {"servo<i>_force", "N", "with which it presses grains, in the last step", RODS, SERVOS, false, oz_wall_columns_servo_force, 0},
    {"servo<i>_pressure", "Pa", "that over the area that it closes now; empty where there is none", RODS, SERVOS, false,
     oz_wall_columns_pressure, 0},
    {"energy_potential", "J", "in gravity, from the origin", ALL, LEDGER, false, potential, 0},
    {"energy_elastic", "J", "stored in contacts now", RODS, LEDGER, false, elastic, 0},
#define RODS_ROW(NAME, member, column, meaning)                                                    \
    {#column, "J", meaning, RODS, LEDGER, false, loss, OZ_L_##NAME},
#define FLAT_ROW(NAME, member, column, meaning)                                                    \
    {#column, "J", meaning, FLAT, LEDGER, false, element_loss, OZ_PL_##NAME},
#define WORK_ROW(NAME, member, column, meaning)                                                    \
    {#column, "J", meaning, ALL, LEDGER, false, walls_work, 0},
    OZ_LEDGER_LOSSES(RODS_ROW)
    OZ_ELEMENT_LEDGER_LOSSES(FLAT_ROW)
    {"energy_beam_broken", "J", "lost in beams that broke so far", FLAT, BROKEN, false, oz_flat_breakage, 2},
    {"energy_beam_yielded", "J", "lost in beams that yielded so far", FLAT, YIELD, false, oz_flat_breakage, 3},
    OZ_LEDGER_WORK(WORK_ROW)
    {"energy_residual", "J", "change of (kinetic + rotational + potential + stored + pistons' kinetic) + all that "
     "is lost - work_walls since the first row; 0 but for the integrator's error", ALL, LEDGER, false,
     residual, 0},
    {0},
};
/* clang-format on */

const OzColumn *oz_observables_list(void)
{
    return list;
}

int oz_observables_width(const OzColumn *column, const OzScene *scene)
{
    const int cells[] = {
        [ALWAYS] = 1,
        [LEDGER] = 1,
        [ORDER] = 1,
        [PHASES] = 1,
        [CELL] = 1,
        [SHEAR] = 1,
        [STRENGTH] = 1,
        [BROKEN] = 1,
        [YIELD] = 1,
        [LAYERS] = OZ_MEASURE_LAYERS,
        [SERVOS] = oz_servo_number(scene, scene->wall_count),
        [WALLS] = scene->wall_count * (int)strlen(oz_wall_columns_axes(WALLS, scene)),
        [WALL_TURNS] = scene->wall_count * (int)strlen(oz_wall_columns_axes(WALL_TURNS, scene))};
    return (column->models & 1 << scene->model) != 0 ? cells[column->need] : 0;
}

int oz_observables_cells(const OzColumn *column, const OzScene *scene)
{
    bool of_walls = column->need == WALLS || column->need == WALL_TURNS;
    bool of_ledger = column->need == LEDGER || column->need == BROKEN || column->need == YIELD;
    bool of_strength = column->need == STRENGTH || column->need == BROKEN;
    bool is_there =
        (!of_ledger || scene->observe.ledger) && (!of_strength || scene->beams.strength.present) &&
        (column->need != YIELD || scene->beams.yield.present) &&
        (column->need != ORDER || scene->observe.order) &&
        (column->need != CELL || oz_stress_volume(&scene->boundary) > 0) &&
        (column->need != SHEAR || scene->boundary.is_sheared) &&
        (column->need != PHASES || scene->phase_count > 0) && (!of_walls || scene->observe.walls);
    return is_there ? oz_observables_width(column, scene) : 0;
}

void oz_observables_name(const OzColumn *column, const OzScene *scene, int cell,
                         char name[OZ_COLUMN_NAME])
{
    const char *axes = oz_wall_columns_axes(column->need, scene);
    int count = (int)strlen(axes), thing = column->need == LAYERS ? cell + 1 : cell / count;
    thing = column->need == SERVOS ? oz_wall_columns_servo(scene, cell) : thing;
    const char *at = column->name, *number = strstr(at, "<i>"), *letter = strstr(at, "<x>");
    if (!number) {
        snprintf(name, OZ_COLUMN_NAME, "%s", at);
    } else if (!letter) {
        snprintf(name, OZ_COLUMN_NAME, "%.*s%d%s", (int)(number - at), at, thing, number + 3);
    } else {
        snprintf(name, OZ_COLUMN_NAME, "%.*s%d%.*s%c", (int)(number - at), at, thing,
                 (int)(letter - number - 3), number + 3, axes[cell % count]);
    }
}
