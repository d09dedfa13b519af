/* The host reference of elements: coordinates x, y and angle of every free element in one array,
 * their rates in another; integrators work on these and know nothing of elements. */
#include "sim/element_reference.h"

#define OZ_HOST
#include "base/memory.h"
#include "kernels/gear.h"
#include "model/step_clock.h"
#include "model/wall_motion.h"
#include "sim/element_forces.h"
#include "sim/element_part.h"

#include <stdlib.h>
#include <string.h>

typedef struct OzElementReference Reference;

struct OzElementReference {
    const OzScene *scene;
    const OzGrains *grains;
    const OzElements *elements;
    OzElementForces forces;
    OzWear wear; /* zeroed where beams hold                                */
    int64_t step;
    OzStepClock clock;
    int64_t count;        /* coordinates: 3 x free_count                       */
    bool primed;          /* acceleration, power and gear hold for this step   */
    bool at_rest;         /* walls                                             */
    double *place, *rate; /* x y angle, and their rates                        */
    double *acceleration; /* of the last evaluation                            */
    double *touch;        /* of contacts alone, when beams have substeps       */
    double *scratch;      /* 8 x count                                         */
    OzGear *gear;
    double *position, *angle, *velocity, *angular_velocity; /* of all elements, as last evaluated */
    OzElementLedger ledger, power;
    int64_t deep_count; /* contacts beyond guards.overlap.warn, each counted once a step */
};

/* Which forces an evaluation is about. */
typedef OzStatus (*Evaluate)(OzElementForces *forces, const OzElementState *state);

static OzElementState show(Reference *r, const double *place, const double *rate, double time)
{
    for (int64_t i = 0; i < r->elements->free_count; i++) {
        memcpy(&r->position[2 * i], &place[3 * i], 2 * sizeof(double));
        memcpy(&r->velocity[2 * i], &rate[3 * i], 2 * sizeof(double));
        r->angle[i] = place[3 * i + 2];
        r->angular_velocity[i] = rate[3 * i + 2];
    }
    oz_wall_motion_place(r->elements, r->scene, time, r->at_rest, r->position, r->angle,
                         r->velocity, r->angular_velocity);
    return (OzElementState){r->position,         r->angle, r->velocity,
                            r->angular_velocity, time,     r->at_rest};
}

/* Evaluations change beams and scars from here on, and a beam that breaks was there until `before`
 * (s) earlier; or, less than 0, they only look. */
static void wear(Reference *r, double before)
{
    r->forces.bear.wears = r->forces.bear.wear && before >= 0;
    r->forces.bear.before = before;
}

/* Accelerations in a state. */
static OzStatus evaluate(Reference *r, Evaluate forces_of, const double *place, const double *rate,
                         double time, double *acceleration)
{
    OzElementState state = show(r, place, rate, time);
    OZ_PASS(forces_of(&r->forces, &state));
    for (int64_t i = 0; i < r->elements->free_count; i++) {
        acceleration[3 * i] = r->forces.force[2 * i] / r->elements->mass[i];
        acceleration[3 * i + 1] = r->forces.force[2 * i + 1] / r->elements->mass[i];
        acceleration[3 * i + 2] = r->forces.torque[i] / r->elements->inertia[i];
    }
    return OZ_OK;
}

static void add_power(OzElementLedger *sum, const OzElementLedger *power, double time)
{
#define ADD(NAME, member, column, meaning) sum->member += power->member * time;
    OZ_ELEMENT_LEDGER_LOSSES(ADD)
    OZ_LEDGER_WORK(ADD)
#undef ADD
}

/* Trapezoid from the power before to that of the last evaluation. */
static void note_power(Reference *r, double dt)
{
    add_power(&r->ledger, &r->power, 0.5 * dt);
    add_power(&r->ledger, &r->forces.power, 0.5 * dt);
    r->power = r->forces.power;
}

static double time_of(const Reference *r)
{
    return oz_step_clock_time(&r->clock, r->step);
}

/* to = from + s way, coordinate by coordinate. */
static void move(double *to, const double *from, double s, const double *way, int64_t count)
{
    for (int64_t k = 0; k < count; k++) {
        to[k] = from[k] + s * way[k];
    }
}

/* Runge and Kutta's fourth order from (place, rate) at a time; dt may be negative. Powers go into
 * the ledger by the same quadrature. */
