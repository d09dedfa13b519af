/* Sums over a snapshot's contacts, which are in the order of ids. */
#include "draw/pressed.h"

#include "base/memory.h"
#include "draw/palette.h"
#include "scene/boundary.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* A chain that bears what presses a grain on the floor from all sides is as wide as it gets: most
 * bear a sixth of that, few much more. */
static const double WIDEST = 0.6, NARROWEST = 0.02;

double oz_pressed_scale(const OzSnapshot *snapshot, const OzLook *look)
{
    const OzGrains *grains = snapshot->grains;
    const double *gravity = snapshot->scene->gravity;
    double weight = 0, diameter = 0, width = 2 * look->half_width;
    for (int64_t i = 0; i < grains->count; i++) {
        weight += grains->mass[i];
        diameter += grains->diameter[i] / (double)grains->count;
    }
    weight *= sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    double force = weight / width * PI * diameter;
    force *= look->flat ? 1 : diameter / width;
    return force > 0 && isfinite(force) ? oz_palette_round_up(force) : 1;
}

double oz_pressed_width(const OzChain *chain, const OzLook *look)
{
    double share = chain->push / look->force_high;
    return fmin(fmax(WIDEST * share, NARROWEST), WIDEST);
}

/* Contacts of one pair follow each other; each at a wall is a chain of its own. */
static void add_chain(OzPressed *pressed, const OzSnapshot *snapshot, const OzContactEntry *e,
                      bool follows)
{
    double from[3], way[3];
    if (follows) {
        pressed->chains[pressed->chain_count - 1].push += e->push;
        return;
    }
    OzChain *chain = &pressed->chains[pressed->chain_count++];
    chain->push = e->push;
    const double *to = e->b < 0 ? e->point : snapshot->position + 3 * (size_t)e->b;
    oz_snapshot_place(snapshot, e->a, from);
    for (int k = 0; k < 3; k++) {
        way[k] = to[k] - snapshot->position[3 * (size_t)e->a + (size_t)k];
    }
    OzBoundary cell = oz_snapshot_cell(snapshot);
    oz_boundary_wrap(&cell, way);
    for (int k = 0; k < 3; k++) {
        chain->from[k] = from[k];
        chain->to[k] = from[k] + way[k];
    }
}

static void add_to_grains(OzPressed *pressed, const OzContactEntry *e, const OzLook *look,
                          bool follows)
{
    bool counts = look->colour == OZ_COLOUR_COORDINATION;
    double part = counts ? (follows ? 0 : 1.0 / OZ_PRESSED_CONTACTS) : e->push / look->force_high;
    pressed->share[e->a] += part;
    if (e->b >= 0) {
        pressed->share[e->b] += part;
    }
}

static OzStatus fit(OzPressed *pressed, int64_t count, int64_t contacts)
{
    if (count > pressed->capacity || contacts > pressed->chain_capacity) {
        oz_pressed_free(pressed);
        OZ_PASS(OZ_NEW(&pressed->share, count));
        OZ_PASS(OZ_NEW(&pressed->chains, contacts));
        pressed->capacity = count;
        pressed->chain_capacity = contacts;
    }
    return OZ_OK;
}

OzStatus oz_pressed_find(OzPressed *pressed, const OzSnapshot *snapshot, const OzLook *look)
{
    const OzContactList *list = &snapshot->contacts;
    bool is_shown =
        look->chains || look->colour == OZ_COLOUR_FORCE || look->colour == OZ_COLOUR_COORDINATION;
    int64_t count = snapshot->has_contacts ? list->count : 0;
    pressed->chain_count = 0;
    if (!is_shown) {
        return OZ_OK;
    }
    OZ_PASS(fit(pressed, snapshot->count, 2 * count + 1));
    memset(pressed->share, 0, (size_t)snapshot->count * sizeof *pressed->share);
    for (int64_t k = 0; k < count; k++) {
        const OzContactEntry *e = &list->entry[k], *last = k > 0 ? e - 1 : NULL;
        bool follows = last && last->a == e->a && last->b == e->b;
        add_to_grains(pressed, e, look, follows);
        if (look->chains) {
            add_chain(pressed, snapshot, e, follows && e->b >= 0);
        }
    }
    return OZ_OK;
}

void oz_pressed_free(OzPressed *pressed)
{
    free(pressed->share);
    free(pressed->chains);
    *pressed = (OzPressed){0};
}
