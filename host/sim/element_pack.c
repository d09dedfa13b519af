/* Packing and unpacking elements. */
#include "sim/element_pack.h"

#include "base/memory.h"
#include "sim/element_wear.h"
#include "sim/units.h"

#include <math.h>
#include <stdlib.h>

/* Words of a slot's state: kernels know them as OZ_ELEMENT_STATE, a constant of their program. The
 * host serves programs of every order and takes it from the switches. */
static int state_words(const OzArrays *arrays)
{
    return 3 * oz_element_fields_switches(arrays)->order;
}

/* Where word `word` of a slot is in an array of blocks of `words` words. */
static size_t at(const OzArrays *arrays, int slot, int words, int word)
{
    int lanes = oz_element_fields_switches(arrays)->lanes;
    return ((size_t)(slot / lanes) * (size_t)words + (size_t)word) * (size_t)lanes +
           (size_t)(slot % lanes);
}

static double inverse(double value)
{
    return value > 0 ? 1 / value : 0;
}

/* How far an element may go in one step: half of what it is thick, or a disc's radius, so that none
 * can pass through another unseen. */
static double stride_most(const OzElements *elements, int64_t i)
{
    return 0.5 * fmin(elements->reach[i], elements->area[i] / elements->reach[i]);
}

static OzStatus write_shapes(OzArrays *arrays, int member, const OzUnits *units,
                             const OzElements *elements)
{
    OzStatus status = OZ_OK;
    const OzElementSizes *z = oz_element_fields_sizes(arrays);
    size_t count = (size_t)z->slots * OZ_ELEMENT_SHAPE;
    double *words = NULL, length = units->length, inertia = oz_units_inertia(units);
    OZ_TRY(OZ_NEW(&words, count));
    for (int64_t i = 0; i < elements->count; i++) {
        int slot = oz_element_fields_slot(z, elements, i);
        double shape[OZ_ELEMENT_SHAPE] = {
            [OZ_PS_REACH] = elements->reach[i] / length,
            [OZ_PS_RADIUS] = elements->radius[i] / length,
            [OZ_PS_INVERSE_MASS] = inverse(elements->mass[i]) * units->mass,
            [OZ_PS_INVERSE_INERTIA] = inverse(elements->inertia[i]) * inertia,
            [OZ_PS_STRIDE_MOST] = stride_most(elements, i) / length};
        for (int k = 0; k < 6; k++) {
            shape[OZ_PS_CORNER + k] = elements->corner[6 * i + k] / length;
        }
        for (int k = 0; k < OZ_ELEMENT_SHAPE; k++) {
            words[at(arrays, slot, OZ_ELEMENT_SHAPE, k)] = shape[k];
        }
    }
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_shape, member, words, count));
done:
    free(words);
    return status;
}

/* A coordinate and its derivatives, times dt^n / n!. */
static void put_coordinate(const OzArrays *arrays, double *words, int slot, int coordinate,
                           double dt, const double derivative[5])
{
    int order = oz_element_fields_switches(arrays)->order;
    double scale = 1;
    for (int n = 0; n < order; n++) {
        words[at(arrays, slot, state_words(arrays), coordinate * order + n)] =
            derivative[n] * scale;
        scale *= dt / (n + 1);
    }
}

static OzStatus write_state(OzArrays *arrays, int member, const OzElementParameters *p,
                            const OzElements *elements, const OzElementStart *start)
{
    OzStatus status = OZ_OK;
    const OzElementSizes *z = oz_element_fields_sizes(arrays);
    size_t count = (size_t)z->slots * (size_t)state_words(arrays);
    double *words = NULL;
    OZ_TRY(OZ_NEW(&words, count));
    for (int64_t i = 0; i < elements->count; i++) {
        int slot = oz_element_fields_slot(z, elements, i);
        bool free = i < elements->free_count;
        for (int c = 0; c < 3; c++) {
            double place = c < 2 ? elements->position[2 * i + c] : elements->angle[i];
            double rate = c < 2 ? elements->velocity[2 * i + c] : elements->angular_velocity[i];
            double d[5] = {place, free ? rate : 0, free ? start->acceleration[3 * i + c] : 0,
                           free ? start->third[3 * i + c] : 0, free ? start->fourth[3 * i + c] : 0};
            for (int n = 0; n < 5 && c < 2; n++) {
                d[n] /= p->units.length;
            }
            put_coordinate(arrays, words, slot, c, p->dt, d);
        }
    }
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_state, member, words, count));
done:
    free(words);
    return status;
}

static OzStatus write_slow_loads(OzArrays *arrays, int member, const OzUnits *units,
                                 const OzElements *elements, const double *touch)
{
    OzStatus status = OZ_OK;
    size_t count = (size_t)oz_element_fields_sizes(arrays)->slots * OZ_ELEMENT_LOAD;
    double *words = NULL;
    if (oz_element_fields_switches(arrays)->substeps == 1) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&words, count));
    for (int64_t i = 0; i < elements->free_count; i++) {
        words[OZ_ELEMENT_LOAD * i] = touch[3 * i] / oz_units_force(units);
        words[OZ_ELEMENT_LOAD * i + 1] = touch[3 * i + 1] / oz_units_force(units);
        words[OZ_ELEMENT_LOAD * i + 2] = touch[3 * i + 2] / oz_units_energy(units);
    }
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_slow_load, member, words, count));
done:
    free(words);
    return status;
}

