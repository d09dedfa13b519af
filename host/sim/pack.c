/* Packing grains into lanes and back. */
#include "sim/pack.h"

#include "base/memory.h"
#include "sim/scalars.h"
#include "sim/units.h"

#include <stdlib.h>
#include <string.h>

/* A coordinate of a grain, in units, and how many cells it was moved by to be within half of one.
 */
static double units_of(const OzParameters *p, const OzGrains *grains, int64_t i, int c, int *cells)
{
    double units = grains->position[3 * i + c] / p->length_unit;
    double period = p->period[c] + p->period_rest[c];
    *cells = period > 0 ? (int)rint(units / period) : 0;
    return units - *cells * period;
}

static void put(void *words, size_t index, double value, bool is_double)
{
    oz_scalars_put((char *)words + index * (is_double ? sizeof(double) : sizeof(float)), &value, 1,
                   is_double);
}

/* A coordinate, in units: an integer's bits in single precision. */
static void put_place(void *words, size_t index, double units, bool is_double)
{
    if (is_double) {
        ((double *)words)[index] = units;
    } else {
        ((int32_t *)words)[index] = (int32_t)units;
    }
}

static double get_place(const void *words, size_t index, bool is_double)
{
    return is_double ? ((const double *)words)[index] : (double)((const int32_t *)words)[index];
}

size_t oz_pack_lane(const OzSwitches *s, int64_t slot, int words, int word)
{
    int64_t block = slot / s->lanes, lane = slot % s->lanes;
    return (size_t)((block * words + word) * s->lanes + lane);
}

/* Angular momentum for a spin, both in the world frame. */
static void momentum(const OzGrains *grains, int64_t i, const double axis[3], double out[3])
{
    const double *spin = &grains->angular_velocity[3 * i];
    double along = spin[0] * axis[0] + spin[1] * axis[1] + spin[2] * axis[2];
    for (int c = 0; c < 3; c++) {
        double extra = (grains->inertia_axis[i] - grains->inertia[i]) * along * axis[c];
        out[c] = grains->inertia[i] * spin[c] + extra;
    }
}

static void put_turn(void *state, const OzSwitches *s, const double turn[4], int64_t slot)
{
    for (int c = 0; c < 4; c++) {
        double whole = turn[(c + 1) % 4];
        double held = s->is_double ? whole : (double)(float)whole;
        put(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_TURN + c), held, s->is_double);
        put(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_TURN_REST + c), whole - held, s->is_double);
    }
}

static void put_state(void *state, const OzSwitches *s, const OzParameters *p,
                      const OzGrains *grains, int64_t slot, int64_t i)
{
    bool wide = s->is_double;
    const double *turn = &grains->quaternion[4 * i];
    double axis[3], spin[3];
    oz_grains_axis(turn, axis);
    memcpy(spin, &grains->angular_velocity[3 * i], sizeof spin);
    if (s->gyroscopic) {
        momentum(grains, i, axis, spin);
    }
    double spin_unit = oz_units_spin(&p->units, s->gyroscopic);
    for (int c = 0; c < 3; c++) {
        int cells;
        double units = units_of(p, grains, i, c, &cells);
        double whole = wide ? units : rint(units);
        bool present = slot == i;
        put_place(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_POSITION + c), whole, wide);
        put(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_REST + c), units - whole, wide);
        put(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_VELOCITY + c),
            present ? grains->velocity[3 * i + c] / oz_units_speed(&p->units) : 0, wide);
        put(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_SPIN + c),
            present ? spin[c] / spin_unit : 0, wide);
    }
    put_turn(state, s, turn, slot);
}

