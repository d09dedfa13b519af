/* Overlaps of rods at the start, and what is said of any model's. */
#include "sim/start.h"

#include "base/log.h"
#include "model/contact.h"
#include "sim/contacts.h"
#include "sim/element_start.h"
#include "sim/sort_axis.h"

#include <math.h>
#include <string.h>

/* What looking at rods needs. */
typedef struct Look {
    OzStart *start;
    const OzScene *scene;
    const OzGrains *grains;
    OzSnapshot now;
    OzContacts contacts;
    double load; /* N */
} Look;

static bool is_read(const Look *look, int64_t i)
{
    return look->scene->populations[look->grains->population[i]].kind == OZ_GRAINS_FILE;
}

/* Takes the contact that was found last, if there is one, off the list. */
static void take(Look *look, OzStartOverlap overlap, double radius, double stop, bool read)
{
    OzContactList *list = &look->now.contacts;
    const OzContactEntry *last = list->entry;
    if (list->count == 0) {
        return;
    }
    list->count = 0;
    double power = oz_contact_is_linear(look->scene->contact.law) ? 2 : 2.5; /* of the energy */
    double force = power * last->energy / last->overlap;
    overlap.depth = last->overlap;
    overlap.energy = last->energy;
    overlap.share = last->overlap / radius;
    overlap.behind = overlap.b < 0 && last->overlap > radius;
    look->start->energy += last->energy;
    if (overlap.share > OZ_START_ROUNDING && force > look->load) {
        oz_start_overlap_add(look->start, &overlap,
                             read ? fmax(stop, OZ_START_MOST) : OZ_START_MOST, false);
    }
}

static OzStatus look_at_pair(Look *look, OzPair pair)
{
    const OzGrains *g = look->grains;
    OzStartOverlap overlap = {
        .a = pair.a < pair.b ? pair.a : pair.b, .b = pair.a < pair.b ? pair.b : pair.a, .wall = -1};
    OZ_PASS(oz_contacts_pair(&look->contacts, pair.a, pair.b, NULL));
    take(look, overlap, fmin(g->diameter[pair.a], g->diameter[pair.b]) / 2,
         look->scene->guards.overlap_stop, is_read(look, pair.a) && is_read(look, pair.b));
    return OZ_OK;
}

static OzStatus look_at_walls(Look *look, int64_t i)
{
    double radius = look->grains->diameter[i] / 2;
    const OzContactList *list = &look->now.contacts;
    for (int index = 0; index < look->contacts.physics.touches; index++) {
        OZ_PASS(oz_contacts_wall(&look->contacts, i, index, NULL));
        int wall = list->count > 0 ? -1 - list->entry[0].b : 0;
        OzStartOverlap overlap = {.a = i, .b = -1, .wall = wall};
        take(look, overlap, radius, look->scene->guards.overlap_stop / 2, is_read(look, i));
    }
    return OZ_OK;
}

static OzStatus look_at_rods(OzStart *start, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    OzPairs pairs = {0};
    Look look = {.start = start, .scene = scene, .grains = grains};
    look.load = oz_start_overlap_load(scene, grains);
    OZ_TRY(oz_snapshot_create(&look.now, scene, grains));
    for (int64_t i = 0; i < grains->count; i++) {
        oz_grains_axis(&grains->quaternion[4 * i], &look.now.axis[3 * i]);
        memcpy(&look.now.position[3 * i], &grains->position[3 * i], 3 * sizeof(double));
    }
    OZ_TRY(oz_contacts_begin(&look.contacts, &look.now, &look.now.contacts));
    OZ_TRY(
        oz_sort_axis_pairs(&pairs, grains, grains->position, look.now.axis, 0, &scene->boundary));
    for (int64_t k = 0; k < pairs.count; k++) {
        OZ_TRY(look_at_pair(&look, pairs.pair[k]));
    }
    for (int64_t i = 0; i < grains->count; i++) {
        OZ_TRY(look_at_walls(&look, i));
    }
done:
    oz_sort_axis_free(&pairs);
    oz_snapshot_free(&look.now);
    return status;
}

static bool only_random(const OzScene *scene)
{
    for (int p = 0; p < scene->population_count; p++) {
        if (scene->populations[p].kind != OZ_GRAINS_RANDOM) {
            return false;
        }
    }
    return true;
}

OzStatus oz_start_look(OzStart *start, const OzScene *scene, const OzGrains *grains)
{
    *start = (OzStart){.outside_first = -1};
    if (only_random(scene) || grains->count > OZ_START_COUNT_MOST) {
        return OZ_OK;
    }
    return grains->elements ? oz_element_start_look(start, scene, grains)
                            : look_at_rods(start, scene, grains);
}

/* The deepest overlap in words. */
static void describe(char *text, size_t size, const OzStart *start, bool flat)
{
    const OzStartOverlap *o = &start->worst;
    char other[48];
    snprintf(other, sizeof other, "grain %lld", (long long)o->b);
    if (o->b < 0) {
        snprintf(other, sizeof other, "walls.%d", o->wall);
    }
    if (o->behind && !flat) {
        snprintf(text, size, "grain %lld starts behind %s, %.3g m deep", (long long)o->a, other,
                 o->depth);
    } else {
        snprintf(text, size,
                 "grain %lld overlaps %s at the start by %.3g m, %.2g of the smaller radius%s; "
                 "their contact stores %.3g J",
                 (long long)o->a, other, o->depth, o->share,
                 o->behind ? " and more than half a triangle" : "", o->energy);
    }
    if (start->count > 1) {
        size_t used = strlen(text);
        snprintf(text + used, size - used, " (of %lld such overlaps the deepest; all store %.3g J)",
                 (long long)start->count, start->energy);
    }
}

OzStatus oz_start_judge(const OzScene *scene, const OzGrains *grains, bool force)
{
    OzStart start;
    char text[320];
    OzStatus status = oz_start_look(&start, scene, grains);
    if (status != OZ_OK) {
        return status;
    }
    if (start.outside > 0) {
        oz_log_line("warning: %s: grain %lld starts outside every container and no wall is below "
                    "it: it falls for ever (%lld such grains)",
                    scene->path, (long long)start.outside_first, (long long)start.outside);
    }
    if (start.count == 0) {
        return OZ_OK;
    }
    describe(text, sizeof text, &start, grains->elements != NULL);
    if (start.refused > 0 && !force) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: %s; expected less than %g of the smaller radius, "
                              "settle.overlaps: remove, or --force",
                              scene->path, text, OZ_START_MOST);
    }
    oz_log_line("warning: %s: %s", scene->path, text);
    return OZ_OK;
}