static OzStatus step_rk4(Reference *r, double *place, double *rate, double time, double dt)
{
    static const double ahead[4] = {0, 0.5, 0.5, 1},
                        weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    int64_t n = r->count;
    double *x = r->scratch, *v = x + n, *a = v + n, *sum_v = a + n, *sum_a = sum_v + n;
    memset(sum_v, 0, 2 * (size_t)n * sizeof(double));
    for (int stage = 0; stage < 4; stage++) {
        double h = ahead[stage] * dt;
        if (stage == 0) {
            memcpy(x, place, (size_t)n * sizeof(double));
            memcpy(v, rate, (size_t)n * sizeof(double));
        } else {
            move(x, place, h, v, n);
            move(v, rate, h, a, n);
        }
        OZ_PASS(evaluate(r, oz_element_forces_evaluate, x, v, time + h, a));
        move(sum_v, sum_v, weight[stage], v, n);
        move(sum_a, sum_a, weight[stage], a, n);
        add_power(&r->ledger, &r->forces.power, weight[stage] * dt);
    }
    move(place, place, dt, sum_v, n);
    move(rate, rate, dt, sum_a, n);
    return OZ_OK;
}

/* Beams break and scars heal by the state at a step's begin alone. */
static OzStatus rk4(Reference *r, double dt)
{
    if (r->forces.bear.wear) {
        wear(r, 0);
        OZ_PASS(
            evaluate(r, oz_element_forces_hold, r->place, r->rate, time_of(r), r->acceleration));
        OZ_PASS(evaluate(r, oz_element_forces_touch, r->place, r->rate, time_of(r), r->touch));
        wear(r, -1);
    }
    return step_rk4(r, r->place, r->rate, time_of(r), dt);
}

/* Forces with the velocity that the old acceleration predicts, so that damping is of second order.
 */
static OzStatus verlet_with(Reference *r, Evaluate forces_of, double *acceleration, double time,
                            double dt)
{
    int64_t n = r->count;
    double *ahead = r->scratch, *old = ahead + n;
    memcpy(old, acceleration, (size_t)n * sizeof(double));
    move(r->place, r->place, dt, r->rate, n);
    move(r->place, r->place, 0.5 * dt * dt, old, n);
    move(ahead, r->rate, dt, old, n);
    OZ_PASS(evaluate(r, forces_of, r->place, ahead, time + dt, acceleration));
    move(r->rate, r->rate, 0.5 * dt, old, n);
    move(r->rate, r->rate, 0.5 * dt, acceleration, n);
    return OZ_OK;
}

static OzStatus verlet(Reference *r, double dt)
{
    wear(r, 0.5 * dt);
    OZ_PASS(verlet_with(r, oz_element_forces_evaluate, r->acceleration, time_of(r), dt));
    note_power(r, dt);
    return OZ_OK;
}

/* Half a kick by contacts, beams and gravity in substeps, the other half (Tuckerman, Berne and
 * Martyna 1992). Damping sees the kick at once, or the step would be of first order. */
static OzStatus verlet_substeps(Reference *r, double dt)
{
    int64_t n = r->count, parts = r->scene->beams.substeps;
    double *ahead = r->scratch, part = dt / (double)parts;
    OzElementLedger before = r->power, touch = {0};
    move(r->rate, r->rate, 0.5 * dt, r->touch, n);
    wear(r, 0);
    OZ_PASS(evaluate(r, oz_element_forces_hold, r->place, r->rate, time_of(r), r->acceleration));
    wear(r, 0.5 * part);
    for (int64_t k = 0; k < parts; k++) {
        OZ_PASS(verlet_with(r, oz_element_forces_hold, r->acceleration,
                            time_of(r) + (double)k * part, part));
        OZ_PASS(oz_element_forces_check(&r->forces, r->step + 1, time_of(r) + dt));
        add_power(&r->ledger, &r->forces.power, part);
    }
    move(ahead, r->rate, 0.5 * dt, r->touch, n);
    OZ_PASS(evaluate(r, oz_element_forces_touch, r->place, ahead, time_of(r) + dt, r->touch));
    touch = r->forces.power;
    move(r->rate, r->rate, 0.5 * dt, r->touch, n);
    add_power(&r->ledger, &before, 0.5 * dt);
    add_power(&r->ledger, &touch, 0.5 * dt);
    r->power = touch;
    return OZ_OK;
}

static OzStatus gear(Reference *r, double dt)
{
    for (int64_t k = 0; k < r->count; k++) {
        r->gear[k] = oz_gear_predict(r->gear[k]);
        r->place[k] = r->gear[k].value[0];
        r->rate[k] = r->gear[k].value[1] / dt;
    }
    wear(r, 0.5 * dt);
    OZ_PASS(evaluate(r, oz_element_forces_evaluate, r->place, r->rate, time_of(r) + dt,
                     r->acceleration));
    note_power(r, dt);
    for (int64_t k = 0; k < r->count; k++) {
        r->gear[k] = oz_gear_correct(r->gear[k], r->acceleration[k], 0.5 * dt * dt);
        r->place[k] = r->gear[k].value[0];
        r->rate[k] = r->gear[k].value[1] / dt;
    }
    return OZ_OK;
}