static void put_shape(void *shape, const OzSwitches *s, const OzParameters *p,
                      const OzGrains *grains, int64_t slot, int64_t i)
{
    double words[OZ_SHAPE], inertia = oz_units_inertia(&p->units);
    words[OZ_B_RADIUS] = grains->diameter[i] / 2 / p->units.length;
    words[OZ_B_COUNT] = grains->diameter[i] / 2 / p->length_unit;
    words[OZ_B_HALF_LENGTH] = grains->length[i] / 2 / p->units.length;
    words[OZ_B_MASS] = grains->mass[i] / p->units.mass;
    words[OZ_B_INVERSE_INERTIA] = inertia / grains->inertia[i];
    words[OZ_B_INVERSE_AXIS] = inertia / grains->inertia_axis[i];
    for (int k = 0; k < OZ_SHAPE; k++) {
        put(shape, oz_pack_lane(s, slot, OZ_SHAPE, k), words[k], s->is_double);
    }
}

static void put_record(void *record, const OzSwitches *s, const OzParameters *p,
                       const OzGrains *grains, int64_t slot, int64_t i)
{
    bool wide = s->is_double;
    size_t base = (size_t)slot * OZ_RECORD;
    double axis[3];
    oz_grains_axis(&grains->quaternion[4 * i], axis);
    for (size_t c = 0; c < 3; c++) {
        int cells;
        double units = units_of(p, grains, i, (int)c, &cells);
        put_place(record, base + OZ_R_POSITION + c, wide ? units : rint(units), wide);
        put(record, base + OZ_R_SHAFT + c, grains->length[i] / 2 * axis[c] / p->units.length, wide);
        put(record, base + OZ_R_VELOCITY + c,
            grains->velocity[3 * (size_t)i + c] / oz_units_speed(&p->units), wide);
        put(record, base + OZ_R_RATE + c,
            grains->angular_velocity[3 * (size_t)i + c] * p->units.time, wide);
    }
    put(record, base + OZ_R_RADIUS, grains->diameter[i] / 2 / p->units.length, wide);
    put(record, base + OZ_R_MASS, grains->mass[i] / p->units.mass, wide);
}

/* The record of no grain: as far away as differences can bear. */
static void put_far_record(void *record, const OzSwitches *s, int64_t slot)
{
    size_t base = (size_t)slot * OZ_RECORD;
    put_place(record, base + OZ_R_POSITION, s->is_double ? 1e9 : 0x1p30 - 1, s->is_double);
    put(record, base + OZ_R_MASS, 1, s->is_double);
}

/* What a record leaves of a slot's place and turn, from its state. */
static void put_fine(void *fine, const OzSwitches *s, const void *state, int64_t slot)
{
    size_t base = (size_t)slot * OZ_FINE_RECORD;
    for (int c = 0; c < 4; c++) {
        const int words[3] = {OZ_S_REST + c, OZ_S_TURN + c, OZ_S_TURN_REST + c};
        const size_t to[3] = {OZ_N_REST, OZ_N_TURN, OZ_N_TURN_REST};
        for (int k = c < 3 ? 0 : 1; k < 3; k++) {
            size_t from = oz_pack_lane(s, slot, OZ_STATE, words[k]);
            put(fine, base + to[k] + (size_t)c, oz_scalars_get(state, from, s->is_double),
                s->is_double);
        }
    }
}

/* Records to both halves, where there are two. */
static OzStatus write_records(OzArrays *arrays, OzFieldId field, int member, void *records,
                              size_t words)
{
    const OzSwitches *s = oz_rods_fields_switches(arrays);
    size_t half =
        ((size_t)oz_rods_fields_sizes(arrays)->slots + 1) * words * oz_scalars_bytes(s->is_double);
    size_t bytes = oz_arrays_bytes(arrays, field);
    if (bytes > half) {
        memcpy((char *)records + half, records, half);
    }
    return bytes > 0 ? oz_arrays_write(arrays, field, member, records, bytes) : OZ_OK;
}

/* How many cells grains have gone by, where space repeats itself. */
static OzStatus write_images(OzArrays *arrays, int member, const OzParameters *p,
                             const OzGrains *grains)
{
    size_t bytes = oz_arrays_bytes(arrays, OZ_FIELD_image);
    int *image = NULL;
    if (bytes == 0) {
        return OZ_OK;
    }
    OZ_PASS(oz_memory_new((void **)&image, bytes, 1, "images of grains"));
    for (int64_t i = 0; i < 3 * grains->count; i++) {
        units_of(p, grains, i / 3, (int)(i % 3), &image[i]);
    }
    OzStatus status = oz_arrays_write(arrays, OZ_FIELD_image, member, image, bytes);
    free(image);
    return status;
}

