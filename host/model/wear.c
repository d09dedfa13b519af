/* Arrays of wear. */
#include "model/wear.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

int64_t oz_wear_scars(const OzElements *elements)
{
    int64_t pairs = 0;
    for (int64_t g = 0; g < elements->grain_count; g++) {
        int64_t count = elements->first[g + 1] - elements->first[g];
        pairs += count * (count - 1) / 2;
    }
    return pairs;
}

static void number_scars(OzWear *wear, const OzElements *elements)
{
    int64_t next = 0;
    for (int64_t g = 0; g < elements->grain_count; g++) {
        int64_t end = elements->first[g + 1];
        for (int64_t i = elements->first[g]; i < end; i++) {
            wear->scar_first[i] = next - (i + 1);
            wear->scar_end[i] = end;
            next += end - (i + 1);
        }
    }
}

int64_t oz_wear_scar(const OzWear *wear, int64_t a, int64_t b)
{
    return a < wear->element_count && b < wear->scar_end[a] ? wear->scar_first[a] + b : -1;
}

OzStatus oz_wear_create(OzWear *wear, const OzElements *elements)
{
    OzStatus status = OZ_OK;
    *wear = (OzWear){.beam_count = elements->beam_count,
                     .scar_count = oz_wear_scars(elements),
                     .element_count = elements->free_count};
    OZ_TRY(OZ_NEW(&wear->whole, wear->beam_count));
    OZ_TRY(OZ_NEW(&wear->lost, wear->beam_count));
    OZ_TRY(OZ_NEW(&wear->yielded, wear->beam_count));
    OZ_TRY(OZ_NEW(&wear->rest, 3 * wear->beam_count));
    OZ_TRY(OZ_NEW(&wear->scar, wear->scar_count));
    OZ_TRY(OZ_NEW(&wear->scar_first, wear->element_count));
    OZ_TRY(OZ_NEW(&wear->scar_end, wear->element_count));
    for (int64_t k = 0; k < wear->beam_count; k++) {
        wear->whole[k] = 1;
        wear->rest[3 * k] = elements->beam_length[k];
        wear->rest[3 * k + 1] = elements->beam_rest_a[k];
        wear->rest[3 * k + 2] = elements->beam_rest_b[k];
    }
    number_scars(wear, elements);
done:
    if (status != OZ_OK) {
        oz_wear_free(wear);
    }
    return status;
}

void oz_wear_free(OzWear *wear)
{
    free(wear->whole);
    free(wear->lost);
    free(wear->yielded);
    free(wear->rest);
    free(wear->scar);
    free(wear->scar_first);
    free(wear->scar_end);
    memset(wear, 0, sizeof *wear);
}

static void copy(double *to, const double *from, int64_t count)
{
    if (count > 0) {
        memcpy(to, from, (size_t)count * sizeof *to);
    }
}

void oz_wear_copy(OzWear *to, const OzWear *from)
{
    copy(to->whole, from->whole, to->beam_count);
    copy(to->lost, from->lost, to->beam_count);
    copy(to->yielded, from->yielded, to->beam_count);
    copy(to->rest, from->rest, 3 * to->beam_count);
    copy(to->scar, from->scar, to->scar_count);
}

int64_t oz_wear_broken(const OzWear *wear)
{
    int64_t broken = 0;
    for (int64_t k = 0; k < wear->beam_count; k++) {
        broken += !(wear->whole[k] > 0);
    }
    return broken;
}

static double sum_of(const double *values, int64_t count)
{
    double sum = 0;
    for (int64_t k = 0; k < count; k++) {
        sum += values[k];
    }
    return sum;
}

double oz_wear_lost(const OzWear *wear)
{
    return sum_of(wear->lost, wear->beam_count);
}

double oz_wear_yielded(const OzWear *wear)
{
    return sum_of(wear->yielded, wear->beam_count);
}

OzStatus oz_wear_state(OzWear *wear, OzStateVisit *visit)
{
    if (!wear->whole) {
        return OZ_OK;
    }
    OZ_PASS(oz_state_double(visit, "beam_whole", "none", wear->whole, wear->beam_count));
    OZ_PASS(oz_state_double(visit, "beam_lost", "J", wear->lost, wear->beam_count));
    OZ_PASS(oz_state_double(visit, "beam_yielded", "J", wear->yielded, wear->beam_count));
    OZ_PASS(oz_state_double(visit, "beam_rest", "m, rad", wear->rest, 3 * wear->beam_count));
    return oz_state_double(visit, "scar", "m^1.5", wear->scar, wear->scar_count);
}