/* Accelerations two steps back to two steps ahead (5 x count, step k at 2 + k) of the present
 * state, which is left as it is. */
static OzStatus look_around(Reference *r, double time, double dt, double *around)
{
    int64_t n = r->count;
    double *place = r->scratch + 5 * n, *rate = place + n;
    OzElementLedger ledger = r->ledger;
    for (int way = -1; way <= 1; way += 2) {
        memcpy(place, r->place, (size_t)n * sizeof(double));
        memcpy(rate, r->rate, (size_t)n * sizeof(double));
        for (int k = 0; k <= 2; k++) {
            double now = time + way * k * dt;
            OZ_PASS(evaluate(r, oz_element_forces_evaluate, place, rate, now,
                             around + (2 + way * k) * n));
            OZ_PASS(step_rk4(r, place, rate, now, way * dt));
        }
    }
    r->ledger = ledger;
    return OZ_OK;
}

static OzStatus derive(Reference *r, double time, double *second, double *third, double *fourth)
{
    OzStatus status = OZ_OK;
    int64_t n = r->count;
    double h = r->clock.dt, *a = NULL;
    OZ_TRY(OZ_NEW(&a, 5 * n));
    OZ_TRY(look_around(r, time, h, a));
    for (int64_t k = 0; k < n; k++) {
        double a0 = a[k], a1 = a[n + k], a2 = a[2 * n + k], a3 = a[3 * n + k], a4 = a[4 * n + k];
        second[k] = a2;
        third[k] = (a0 - 8 * a1 + 8 * a3 - a4) / (12 * h);
        fourth[k] = (-a0 + 16 * a1 - 30 * a2 + 16 * a3 - a4) / (12 * h * h);
    }
done:
    free(a);
    return status;
}

static OzStatus prime_gear(Reference *r)
{
    OzStatus status = OZ_OK;
    int64_t n = r->count;
    double *derived = NULL;
    OZ_TRY(OZ_NEW(&derived, 3 * n));
    OZ_TRY(derive(r, time_of(r), derived, derived + n, derived + 2 * n));
    for (int64_t k = 0; k < n; k++) {
        r->gear[k] = oz_gear_start(r->place[k], r->rate[k], derived[k], derived[n + k],
                                   derived[2 * n + k], r->clock.dt);
    }
done:
    free(derived);
    return status;
}

/* One row for each integrator. */
static OzStatus (*method_of(const Reference *r))(Reference *r, double dt)
{
    switch (r->scene->integrator) {
    case OZ_INTEGRATOR_RK4:
        return rk4;
    case OZ_INTEGRATOR_GEAR4:
        return gear;
    default:
        return r->scene->beams.substeps > 1 ? verlet_substeps : verlet;
    }
}

/* What the first step needs to know of the start. */
static OzStatus prime(Reference *r)
{
    double time = time_of(r);
    if (r->scene->integrator == OZ_INTEGRATOR_GEAR4) {
        OZ_PASS(prime_gear(r));
    }
    if (method_of(r) == verlet_substeps) {
        OZ_PASS(evaluate(r, oz_element_forces_hold, r->place, r->rate, time, r->acceleration));
        OZ_PASS(evaluate(r, oz_element_forces_touch, r->place, r->rate, time, r->touch));
    } else {
        OZ_PASS(evaluate(r, oz_element_forces_evaluate, r->place, r->rate, time, r->acceleration));
    }
    r->power = r->forces.power;
    r->primed = true;
    return OZ_OK;
}

OzStatus oz_element_reference_advance(OzElementReference *reference, int64_t step)
{
    double dt = reference->clock.dt;
    if (!reference->primed && step > 0) {
        OZ_PASS(prime(reference));
    }
    while (reference->step < step) {
        OZ_PASS(method_of(reference)(reference, dt));
        wear(reference, -1);
        reference->step++;
        reference->deep_count += reference->forces.deep_count;
        OzElementState now = show(reference, reference->place, reference->rate, time_of(reference));
        oz_element_forces_watch(&reference->forces, &now, dt);
        OZ_PASS(oz_element_forces_check(&reference->forces, reference->step, time_of(reference)));
        if (reference->forces.bear.broke) {
            OZ_PASS(oz_element_part_grains(&reference->forces, reference->grains, &now));
        }
    }
    return OZ_OK;
}