OzStatus oz_pack_start(OzArrays *arrays, int member, const OzParameters *parameters,
                       const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    const OzSwitches *s = oz_rods_fields_switches(arrays);
    const OzSizes *z = oz_rods_fields_sizes(arrays);
    size_t state_bytes = oz_arrays_bytes(arrays, OZ_FIELD_state);
    size_t shape_bytes = oz_arrays_bytes(arrays, OZ_FIELD_shape);
    size_t record_bytes = oz_arrays_bytes(arrays, OZ_FIELD_record);
    size_t fine_bytes = oz_arrays_bytes(arrays, OZ_FIELD_fine);
    void *state = NULL, *shape = NULL, *record = NULL, *fine = NULL;
    int *id = NULL;
    OZ_TRY(oz_memory_new(&state, state_bytes, 1, "grain state"));
    OZ_TRY(oz_memory_new(&shape, shape_bytes, 1, "grain shapes"));
    OZ_TRY(oz_memory_new(&record, record_bytes, 1, "grain records"));
    OZ_TRY(oz_memory_new(&fine, fine_bytes, 1, "fine records of grains"));
    OZ_TRY(OZ_NEW(&id, z->slots));
    for (int slot = 0; slot < z->slots; slot++) {
        int64_t i = slot < z->count ? slot : 0;
        id[slot] = slot;
        put_state(state, s, parameters, grains, slot, i);
        put_record(record, s, parameters, grains, slot, i);
        if (fine_bytes > 0) {
            put_fine(fine, s, state, slot);
        }
        if (shape_bytes > 0) {
            put_shape(shape, s, parameters, grains, slot, i);
        }
    }
    put_far_record(record, s, z->slots);
    OZ_TRY(write_images(arrays, member, parameters, grains));
    OZ_TRY(oz_arrays_write(arrays, OZ_FIELD_state, member, state, state_bytes));
    OZ_TRY(oz_arrays_write(arrays, OZ_FIELD_shape, member, shape, shape_bytes));
    OZ_TRY(write_records(arrays, OZ_FIELD_record, member, record, OZ_RECORD));
    OZ_TRY(write_records(arrays, OZ_FIELD_fine, member, fine, OZ_FINE_RECORD));
    OZ_TRY(oz_arrays_write(arrays, OZ_FIELD_id, member, id, sizeof(int) * (size_t)z->slots));
    OZ_TRY(oz_arrays_write(arrays, OZ_FIELD_slot_of, member, id, sizeof(int) * (size_t)z->slots));
done:
    free(state);
    free(shape);
    free(record);
    free(fine);
    free(id);
    return status;
}

OzStatus oz_pack_parameters(OzArrays *arrays, int member, const OzParameters *parameters)
{
    double narrow[sizeof(OzParameters) / sizeof(double)];
    size_t count = sizeof(OzParameters) / sizeof(double);
    OzParameters counted = oz_units_parameters(parameters, oz_rods_fields_switches(arrays)->law);
    oz_scalars_put(narrow, (const double *)(const void *)&counted, count,
                   oz_rods_fields_switches(arrays)->is_double);
    return oz_arrays_write(arrays, OZ_FIELD_parameters, member, narrow,
                           oz_arrays_bytes(arrays, OZ_FIELD_parameters));
}

/* Spin for an angular momentum. */
static void spin_of(const OzGrains *grains, int64_t i, const double axis[3], double spin[3])
{
    double along = spin[0] * axis[0] + spin[1] * axis[1] + spin[2] * axis[2];
    double extra = 1 / grains->inertia_axis[i] - 1 / grains->inertia[i];
    for (int c = 0; c < 3; c++) {
        spin[c] = spin[c] / grains->inertia[i] + extra * along * axis[c];
    }
}

