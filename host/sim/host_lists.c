/* Outer lists from P's sort along one axis. The device's order is kept (by the first grain's id,
 * then by the second one's), and tiles list pairs across their borders both (kernels/member.h), so
 * that forces are added up in the same order whoever made the list. */
#include "sim/host_lists.h"

#include "base/memory.h"
#include "sim/pack.h"
#include "sim/rods_private.h"
#include "sim/scalars.h"
#include "sim/sort_axis.h"

#include <stdlib.h>
#include <string.h>

/* A pair in a region's list, by its grains' ids. */
typedef struct Entry {
    int region, a, b;
} Entry;

/* A tangential and a rolling spring by the slots of their pair. */
typedef struct Spring {
    int a, b;
    double words[3], turned[3];
} Spring;

typedef struct Work {
    OzSim *sim;
    int member;
    OzSnapshot now;
    OzPairs pairs;
    int *id, *slot_of;
    Spring *springs; /* of the list before, those that are not zero, by a, then b */
    int64_t spring_count;
    Entry *entries;
    int64_t entry_count;
    int *a, *b, *count, *first, *number; /* the new list's fields */
    void *history, *rolling, *reference;
} Work;

static const OzSizes *sizes_of(const Work *w)
{
    return oz_rods_sizes(w->sim);
}

static const OzSwitches *switches_of(const Work *w)
{
    return oz_rods_switches(w->sim);
}

/* Nothing where the scene does not need the field. */
static OzStatus upload(Work *w, OzFieldId field, const void *data)
{
    size_t bytes = oz_arrays_bytes(&w->sim->arrays, field);
    return bytes > 0 ? oz_arrays_write(&w->sim->arrays, field, w->member, data, bytes) : OZ_OK;
}

static int by_slots(const void *one, const void *other)
{
    const Spring *x = one, *y = other;
    return x->a != y->a ? (x->a > y->a) - (x->a < y->a) : (x->b > y->b) - (x->b < y->b);
}

static void keep_spring(Work *w, int a, int b, const void *history, const void *rolling,
                        int64_t pair)
{
    Spring spring = {.a = a, .b = b};
    const OzSwitches *s = switches_of(w);
    bool any = false;
    for (int c = 0; c < 3; c++) {
        size_t at = (size_t)(3 * pair + c);
        spring.words[c] = oz_scalars_get(history, at, s->is_double);
        spring.turned[c] = s->rolling_spring ? oz_scalars_get(rolling, at, s->is_double) : 0;
        any |= spring.words[c] != 0 || spring.turned[c] != 0;
    }
    if (any) {
        w->springs[w->spring_count++] = spring;
    }
}

/* The springs of the list before, or of the saved ones, whose grains are given by id. */
static OzStatus read_springs(Work *w)
{
    OzStatus status = OZ_OK;
    const OzSizes *z = sizes_of(w);
    const OzArrays *arrays = &w->sim->arrays;
    int *a = NULL, *b = NULL, *count = NULL, truth = oz_rods_control(w->sim, w->member)->truth;
    bool saved = truth == OZ_SPRINGS_AT_SAVED;
    int64_t capacity = saved ? z->inner_capacity : z->outer_capacity;
    void *history = NULL, *rolling = NULL;
    if (!switches_of(w)->history || truth == OZ_SPRINGS_AT_NONE) {
        return OZ_OK;
    }
#define FIELD(name) saved ? OZ_FIELD_saved_##name : OZ_FIELD_outer_##name
    OZ_TRY(oz_arrays_download(arrays, FIELD(a), w->member, &a));
    OZ_TRY(oz_arrays_download(arrays, FIELD(b), w->member, &b));
    OZ_TRY(oz_arrays_download(arrays, FIELD(count), w->member, &count));
    OZ_TRY(oz_arrays_download(arrays, FIELD(history), w->member, &history));
    OZ_TRY(oz_arrays_download(arrays, FIELD(rolling), w->member, &rolling));
#undef FIELD
    OZ_TRY(OZ_NEW(&w->springs, (int64_t)z->regions * capacity));
    for (int r = 0; r < z->regions; r++) {
        int64_t begin = (int64_t)r * capacity;
        for (int64_t p = begin; p < begin + count[r]; p++) {
            keep_spring(w, saved ? w->slot_of[a[p]] : a[p], saved ? w->slot_of[b[p]] : b[p],
                        history, rolling, p);
        }
    }
    qsort(w->springs, (size_t)w->spring_count, sizeof *w->springs, by_slots);
done:
    free(a);
    free(b);
    free(count);
    free(history);
    free(rolling);
    return status;
}

/* Half-length + radius in the device's precision, which decides a pair's order. */
static double reach(const Work *w, int id)
{
    const OzGrains *grains = w->sim->batch.members[w->member].grains;
    double radius = grains->diameter[id] / 2, half_length = grains->length[id] / 2;
    return switches_of(w)->is_double ? radius + half_length
                                     : (double)((float)radius + (float)half_length);
}

