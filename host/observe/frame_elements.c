/* Packing and unpacking of elements. Trusts no index that it reads. */
#include "observe/frame_elements.h"

#include <math.h>

enum {
    ELEMENT_BYTES = 8 * (1 + 6 + 4), /* radius, corner; area, mass, inertia, angle */
    FRAME_ELEMENT_BYTES = 4 * 5,     /* position, angle, velocity                  */
    FRAME_SPIN_BYTES = 4             /* angular velocity                           */
};

OzElementCounts oz_frame_elements_count(const OzElements *elements)
{
    return (OzElementCounts){.grains = elements->grain_count,
                             .walls = elements->wall_count,
                             .free_elements = elements->free_count,
                             .wall_elements = elements->count - elements->free_count,
                             .beams = elements->beam_count,
                             .outlines = elements->outline_count};
}

void oz_frame_elements_pack_head(OzBytes *at, const OzElementCounts *counts)
{
    const int64_t head[4] = {counts->free_elements, counts->wall_elements, counts->beams,
                             counts->outlines};
    oz_bytes_pack(at, head, sizeof head);
}

void oz_frame_elements_unpack_head(OzBytes *at, OzElementCounts *counts)
{
    int64_t head[4];
    oz_bytes_unpack(at, head, sizeof head);
    counts->free_elements = head[0];
    counts->wall_elements = head[1];
    counts->beams = head[2];
    counts->outlines = head[3];
}

size_t oz_frame_elements_static_bytes(const OzElementCounts *counts)
{
    int64_t integers = counts->grains + counts->walls + 1 + 2 * (counts->beams + counts->outlines);
    return 4 * (size_t)integers +
           (size_t)(counts->free_elements + counts->wall_elements) * ELEMENT_BYTES;
}

size_t oz_frame_elements_bytes(const OzElementCounts *counts, bool has_spin)
{
    size_t element = FRAME_ELEMENT_BYTES + (has_spin ? FRAME_SPIN_BYTES : 0);
    return (size_t)(counts->free_elements + counts->wall_elements) * element;
}

static void pack_integers(OzBytes *at, const int *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        int32_t value = (int32_t)values[i];
        oz_bytes_pack(at, &value, sizeof value);
    }
}

static void unpack_integers(OzBytes *at, int *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        int32_t value;
        oz_bytes_unpack(at, &value, sizeof value);
        values[i] = (int)value;
    }
}

void oz_frame_elements_pack_static(OzBytes *at, const OzElements *elements)
{
    size_t column = (size_t)elements->count * sizeof(double);
    for (int64_t b = 0; b <= elements->grain_count + elements->wall_count; b++) {
        int32_t first = (int32_t)elements->first[b];
        oz_bytes_pack(at, &first, sizeof first);
    }
    oz_bytes_pack(at, elements->radius, column);
    oz_bytes_pack(at, elements->corner, 6 * column);
    oz_bytes_pack(at, elements->area, column);
    oz_bytes_pack(at, elements->mass, column);
    oz_bytes_pack(at, elements->inertia, column);
    oz_bytes_pack(at, elements->angle, column);
    pack_integers(at, elements->beam_a, elements->beam_count);
    pack_integers(at, elements->beam_b, elements->beam_count);
    pack_integers(at, elements->outline_element, elements->outline_count);
    pack_integers(at, elements->outline_edge, elements->outline_count);
}

/* Bodies follow each other without gaps, each grain with an element at least. */
static bool unpack_bodies(OzBytes *at, OzElements *elements)
{
    int64_t bodies = elements->grain_count + elements->wall_count;
    for (int64_t b = 0; b <= bodies; b++) {
        int32_t first;
        oz_bytes_unpack(at, &first, sizeof first);
        elements->first[b] = first;
        int64_t least = b == 0 ? 0 : elements->first[b - 1] + (b <= elements->grain_count);
        if (first < least || first > elements->count || (b == 0 && first != 0)) {
            return false;
        }
        for (int64_t i = b > 0 ? elements->first[b - 1] : 0; i < first; i++) {
            elements->body[i] = (int)(b - 1);
        }
    }
    return elements->first[elements->grain_count] == elements->free_count &&
           elements->first[bodies] == elements->count;
}

static bool element_is_sound(const OzElements *elements, int64_t i)
{
    bool free_element = i < elements->free_count, good = elements->reach[i] < 1e30;
    good = good && elements->radius[i] >= 0 && elements->radius[i] < 1e30;
    good = good && elements->area[i] > 0 && elements->area[i] < 1e30;
    good = good && (free_element ? elements->mass[i] > 0 : elements->mass[i] == 0);
    good = good && (free_element ? elements->inertia[i] > 0 : elements->inertia[i] == 0);
    return good && elements->mass[i] < 1e30 && elements->inertia[i] < 1e30 &&
           isfinite(elements->angle[i]);
}

