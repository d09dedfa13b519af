/* From an element that gave way to what would have held it. */
#include "sim/element_advice.h"

#include "model/beam_limits.h"
#include "sim/element_laws.h"
#include "sim/trial.h"

#include <math.h>
#include <stdio.h>

static double fastest(const OzSnapshot *now)
{
    double speed = oz_trial_speed(now->scene, oz_snapshot_whole(now));
    for (int64_t i = 0; i < now->count; i++) {
        speed = fmax(speed, hypot(now->velocity[3 * i], now->velocity[3 * i + 1]));
    }
    return speed;
}

static void advise_beams(char *text, size_t size, const OzSnapshot *now, int64_t grain, bool bent)
{
    OzTrial trial;
    if (oz_trial_hit(&trial, now->scene, oz_snapshot_whole(now), grain, fastest(now)) != OZ_OK) {
        return;
    }
    trial.deep = false; /* the beams gave way first */
    trial.bend = bent ? fmax(trial.bend, OZ_BEAM_BEND_MOST) : 0;
    trial.stretch = bent ? 0 : fmax(trial.stretch, 1 - OZ_BEAM_STRETCH_LEAST);
    oz_trial_advise(text, size, &trial, now->scene);
}

static double longest_edge(const double corners[6])
{
    double longest = 0;
    for (int c = 0; c < 3; c++) {
        const double *a = corners + 2 * c, *b = corners + 2 * ((c + 1) % 3);
        longest = fmax(longest, hypot(b[0] - a[0], b[1] - a[1]));
    }
    return longest;
}

static void advise_contact(char *text, size_t size, const OzSnapshot *now, int64_t element)
{
    const OzElements *p = now->grains->elements;
    double speed = fastest(now), radius = p->radius[element];
    if (radius > 0) {
        snprintf(text, size,
                 "contacts are too soft for hits at %.3g m/s; contact.contact_time %.2g s would do",
                 speed, 0.95 * 3.14159265358979323846 * 0.5 * radius / speed);
        return;
    }
    double edge = longest_edge(&p->corner[6 * element]), deep = 0.1 * 2 * p->area[element] / edge;
    double mass = now->grains->mass[p->body[element]];
    snprintf(text, size,
             "contacts are too soft for hits at %.3g m/s; triangles.stiffness %.2g would do", speed,
             fmax(1.05 * mass * speed * speed / (edge * deep * deep),
                  2 * now->scene->triangles.stiffness));
}

void oz_element_advice_write(char *text, size_t size, const OzSnapshot *now, int64_t element,
                             OzElementSoft soft)
{
    OzBeamLimit limit;
    snprintf(text, size, "`orzo check` says what step is stable");
    if (oz_beam_limits_find(&limit, now->scene, oz_snapshot_whole(now)) == OZ_OK &&
        !(now->scene->step < limit.largest_step)) {
        snprintf(text, size, "time.step %g s is unstable; expected below %.3g s", now->scene->step,
                 limit.largest_step);
    } else if (soft == OZ_ELEMENT_SOFT_CONTACT) {
        advise_contact(text, size, now, element);
    } else {
        advise_beams(text, size, now, oz_snapshot_whole(now)->elements->body[element],
                     soft == OZ_ELEMENT_SOFT_BENDING);
    }
}