static int region_of(const Work *w, int id)
{
    return w->slot_of[id] / sizes_of(w)->region_slots;
}

/* An entry for the first grain's region and, with tiles, one for the second's if that is another.
 */
static void add_entries(Work *w, OzPair pair)
{
    double reach_a = reach(w, pair.a), reach_b = reach(w, pair.b);
    bool swap = reach_a != reach_b ? reach_a < reach_b : pair.a > pair.b;
    int a = swap ? pair.b : pair.a, b = swap ? pair.a : pair.b;
    w->entries[w->entry_count++] = (Entry){region_of(w, a), a, b};
    if (switches_of(w)->resort && region_of(w, b) != region_of(w, a)) {
        w->entries[w->entry_count++] = (Entry){region_of(w, b), a, b};
    }
}

static int by_region_then_ids(const void *one, const void *other)
{
    const Entry *x = one, *y = other;
    if (x->region != y->region) {
        return (x->region > y->region) - (x->region < y->region);
    }
    return x->a != y->a ? (x->a > y->a) - (x->a < y->a) : (x->b > y->b) - (x->b < y->b);
}

static OzStatus find_entries(Work *w)
{
    const OzParameters *p = oz_rods_parameters(w->sim, w->member);
    OZ_PASS(oz_sort_axis_pairs(&w->pairs, w->now.grains, w->now.position, w->now.axis,
                               2 * p->outer_most, &w->now.scene->boundary));
    OZ_PASS(OZ_NEW(&w->entries, 2 * w->pairs.count));
    for (int64_t k = 0; k < w->pairs.count; k++) {
        add_entries(w, w->pairs.pair[k]);
    }
    qsort(w->entries, (size_t)w->entry_count, sizeof *w->entries, by_region_then_ids);
    return OZ_OK;
}

/* Room in every region's list for its pairs. */
static OzStatus make_room(Work *w)
{
    OzSizes sizes = *sizes_of(w);
    OzControlHead needed = {0};
    int64_t begin = 0;
    for (int64_t k = 0; k < w->entry_count; k++) {
        begin = w->entries[k].region != w->entries[begin].region ? k : begin;
        int count = (int)(k - begin + 1);
        needed.outer_needed = count > needed.outer_needed ? count : needed.outer_needed;
    }
    if (needed.outer_needed <= sizes.outer_capacity) {
        return OZ_OK;
    }
    oz_arrays_grow((OzSizesHead *)(void *)&sizes, &needed, switches_of(w)->lanes);
    w->sim->batch.counts.growths++;
    return oz_arrays_resize(&w->sim->arrays, &sizes);
}

static void put_history(Work *w, int64_t to, int a, int b)
{
    Spring key = {.a = a, .b = b};
    const Spring *found = w->spring_count > 0 ? bsearch(&key, w->springs, (size_t)w->spring_count,
                                                        sizeof key, by_slots)
                                              : NULL;
    if (found) {
        bool is_double = switches_of(w)->is_double;
        size_t at = 3 * (size_t)to * (is_double ? sizeof(double) : sizeof(float));
        oz_scalars_put((char *)w->history + at, found->words, 3, is_double);
        oz_scalars_put((char *)w->rolling + at, found->turned, 3, is_double);
    }
}

static OzStatus write_list(Work *w)
{
    const OzSizes *z = sizes_of(w);
    int64_t pairs = (int64_t)z->regions * z->outer_capacity;
    OZ_PASS(OZ_NEW(&w->a, pairs));
    OZ_PASS(OZ_NEW(&w->b, pairs));
    OZ_PASS(OZ_NEW(&w->count, z->regions));
    OZ_PASS(OZ_NEW(&w->first, z->slots));
    OZ_PASS(OZ_NEW(&w->number, z->slots));
    OZ_PASS(oz_memory_new(&w->history, 3 * (size_t)pairs, sizeof(double), "springs"));
    OZ_PASS(oz_memory_new(&w->rolling, 3 * (size_t)pairs, sizeof(double), "springs"));
    for (int64_t k = 0; k < w->entry_count; k++) {
        Entry entry = w->entries[k];
        int64_t to = (int64_t)entry.region * z->outer_capacity + w->count[entry.region]++;
        int a = w->a[to] = w->slot_of[entry.a], b = w->b[to] = w->slot_of[entry.b];
        if (w->number[a]++ == 0) {
            w->first[a] = (int)to;
        }
        put_history(w, to, a, b);
    }
    OZ_PASS(upload(w, OZ_FIELD_outer_a, w->a));
    OZ_PASS(upload(w, OZ_FIELD_outer_b, w->b));
    OZ_PASS(upload(w, OZ_FIELD_outer_count, w->count));
    OZ_PASS(upload(w, OZ_FIELD_outer_first, w->first));
    OZ_PASS(upload(w, OZ_FIELD_outer_number, w->number));
    OZ_PASS(upload(w, OZ_FIELD_outer_rolling, w->rolling));
    return upload(w, OZ_FIELD_outer_history, w->history);
}

