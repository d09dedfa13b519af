/* Keeping, ordering and adding up contacts. */
#include "model/contact_list.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_contact_list_add(OzContactList *list, const OzContactEntry *entry)
{
    OZ_PASS(OZ_ROOM(&list->entry, &list->capacity, list->count + 1, "contacts"));
    list->entry[list->count++] = *entry;
    return OZ_OK;
}

static int compare_ids(int64_t x, int64_t y)
{
    return (x > y) - (x < y);
}

/* Grains first, then walls in the scene's order. */
static int64_t rank(int64_t b)
{
    return b >= 0 ? b : INT32_MAX - b;
}

static int by_ids(const void *one, const void *other)
{
    const OzContactEntry *x = one, *y = other;
    int order = compare_ids(x->a, y->a);
    order = order ? order : compare_ids(rank(x->b), rank(y->b));
    order = order ? order : compare_ids(x->part_a, y->part_a);
    return order ? order : compare_ids(x->part_b, y->part_b);
}

void oz_contact_list_sort(OzContactList *list)
{
    if (list->count > 0) {
        qsort(list->entry, (size_t)list->count, sizeof *list->entry, by_ids);
    }
}

void oz_contact_list_free(OzContactList *list)
{
    free(list->entry);
    memset(list, 0, sizeof *list);
}

OzContactSums oz_contact_list_sum(const OzContactList *list)
{
    OzContactSums sums = {0};
    for (int64_t i = 0; i < list->count; i++) {
        const OzContactEntry *e = &list->entry[i];
        bool again = i > 0 && e[-1].a == e->a && e[-1].b == e->b;
        sums.kinds[e->kind]++;
        sums.pairs += e->b >= 0 && !again;
        sums.walls += e->b < 0;
        if (e->kind != OZ_CONTACT_DISC) {
            sums.overlap_sum += e->overlap;
            sums.overlap_max = fmax(sums.overlap_max, e->overlap);
        }
        sums.energy += e->energy + e->spring_energy;
        sums.spring_energy += e->spring_energy;
    }
    return sums;
}

/* The force on b, N. */
static void force_of(const OzContactEntry *e, double force[3])
{
    for (int k = 0; k < 3; k++) {
        force[k] = e->push * e->normal[k] + e->tangential[k];
    }
}

void oz_contact_list_push_walls(const OzContactList *list, double (*force)[3], int count)
{
    memset(force, 0, (size_t)count * sizeof *force);
    for (int64_t i = 0; i < list->count; i++) {
        const OzContactEntry *e = &list->entry[i];
        double own[3];
        force_of(e, own);
        for (int k = 0; e->b < 0 && k < 3; k++) {
            force[-1 - e->b][k] += own[k];
        }
    }
}

void oz_contact_list_turn_walls(const OzContactList *list, const double (*about)[3],
                                double (*torque)[3], int count)
{
    memset(torque, 0, (size_t)count * sizeof *torque);
    for (int64_t i = 0; i < list->count; i++) {
        const OzContactEntry *e = &list->entry[i];
        double arm[3], force[3];
        force_of(e, force);
        for (int k = 0; e->b < 0 && k < 3; k++) {
            arm[k] = e->point[k] - about[-1 - e->b][k];
        }
        for (int k = 0; e->b < 0 && k < 3; k++) {
            int l = (k + 1) % 3, m = (k + 2) % 3;
            torque[-1 - e->b][k] += arm[l] * force[m] - arm[m] * force[l] + e->couple[k];
        }
    }
}
