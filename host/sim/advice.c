/* From the contacts of one grain to what would have held it. */
#include "sim/advice.h"

#include "model/prediction.h"
#include "sim/contacts.h"
#include "sim/stiffness.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Of the step that goes with an advised contact time: a hit then returns what was asked to a few
 * per cent with any integrator (README, "What a step costs"). */
static const double STEPS_PER_CONTACT = 30;

/* The deepest contact of a grain, and what pushes. */
typedef struct Press {
    OzContactEntry contact;
    double share;    /* overlap in units of kernels/depth.h                    */
    int wall;        /* scene index, -1: with another grain                    */
    int touching;    /* contacts of the grain                                  */
    double heaviest; /* kg, of it and what touches it                          */
} Press;

static bool blame_step(char *text, size_t size, const OzSnapshot *now)
{
    const OzScene *scene = now->scene;
    OzPrediction *rows = NULL;
    OzStiffness stiffness;
    int count = 0;
    double stable = INFINITY;
    const char *of = "a contact of two bodies";
    OzStatus status = oz_prediction_rows(&rows, &count, scene, now->grains);
    for (int i = 0; status == OZ_OK && i < count; i++) {
        stable = rows[i].stable ? stable : fmin(stable, rows[i].largest_step);
    }
    free(rows);
    if (isinf(stable) && oz_stiffness_applies(scene) &&
        oz_stiffness_measure(&stiffness, now) == OZ_OK && stiffness.largest_step < scene->step) {
        stable = stiffness.largest_step;
        of = "the contacts together";
    }
    if (!isinf(stable)) {
        snprintf(text, size, "time.step %g s is unstable for %s; expected below %.3g s",
                 scene->step, of, stable);
    }
    return !isinf(stable);
}

static OzStatus find(OzContactList *list, const OzSnapshot *now, int64_t grain)
{
    OzContacts contacts;
    OZ_PASS(oz_contacts_begin(&contacts, now, list));
    for (int64_t other = 0; other < now->count; other++) {
        if (other != grain) {
            OZ_PASS(oz_contacts_pair(&contacts, grain, other, NULL));
        }
    }
    for (int index = 0; index < contacts.physics.touches; index++) {
        OZ_PASS(oz_contacts_wall(&contacts, grain, index, NULL));
    }
    return OZ_OK;
}

/* The deepest of a grain's contacts. */
static Press press_of(const OzContactList *list, const OzGrains *g, int64_t grain)
{
    Press press = {.wall = -1, .heaviest = g->mass[grain], .touching = (int)list->count};
    for (int64_t i = 0; i < list->count; i++) {
        const OzContactEntry *e = &list->entry[i];
        int64_t other = e->a == grain ? e->b : e->a;
        double unit =
            other < 0 ? g->diameter[grain] / 4 : fmin(g->diameter[grain], g->diameter[other]) / 2;
        press.heaviest = other < 0 ? press.heaviest : fmax(press.heaviest, g->mass[other]);
        if (e->overlap / unit > press.share) {
            press.share = e->overlap / unit;
            press.contact = *e;
            press.wall = other < 0 ? (int)(-1 - other) : -1;
        }
    }
    return press;
}

/* How many times too deep the contact becomes by the energy that it holds and that of its approach.
 * Stored energy grows with the overlap's square, or with its power 5/2. */
static double excess_of_hit(const Press *press, const OzSnapshot *now, int64_t grain, double power)
{
    bool bears = press->heaviest > now->grains->mass[grain]; /* else several share its push */
    double mass = press->touching == 1 ? press->contact.mass
                                       : press->heaviest / (bears ? 1 : press->touching);
    double speed = fmax(press->contact.rate, 0), stored = press->contact.energy;
    double energy = stored + 0.5 * mass * speed * speed;
    double grows = stored > 0 ? pow(energy / stored, 1 / power) : 1;
    return press->share * grows / now->scene->guards.overlap_warn;
}

/* The same for the weight of the heaviest grain of all upon the lightest, at a wall (hooke), let go
 * there, which goes twice as deep as at rest. A contact time shorter by so much has a stiffness
 * larger by its square. */
static double excess_of_weight(const Press *press, const OzSnapshot *now)
{
    const OzGrains *g = now->grains;
    const OzContactEntry *contact = &press->contact;
    const double *gravity = now->scene->gravity;
    int64_t light = 0, heavy = 0;
    for (int64_t i = 0; i < g->count; i++) {
        light = g->mass[i] < g->mass[light] ? i : light;
        heavy = g->mass[i] > g->mass[heavy] ? i : heavy;
    }
    double rate2 = 2 * contact->energy / (contact->mass * contact->overlap * contact->overlap);
    double weight = g->mass[heavy] * sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] +
                                          gravity[2] * gravity[2]);
    double overlap = 2 * weight / (rate2 * g->mass[light]);
    return sqrt(overlap / (now->scene->guards.overlap_warn * g->diameter[light] / 4));
}

static void blame_softness(char *text, size_t size, const OzSnapshot *now, int64_t grain,
                           const Press *press)
{
    const OzScene *scene = now->scene;
    bool hooke = scene->contact.law == OZ_LAW_HOOKE;
    double times =
        excess_of_hit(press, now, grain, oz_contact_is_linear(scene->contact.law) ? 2 : 2.5);
    times =
        1.05 * fmax(1, hooke ? fmax(times, excess_of_weight(press, now)) : times); /* 2 digits */
    const char *why = "contacts are too soft for what pushes them; a smaller time.step does not "
                      "help,";
    if (!hooke) {
        snprintf(text, size, "%s %.2g times the stiffness would do", why, pow(times, 2.5));
        return;
    } else if (scene->material_count > 0) {
        snprintf(text, size, "%s contact times %.2g times shorter would do", why, times);
        return;
    }
    double own = press->wall < 0 ? scene->contact.contact_time
                                 : scene->walls[press->wall].contact.contact_time;
    char key[64] = "";
    if (own != scene->contact.contact_time) {
        snprintf(key, sizeof key, "walls.%d.", press->wall);
    }
    double needed = own / times, step = needed / STEPS_PER_CONTACT;
    size_t used =
        (size_t)snprintf(text, size, "%s %scontact.contact_time %.2g s would do", why, key, needed);
    if (scene->step > step && used < size) {
        snprintf(text + used, size - used, " (with time.step %.2g s)", step);
    }
}

void oz_advice_write(char *text, size_t size, const OzSnapshot *now, int64_t grain)
{
    OzContactList list = {0};
    snprintf(text, size, "`orzo check` says what step is stable");
    if (!blame_step(text, size, now) && find(&list, now, grain) == OZ_OK && list.count > 0) {
        Press press = press_of(&list, now->grains, grain);
        blame_softness(text, size, now, grain, &press);
    }
    oz_contact_list_free(&list);
}