OzStatus oz_element_pack_bodies(OzArrays *arrays, int member, const OzGrains *grains,
                                unsigned present)
{
    OzStatus status = OZ_OK;
    const OzElementSizes *z = oz_element_fields_sizes(arrays);
    const OzElements *elements = grains->elements;
    bool breaks = oz_element_fields_switches(arrays)->strength != 0;
    int64_t grain_count = elements->grain_count;
    int64_t walls = breaks ? elements->free_count : grain_count; /* numbers no grain can have */
    int *body = NULL, *wall = NULL, *pieces = NULL;
    if (breaks) {
        OZ_TRY(oz_element_wear_bodies(arrays, member, elements, &pieces));
    }
    OZ_TRY(OZ_NEW(&body, z->slots));
    OZ_TRY(OZ_NEW(&wall, z->slots));
    for (int slot = 0; slot < z->slots; slot++) {
        body[slot] = -1;
        wall[slot] = slot < z->free_slots ? -1 : 0;
    }
    for (int64_t i = 0; i < elements->count; i++) {
        int slot = oz_element_fields_slot(z, elements, i);
        int w = i < elements->free_count ? -1 : elements->body[i] - (int)grain_count;
        int own = w < 0 && pieces ? pieces[i] : elements->body[i];
        wall[slot] = w;
        body[slot] = w < 0 ? own : (present >> w & 1U) ? (int)walls + w : -1;
    }
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_body, member, body,
                           (size_t)z->slots * sizeof *body));
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_wall, member, wall,
                           (size_t)z->slots * sizeof *wall));
done:
    free(body);
    free(wall);
    free(pieces);
    return status;
}

/* What contacts with a potential know of elements. Discs, which have no edges, count as those of
 * one: lanes of one outer edge are the quickest. */
OzStatus oz_element_pack_outer_edges(OzArrays *arrays, int member, const OzElements *elements)
{
    OzStatus status = OZ_OK;
    const OzElementSizes *z = oz_element_fields_sizes(arrays);
    int *edges = NULL;
    if (!oz_element_fields_switches(arrays)->triangle_field) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&edges, z->slots));
    for (int64_t i = 0; i < elements->count; i++) {
        bool disc = elements->radius[i] > 0;
        edges[oz_element_fields_slot(z, elements, i)] =
            disc ? 1 : oz_elements_outer_edges(elements, i);
    }
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_outer_edges, member, edges,
                           (size_t)z->slots * sizeof *edges));
done:
    free(edges);
    return status;
}

/* Which beams each element has, by partner: beams are ordered by their first element, then by the
 * second. */
static OzStatus write_adjacency(OzArrays *arrays, int member, const OzElements *elements)
{
    OzStatus status = OZ_OK;
    int slots = oz_element_fields_sizes(arrays)->free_slots;
    int *first = NULL, *of = NULL;
    OZ_TRY(OZ_NEW(&first, slots + 2));
    OZ_TRY(OZ_NEW(&of, 2 * elements->beam_count + 1));
    for (int64_t k = 0; k < elements->beam_count; k++) {
        first[elements->beam_a[k] + 2]++;
        first[elements->beam_b[k] + 2]++;
    }
    for (int i = 2; i < slots + 2; i++) {
        first[i] += first[i - 1];
    }
    for (int64_t k = 0; k < elements->beam_count; k++) {
        of[first[elements->beam_b[k] + 1]++] = (int)k; /* partners before it come first */
    }
    for (int64_t k = 0; k < elements->beam_count; k++) {
        of[first[elements->beam_a[k] + 1]++] = (int)k;
    }
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_beam_first, member, first,
                           (size_t)(slots + 1) * sizeof *first));
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_beam_of, member, of,
                           2 * (size_t)elements->beam_count * sizeof *of));
done:
    free(first);
    free(of);
    return status;
}

/* Beams, filled up to whole blocks with the first. */
static OzStatus write_beams(OzArrays *arrays, int member, const OzUnits *units,
                            const OzElements *elements)
{
    OzStatus status = OZ_OK;
    size_t count = (size_t)oz_element_fields_sizes(arrays)->beam_blocks *
                   (size_t)oz_element_fields_switches(arrays)->lanes;
    int *a = NULL, *b = NULL;
    double *rest = NULL;
    if (elements->beam_count == 0) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&a, count));
    OZ_TRY(OZ_NEW(&b, count));
    OZ_TRY(OZ_NEW(&rest, OZ_BEAM_REST * count));
    for (size_t k = 0; k < count; k++) {
        size_t beam = k < (size_t)elements->beam_count ? k : 0;
        a[k] = elements->beam_a[beam];
        b[k] = elements->beam_b[beam];
        rest[at(arrays, (int)k, OZ_BEAM_REST, 0)] = elements->beam_length[beam] / units->length;
        rest[at(arrays, (int)k, OZ_BEAM_REST, 1)] = elements->beam_rest_a[beam];
        rest[at(arrays, (int)k, OZ_BEAM_REST, 2)] = elements->beam_rest_b[beam];
    }
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_beam_a, member, a, count * sizeof *a));
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_beam_b, member, b, count * sizeof *b));
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_beam_rest, member, rest,
                                   OZ_BEAM_REST * count));
    OZ_TRY(write_adjacency(arrays, member, elements));
