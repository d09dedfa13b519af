/* Spans of touching and their impulses, from one look to the next. */
#include "observe/hits.h"

#include <math.h>
#include <string.h>

static void keep(OzHits *hits, double impulse)
{
    int least = 0;
    hits->total += impulse;
    for (int i = 1; i < hits->span_count; i++) {
        least = hits->impulse[i] < hits->impulse[least] ? i : least;
    }
    if (hits->span_count == OZ_HITS_SPANS) {
        if (impulse <= hits->impulse[least]) {
            return;
        }
        hits->span_count--;
        memmove(&hits->impulse[least], &hits->impulse[least + 1],
                (size_t)(hits->span_count - least) * sizeof *hits->impulse);
    }
    hits->impulse[hits->span_count++] = impulse;
}

void oz_hits_look(OzHits *hits, const OzSnapshot *s)
{
    const double *mass = s->grains->mass, *v = s->velocity;
    double relative[2] = {v[0] - v[3], v[1] - v[4]};
    bool touching = oz_contact_list_sum(&s->contacts).pairs > 0;
    if (hits->touching && !touching) {
        double reduced = mass[0] * mass[1] / (mass[0] + mass[1]);
        keep(hits, reduced * hypot(relative[0] - hits->before[0], relative[1] - hits->before[1]));
    }
    if (!touching || hits->looks == 0) {
        memcpy(hits->before, relative, sizeof relative);
    }
    hits->touching = touching;
    hits->looks++;
}

double oz_hits_share(const OzHits *hits, int span)
{
    return hits->total > 0 ? hits->impulse[span] / hits->total : 0;
}

int oz_hits_count(const OzHits *hits, double share)
{
    int count = 0;
    for (int i = 0; i < hits->span_count; i++) {
        count += oz_hits_share(hits, i) >= share;
    }
    return count;
}