/* Single precision keeps a quaternion's length to 1e-7 only; files promise more. */
static void make_unit(double quaternion[4])
{
    double sum = 0;
    for (int c = 0; c < 4; c++) {
        sum += quaternion[c] * quaternion[c];
    }
    for (int c = 0; c < 4; c++) {
        quaternion[c] /= sqrt(sum);
    }
}

static void get_turn(const void *state, const OzSwitches *s, int64_t slot, double turn[4])
{
    for (int c = 0; c < 4; c++) {
        size_t whole = oz_pack_lane(s, slot, OZ_STATE, OZ_S_TURN + c);
        size_t rest = oz_pack_lane(s, slot, OZ_STATE, OZ_S_TURN_REST + c);
        turn[(c + 1) % 4] =
            oz_scalars_get(state, whole, s->is_double) + oz_scalars_get(state, rest, s->is_double);
    }
    make_unit(turn);
}

static void get_state(const void *state, const OzSwitches *s, const OzParameters *p, int64_t slot,
                      int64_t i, OzSnapshot *snapshot)
{
    bool wide = s->is_double;
    double speed_unit = oz_units_speed(&p->units);
    double spin_unit = oz_units_spin(&p->units, s->gyroscopic);
    for (int c = 0; c < 3; c++) {
        double whole = get_place(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_POSITION + c), wide);
        double rest = oz_scalars_get(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_REST + c), wide);
        snapshot->position[3 * i + c] = (whole + rest) * p->length_unit;
        snapshot->velocity[3 * i + c] =
            oz_scalars_get(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_VELOCITY + c), wide) *
            speed_unit;
        snapshot->angular_velocity[3 * i + c] =
            oz_scalars_get(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_SPIN + c), wide) * spin_unit;
    }
    get_turn(state, s, slot, &snapshot->quaternion[4 * i]);
    oz_grains_axis(&snapshot->quaternion[4 * i], &snapshot->axis[3 * i]);
    if (s->gyroscopic) {
        spin_of(snapshot->grains, i, &snapshot->axis[3 * i], &snapshot->angular_velocity[3 * i]);
    }
}

/* Paths go on where grains have left the cell. */
static OzStatus add_images(const OzArrays *arrays, int member, const OzParameters *p,
                           OzSnapshot *snapshot)
{
    size_t bytes = oz_arrays_bytes(arrays, OZ_FIELD_image);
    int *image = NULL;
    if (bytes == 0) {
        return OZ_OK;
    }
    OZ_PASS(oz_memory_new((void **)&image, bytes, 1, "images of grains"));
    OzStatus status = oz_arrays_read(arrays, OZ_FIELD_image, member, image, bytes);
    for (int64_t i = 0; i < 3 * snapshot->count && status == OZ_OK; i++) {
        double period = p->period[i % 3] + p->period_rest[i % 3];
        snapshot->position[i] += image[i] * period * p->length_unit;
    }
    free(image);
    return status;
}

OzStatus oz_pack_state(const OzArrays *arrays, int member, const OzParameters *parameters,
                       OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    const OzSwitches *s = oz_rods_fields_switches(arrays);
    const OzSizes *z = oz_rods_fields_sizes(arrays);
    size_t bytes = oz_arrays_bytes(arrays, OZ_FIELD_state);
    void *state = NULL;
    int *id = NULL;
    OZ_TRY(oz_memory_new(&state, bytes, 1, "grain state"));
    OZ_TRY(OZ_NEW(&id, z->slots));
    OZ_TRY(oz_arrays_read(arrays, OZ_FIELD_state, member, state, bytes));
    OZ_TRY(oz_arrays_read(arrays, OZ_FIELD_id, member, id, sizeof(int) * (size_t)z->slots));
    for (int slot = 0; slot < z->count; slot++) {
        get_state(state, s, parameters, slot, id[slot], snapshot);
    }
    OZ_TRY(add_images(arrays, member, parameters, snapshot));
    oz_snapshot_tilt(snapshot);
done:
    free(state);
    free(id);
    return status;
}