done:
    free(a);
    free(b);
    free(rest);
    return status;
}

/* An empty ledger whose entries grow at these rates, W. */
static OzStatus write_ledger(OzArrays *arrays, int member, const OzUnits *units,
                             const OzElementLedger *power)
{
    OzStatus status = OZ_OK;
    size_t bytes = oz_arrays_bytes(arrays, OZ_ELEMENT_FIELD_ledger);
    double *words = NULL, unit = oz_units_energy(units) / units->time; /* W */
    OZ_TRY(oz_memory_new((void **)&words, bytes + sizeof(double) * OZ_ELEMENT_LEDGER_WORDS, 1,
                         "ledger"));
#define PUT(NAME, member, column, meaning)                                                         \
    words[OZ_ELEMENT_LEDGER + OZ_PL_##NAME] = power->member / unit;
    OZ_ELEMENT_LEDGER_LOSSES(PUT)
    OZ_LEDGER_WORK(PUT)
#undef PUT
    OZ_TRY(oz_arrays_write(arrays, OZ_ELEMENT_FIELD_ledger, member, words, bytes));
done:
    free(words);
    return status;
}

OzStatus oz_element_pack_start(OzArrays *arrays, int member, const OzElementParameters *parameters,
                               const OzGrains *grains, const OzElementStart *start)
{
    const OzUnits *units = &parameters->units;
    OZ_PASS(write_shapes(arrays, member, units, grains->elements));
    OZ_PASS(write_state(arrays, member, parameters, grains->elements, start));
    OZ_PASS(write_slow_loads(arrays, member, units, grains->elements, start->touch));
    OZ_PASS(oz_element_wear_start(arrays, member, grains->elements));
    OZ_PASS(oz_element_pack_bodies(arrays, member, grains, ~0U));
    OZ_PASS(oz_element_pack_outer_edges(arrays, member, grains->elements));
    OZ_PASS(write_beams(arrays, member, units, grains->elements));
    return write_ledger(arrays, member, units, &start->power);
}

OzStatus oz_element_pack_parameters(OzArrays *arrays, int member,
                                    const OzElementParameters *parameters)
{
    OzElementParameters counted = oz_units_elements(parameters);
    return oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_parameters, member,
                                   (const double *)&counted, sizeof counted / sizeof(double));
}

OzStatus oz_element_pack_adopt(OzArrays *arrays, const OzArrays *from, int member, double ratio)
{
    OzStatus status = OZ_OK;
    int slots = oz_element_fields_sizes(arrays)->slots;
    int order = oz_element_fields_switches(arrays)->order;
    int known = oz_element_fields_switches(from)->order;
    double *words = NULL, *old = NULL;
    if (order == known && ratio == 1) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&words, (size_t)slots * (size_t)state_words(arrays)));
    OZ_TRY(oz_arrays_read_scalars(from, OZ_ELEMENT_FIELD_state, member, &old));
    for (int i = 0; i < 3 * slots; i++) {
        double scale = 1;
        for (int n = 0; n < order && n < known; n++, scale *= ratio) {
            words[at(arrays, i / 3, state_words(arrays), i % 3 * order + n)] =
                scale * old[at(from, i / 3, state_words(from), i % 3 * known + n)];
        }
    }
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_state, member, words,
                                   (size_t)slots * (size_t)state_words(arrays)));
done:
    free(words);
    free(old);
    return status;
}

OzStatus oz_element_pack_state(const OzArrays *arrays, int member,
                               const OzElementParameters *parameters, OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    double *words = NULL;
    int order = oz_element_fields_switches(arrays)->order, all = state_words(arrays);
    OZ_TRY(oz_arrays_read_scalars(arrays, OZ_ELEMENT_FIELD_state, member, &words));
    for (int slot = 0; slot < (int)snapshot->grains->elements->free_count; slot++) {
        for (int c = 0; c < 3; c++) {
            double unit = c < 2 ? parameters->units.length : 1;
            double place = words[at(arrays, slot, all, c * order)] * unit;
            double rate = words[at(arrays, slot, all, c * order + 1)] / parameters->dt * unit;
            *(c < 2 ? &snapshot->element_position[2 * slot + c] : &snapshot->element_angle[slot]) =
                place;
            *(c < 2 ? &snapshot->element_velocity[2 * slot + c]
                    : &snapshot->element_angular_velocity[slot]) = rate;
        }
    }
done:
    free(words);
    return status;
}