/* The half-shaft, in the kernels' lengths, of whatever is in a slot, padding too, which nobody else
 * knows. */
static void half_shaft(const Work *w, const void *state, int slot, double half[3])
{
    const OzSwitches *s = switches_of(w);
    int id = slot < sizes_of(w)->count ? w->id[slot] : 0;
    double turn[4], unit = oz_rods_parameters(w->sim, w->member)->units.length;
    for (int c = 0; c < 4; c++) { /* words are x, y, z, w */
        turn[(c + 1) % 4] =
            oz_scalars_get(state, oz_pack_lane(s, slot, OZ_STATE, OZ_S_TURN + c), s->is_double);
    }
    oz_grains_axis(turn, half);
    for (int c = 0; c < 3; c++) {
        half[c] *= w->now.grains->length[id] / 2 / unit;
    }
}

/* Places and half-shafts from which the list's age is measured. Places are copied word by word: in
 * single precision they are integers. */
static OzStatus write_reference(Work *w)
{
    OzStatus status = OZ_OK;
    const OzSwitches *s = switches_of(w);
    size_t size = s->is_double ? sizeof(double) : sizeof(float);
    char *state = NULL, *reference;
    const OzParameters *p = oz_rods_parameters(w->sim, w->member);
    double half[3], skin = p->outer_most / p->units.length;
    OZ_TRY(oz_arrays_download(&w->sim->arrays, OZ_FIELD_state, w->member, &state));
    OZ_TRY(oz_arrays_download(&w->sim->arrays, OZ_FIELD_reference_outer, w->member, &w->reference));
    reference = w->reference;
    for (int slot = 0; slot < sizes_of(w)->slots; slot++) {
        half_shaft(w, state, slot, half);
        for (int c = 0; c < 3; c++) {
            memcpy(reference + size * oz_pack_lane(s, slot, OZ_REFERENCE_PLAIN, c),
                   state + size * oz_pack_lane(s, slot, OZ_STATE, OZ_S_POSITION + c), size);
            oz_scalars_put(reference + size * oz_pack_lane(s, slot, OZ_REFERENCE_PLAIN, 3 + c),
                           &half[c], 1, s->is_double);
        }
        oz_scalars_put(reference +
                           size * oz_pack_lane(s, slot, OZ_REFERENCE_PLAIN, OZ_REFERENCE_SKIN),
                       &skin, 1, s->is_double);
    }
    OZ_TRY(upload(w, OZ_FIELD_reference_outer, reference));
done:
    free(state);
    return status;
}

static OzStatus make_list(Work *w)
{
    OzControl *control = oz_rods_control(w->sim, w->member);
    const OzMember *member = &w->sim->batch.members[w->member];
    OZ_PASS(oz_snapshot_create(&w->now, member->scene, member->grains));
    OZ_PASS(
        oz_pack_state(&w->sim->arrays, w->member, oz_rods_parameters(w->sim, w->member), &w->now));
    OZ_PASS(oz_arrays_download(&w->sim->arrays, OZ_FIELD_id, w->member, &w->id));
    OZ_PASS(oz_arrays_download(&w->sim->arrays, OZ_FIELD_slot_of, w->member, &w->slot_of));
    OZ_PASS(read_springs(w));
    OZ_PASS(find_entries(w));
    OZ_PASS(make_room(w));
    OZ_PASS(write_list(w));
    OZ_PASS(write_reference(w));
    control->truth = OZ_SPRINGS_AT_OUTER;
    control->outer_stale = 0;
    control->rebuilds++;
    return OZ_OK;
}

static void free_work(Work *w)
{
    void *owned[] = {w->id,    w->slot_of, w->springs, w->entries, w->a,         w->b,
                     w->count, w->first,   w->number,  w->history, w->reference, w->rolling};
    for (size_t i = 0; i < sizeof owned / sizeof owned[0]; i++) {
        free(owned[i]);
    }
    oz_snapshot_free(&w->now);
    oz_sort_axis_free(&w->pairs);
}

static bool waits(const OzControl *control)
{
    return !control->stop_bits &&
           (control->truth == OZ_SPRINGS_AT_NONE || control->truth == OZ_SPRINGS_AT_SAVED ||
            (control->truth == OZ_SPRINGS_AT_OUTER && control->outer_stale));
}

OzStatus oz_host_lists_make(OzSim *sim)
{
    OzStatus status = OZ_OK;
    bool made = false;
    for (int m = 0; m < sim->batch.member_count; m++) {
        if (oz_rods_switches(sim)->host_lists && waits(oz_rods_control(sim, m))) {
            Work work = {.sim = sim, .member = m};
            status = make_list(&work);
            free_work(&work);
            OZ_TRY(status);
            made = true;
        }
    }
    if (!made) {
        status = oz_status_fail(OZ_ERR_DEVICE, "%s: the device stopped without a reason",
                                sim->batch.members[0].scene->path);
    }
done:
    return status;
}
