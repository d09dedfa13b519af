/* Wear between device and host. */
#include "sim/element_wear.h"

#include "base/memory.h"
#include "model/pieces.h"
#include "sim/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where a word of a beam is, among `words` of them. */
static size_t at_of(const OzArrays *arrays, int64_t beam, int words, int word)
{
    int64_t lanes = oz_element_fields_switches(arrays)->lanes;
    return (size_t)((beam / lanes * words + word) * lanes + beam % lanes);
}

static size_t at(const OzArrays *arrays, int64_t beam, int word)
{
    return at_of(arrays, beam, OZ_BEAM_WEAR, word);
}

static size_t beam_words(const OzArrays *arrays)
{
    return (size_t)oz_element_fields_sizes(arrays)->beam_blocks *
           (size_t)oz_element_fields_switches(arrays)->lanes * OZ_BEAM_WEAR;
}

/* Of the depth of a scar, m^1.5. */
static double depth_unit(const OzUnits *units)
{
    return units->length * sqrt(units->length);
}

static OzStatus write_integers(OzArrays *arrays, int field, int member, const int64_t *values,
                               int64_t count)
{
    OzStatus status = OZ_OK;
    int *words = NULL;
    int slots = oz_element_fields_sizes(arrays)->free_slots;
    OZ_TRY(OZ_NEW(&words, slots));
    for (int64_t i = 0; i < count; i++) {
        words[i] = (int)values[i];
    }
    OZ_TRY(oz_arrays_write(arrays, field, member, words, (size_t)slots * sizeof *words));
done:
    free(words);
    return status;
}

/* Padding is broken, and stays so. */
static OzStatus write_beams(OzArrays *arrays, int member, const OzWear *wear, double energy)
{
    OzStatus status = OZ_OK;
    double *words = NULL;
    OZ_TRY(OZ_NEW(&words, beam_words(arrays)));
    for (int64_t k = 0; k < wear->beam_count; k++) {
        words[at(arrays, k, OZ_BW_WHOLE)] = wear->whole[k];
        words[at(arrays, k, OZ_BW_LOST)] = wear->lost[k] / energy;
        words[at(arrays, k, OZ_BW_YIELDED)] = wear->yielded[k] / energy;
    }
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_beam_wear, member, words,
                                   beam_words(arrays)));
done:
    free(words);
    return status;
}

static OzStatus write_scars(OzArrays *arrays, int member, const OzWear *wear, double unit)
{
    OzStatus status = OZ_OK;
    int64_t count = oz_element_fields_sizes(arrays)->scars;
    double *words = NULL;
    OZ_TRY(OZ_NEW(&words, count));
    for (int64_t k = 0; k < wear->scar_count; k++) {
        words[k] = wear->scar[k] / unit;
    }
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_ELEMENT_FIELD_scar, member, words, (size_t)count));
done:
    free(words);
    return status;
}

OzStatus oz_element_wear_write(OzArrays *arrays, int member, const OzUnits *units,
                               const OzWear *wear)
{
    OZ_PASS(write_beams(arrays, member, wear, oz_units_energy(units)));
    return write_scars(arrays, member, wear, depth_unit(units));
}

OzStatus oz_element_wear_start(OzArrays *arrays, int member, const OzElements *elements)
{
    OzStatus status = OZ_OK;
    OzWear wear = {0};
    const OzUnits one = {1, 1, 1};
    if (!oz_element_fields_switches(arrays)->strength) {
        return OZ_OK;
    }
    OZ_TRY(oz_wear_create(&wear, elements));
    OZ_TRY(write_integers(arrays, OZ_ELEMENT_FIELD_scar_first, member, wear.scar_first,
                          wear.element_count));
    OZ_TRY(write_integers(arrays, OZ_ELEMENT_FIELD_scar_end, member, wear.scar_end,
                          wear.element_count));
    OZ_TRY(oz_element_wear_write(arrays, member, &one, &wear));
done:
    oz_wear_free(&wear);
    return status;
}

OzStatus oz_element_wear_read(const OzArrays *arrays, int member, const OzUnits *units,
                              OzWear *wear)
{
    OzStatus status = OZ_OK;
    double *words = NULL, *scars = NULL, *rest = NULL;
    if (!oz_element_fields_switches(arrays)->strength || !wear->whole) {
        return OZ_OK;
    }
    OZ_TRY(oz_arrays_read_scalars(arrays, OZ_ELEMENT_FIELD_beam_wear, member, &words));
    OZ_TRY(oz_arrays_read_scalars(arrays, OZ_ELEMENT_FIELD_scar, member, &scars));
    OZ_TRY(oz_arrays_read_scalars(arrays, OZ_ELEMENT_FIELD_beam_rest, member, &rest));
    for (int64_t k = 0; k < wear->beam_count; k++) {
        wear->whole[k] = words[at(arrays, k, OZ_BW_WHOLE)];
        wear->lost[k] = words[at(arrays, k, OZ_BW_LOST)] * oz_units_energy(units);
        wear->yielded[k] = words[at(arrays, k, OZ_BW_YIELDED)] * oz_units_energy(units);
        for (int w = 0; w < OZ_BEAM_REST; w++) {
            double unit = w == 0 ? units->length : 1;
            wear->rest[OZ_BEAM_REST * k + w] = rest[at_of(arrays, k, OZ_BEAM_REST, w)] * unit;
        }
    }
    for (int64_t k = 0; k < wear->scar_count; k++) {
        wear->scar[k] = scars[k] * depth_unit(units);
    }
done:
    free(words);
    free(scars);
    free(rest);
    return status;
}

OzStatus oz_element_wear_bodies(const OzArrays *arrays, int member, const OzElements *elements,
                                int **body)
{
    OzStatus status = OZ_OK;
    OzWear wear = {0};
    int64_t count;
    const OzUnits one = {1, 1, 1};
    OZ_TRY(OZ_NEW(body, elements->free_count));
    OZ_TRY(oz_wear_create(&wear, elements));
    OZ_TRY(oz_element_wear_read(arrays, member, &one, &wear));
    OZ_TRY(oz_pieces_find(*body, &count, elements, wear.whole));
done:
    oz_wear_free(&wear);
    return status;
}