static bool all_are_within(const int *values, int64_t count, int64_t limit)
{
    for (int64_t i = 0; i < count; i++) {
        if (values[i] < 0 || values[i] >= limit) {
            return false;
        }
    }
    return true;
}

static void find_reach(OzElements *elements, int64_t i)
{
    double reach = elements->radius[i];
    for (int c = 0; c < 3; c++) {
        const double *corner = elements->corner + 6 * i + 2 * c;
        double next = hypot(corner[0], corner[1]);
        reach = next <= reach || isnan(reach) ? reach : next; /* a NaN is kept, to be refused */
    }
    elements->reach[i] = reach;
}

/* Beams join elements of one grain. */
static bool beams_are_sound(const OzElements *elements)
{
    for (int64_t k = 0; k < elements->beam_count; k++) {
        int a = elements->beam_a[k], b = elements->beam_b[k];
        if (a < 0 || b < 0 || a >= elements->free_count || b >= elements->free_count ||
            elements->body[a] != elements->body[b]) {
            return false;
        }
    }
    return true;
}

bool oz_frame_elements_unpack_static(OzBytes *at, OzElements *elements)
{
    size_t column = (size_t)elements->count * sizeof(double);
    if (!unpack_bodies(at, elements)) {
        return false;
    }
    oz_bytes_unpack(at, elements->radius, column);
    oz_bytes_unpack(at, elements->corner, 6 * column);
    oz_bytes_unpack(at, elements->area, column);
    oz_bytes_unpack(at, elements->mass, column);
    oz_bytes_unpack(at, elements->inertia, column);
    oz_bytes_unpack(at, elements->angle, column);
    unpack_integers(at, elements->beam_a, elements->beam_count);
    unpack_integers(at, elements->beam_b, elements->beam_count);
    unpack_integers(at, elements->outline_element, elements->outline_count);
    unpack_integers(at, elements->outline_edge, elements->outline_count);
    for (int64_t i = 0; i < elements->count; i++) {
        find_reach(elements, i);
        if (!element_is_sound(elements, i)) {
            return false;
        }
    }
    return beams_are_sound(elements) &&
           all_are_within(elements->outline_element, elements->outline_count, elements->count) &&
           all_are_within(elements->outline_edge, elements->outline_count, 3);
}

void oz_frame_elements_pack(OzBytes *at, const OzSnapshot *snapshot)
{
    oz_bytes_pack_floats(at, snapshot->element_position, 2 * snapshot->element_count);
    oz_bytes_pack_floats(at, snapshot->element_angle, snapshot->element_count);
    oz_bytes_pack_floats(at, snapshot->element_velocity, 2 * snapshot->element_count);
    oz_bytes_pack_floats(at, snapshot->element_angular_velocity, snapshot->element_count);
}

void oz_frame_elements_unpack(OzBytes *at, OzSnapshot *snapshot, bool has_spin)
{
    oz_bytes_unpack_floats(at, snapshot->element_position, 2 * snapshot->element_count);
    oz_bytes_unpack_floats(at, snapshot->element_angle, snapshot->element_count);
    oz_bytes_unpack_floats(at, snapshot->element_velocity, 2 * snapshot->element_count);
    memset(snapshot->element_angular_velocity, 0, (size_t)snapshot->element_count * sizeof(double));
    if (has_spin) {
        oz_bytes_unpack_floats(at, snapshot->element_angular_velocity, snapshot->element_count);
    }
}

void oz_frame_elements_join(OzSnapshot *snapshot, bool has_spin)
{
    oz_snapshot_join_elements(snapshot);
    if (!has_spin) {
        memset(snapshot->angular_velocity, 0, (size_t)(3 * snapshot->count) * sizeof(double));
    }
}

void oz_frame_elements_pack_wear(OzBytes *at, const OzWear *wear, bool breaks)
{
    for (int64_t k = 0; breaks && k < wear->beam_count; k++) {
        unsigned char whole = wear->whole[k] > 0;
        oz_bytes_pack(at, &whole, 1);
    }
}

OzStatus oz_frame_elements_unpack_wear(OzBytes *at, OzSnapshot *snapshot, bool breaks)
{
    OzWear *wear = &snapshot->wear;
    for (int64_t k = 0; breaks && k < wear->beam_count; k++) {
        unsigned char whole;
        oz_bytes_unpack(at, &whole, 1);
        wear->whole[k] = whole != 0;
    }
    return oz_snapshot_split(snapshot);
}