OzStatus oz_element_reference_snapshot(const OzElementReference *reference, OzSnapshot *snapshot)
{
    const Reference *r = reference;
    for (int64_t i = 0; i < r->elements->free_count; i++) {
        memcpy(&snapshot->element_position[2 * i], &r->place[3 * i], 2 * sizeof(double));
        memcpy(&snapshot->element_velocity[2 * i], &r->rate[3 * i], 2 * sizeof(double));
        snapshot->element_angle[i] = r->place[3 * i + 2];
        snapshot->element_angular_velocity[i] = r->rate[3 * i + 2];
    }
    snapshot->step = r->step;
    snapshot->time = time_of(r);
    if (snapshot->wear.whole) {
        oz_wear_copy(&snapshot->wear, &r->wear);
        OZ_PASS(oz_snapshot_split(snapshot));
    }
    oz_wall_motion_place(r->elements, r->scene, snapshot->time, r->at_rest,
                         snapshot->element_position, snapshot->element_angle,
                         snapshot->element_velocity, snapshot->element_angular_velocity);
    oz_snapshot_move_walls(snapshot);
    oz_snapshot_join_elements(snapshot);
    snapshot->deep_count = r->deep_count;
    snapshot->has_ledger = r->scene->observe.ledger;
    snapshot->element_ledger = r->ledger;
    snapshot->element_ledger.beam_broken = oz_wear_lost(&r->wear);
    snapshot->element_ledger.beam_yielded = oz_wear_yielded(&r->wear);
    return oz_element_forces_contacts(snapshot);
}

static OzStatus create_arrays(Reference *r)
{
    int64_t n = r->count, all = r->elements->count;
    OZ_PASS(OZ_NEW(&r->place, n));
    OZ_PASS(OZ_NEW(&r->rate, n));
    OZ_PASS(OZ_NEW(&r->acceleration, n));
    OZ_PASS(OZ_NEW(&r->touch, n));
    OZ_PASS(OZ_NEW(&r->scratch, 8 * n));
    OZ_PASS(OZ_NEW(&r->gear, n));
    OZ_PASS(OZ_NEW(&r->position, 2 * all));
    OZ_PASS(OZ_NEW(&r->angle, all));
    OZ_PASS(OZ_NEW(&r->velocity, 2 * all));
    return OZ_NEW(&r->angular_velocity, all);
}

/* Coordinates and rates from arrays of elements. */
static void load_state(Reference *r, const double *position, const double *angle,
                       const double *velocity, const double *angular_velocity)
{
    for (int64_t i = 0; i < r->elements->free_count; i++) {
        memcpy(&r->place[3 * i], &position[2 * i], 2 * sizeof(double));
        memcpy(&r->rate[3 * i], &velocity[2 * i], 2 * sizeof(double));
        r->place[3 * i + 2] = angle[i];
        r->rate[3 * i + 2] = angular_velocity[i];
    }
}

OzStatus oz_element_reference_create(OzElementReference **reference, const OzScene *scene,
                                     const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    Reference *r = NULL;
    const OzElements *elements = grains->elements;
    OZ_TRY(OZ_NEW(&r, 1));
    r->scene = scene;
    r->grains = grains;
    r->clock = oz_step_clock_begin(scene->step);
    r->elements = elements;
    r->count = 3 * elements->free_count;
    OZ_TRY(oz_element_forces_create(&r->forces, scene, grains));
    if (oz_beam_types_wear(&scene->beams)) {
        OZ_TRY(oz_wear_create(&r->wear, elements));
        r->forces.bear.wear = &r->wear;
    }
    OZ_TRY(create_arrays(r));
    load_state(r, elements->position, elements->angle, elements->velocity,
               elements->angular_velocity);
done:
    if (status != OZ_OK) {
        oz_element_reference_free(r);
        r = NULL;
    }
    *reference = r;
    return status;
}

void oz_element_reference_free(OzElementReference *reference)
{
    if (!reference) {
        return;
    }
    oz_element_forces_free(&reference->forces);
    oz_wear_free(&reference->wear);
    free(reference->place);
    free(reference->rate);
    free(reference->acceleration);
    free(reference->touch);
    free(reference->scratch);
    free(reference->gear);
    free(reference->position);
    free(reference->angle);
    free(reference->velocity);
    free(reference->angular_velocity);
    free(reference);
}

OzStatus oz_element_reference_start_derivatives(const OzSnapshot *snapshot, bool at_rest,
                                                double *second, double *third, double *fourth)
{
    OzStatus status = OZ_OK;
    Reference *r = NULL;
    OZ_TRY(oz_element_reference_create(&r, snapshot->scene, snapshot->grains));
    r->at_rest = at_rest;
    load_state(r, snapshot->element_position, snapshot->element_angle, snapshot->element_velocity,
               snapshot->element_angular_velocity);
    OZ_TRY(derive(r, snapshot->time, second, third, fourth));
done:
    oz_element_reference_free(r);
    return status;
}
