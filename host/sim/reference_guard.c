/* What stops the reference: contacts too deep, bodies too fast or gone. */
#include "sim/reference_guard.h"

#include "sim/deep.h"

enum { WHAT = 96 };

/* What the guard looks at of a contact. */
typedef struct DeepContact {
    double overlap, rate; /* m, m/s                   */
    double unit, reach;   /* m, see kernels/depth.h   */
} DeepContact;

static OzStatus blowup(const OzReference *r, int grain, const char *what)
{
    return oz_status_fail(OZ_ERR_BLOWUP, "grain %d %s in step %lld (time %g s)", grain, what,
                          (long long)r->step, oz_step_clock_time(&r->clock, r->step));
}

/* As kernels/deep.h: counts a deep contact, *what receives what is wrong with one that stops. at:
 * m, in units of depth.h; a pair when other is not negative. */
static void judge(OzReference *r, DeepContact at, int grain, int other, char what[WHAT])
{
    const OzParameters *p = &r->physics.parameters;
    bool far = other < 0 && !(at.overlap <= 2 * at.reach);
    OzDeepFound found = {.count = 1,
                         .step = r->step + 1,
                         .time = oz_step_clock_time(&r->clock, r->step + 1),
                         .grain = grain,
                         .depth = at.overlap / r->shape[grain].radius,
                         .at_wall = other < 0};
    char body[32] = "a wall";
    if (other >= 0) {
        snprintf(body, sizeof body, "grain %d", other);
        found.depth = at.overlap / at.unit;
    }
    if (oz_depth_beyond(at.overlap, at.unit, p->deep_warn)) {
        if (r->deep_count++ == 0) {
            oz_deep_say(r->scene, &found, false);
        }
    }
    if (far) {
        snprintf(what, WHAT, "is through a wall");
    } else if (oz_depth_meets(at.overlap, at.rate, at.reach, r->physics.parameters.dt)) {
        snprintf(what, WHAT, "overlaps %s so far that %s", body,
                 other < 0 ? "its centre lies behind it" : "their shafts meet");
    } else if (oz_depth_beyond(at.overlap, at.unit, p->deep_stop)) {
        snprintf(what, WHAT, "overlaps %s by more than guards.overlap.stop", body);
    }
}

static OzStatus check_pairs(OzReference *r)
{
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        OzPair pair = r->near.pairs.pair[p];
        double one = r->shape[pair.a].radius, other = r->shape[pair.b].radius;
        DeepContact at = {r->pair_force[p].depth, r->pair_force[p].closing, fmin(one, other),
                          one + other};
        char what[WHAT] = "";
        judge(r, at, pair.a, pair.b, what);
        if (what[0]) {
            return blowup(r, pair.a, what);
        }
    }
    return OZ_OK;
}

static OzStatus check_walls(OzReference *r)
{
    int touches = r->physics.touches;
    for (int64_t k = 0; k < (int64_t)r->count * touches; k++) {
        const OzContact *contact = &r->wall_force[k].contact;
        int i = (int)(k / touches), wall;
        int part = oz_dialect_part(&r->physics, (int)(k % touches), &wall);
        double radius = r->shape[i].radius;
        bool is_end = part != OZ_WALL_TIP && part < OZ_WALL_PARTS;
        bool is_twin = is_end && !(r->shape[i].half_length > 0);
        DeepContact at = {contact->overlap, contact->rate, 0.5 * radius, radius};
        char what[WHAT] = "";
        if (!is_twin) {
            judge(r, at, i, -1, what);
        }
        if (what[0]) {
            return blowup(r, i, what);
        }
    }
    return OZ_OK;
}

/* The bounds are those of the kernels; the comparisons are false for NaN. */
static OzStatus check_bodies(const OzReference *r, double dt)
{
    for (int i = 0; i < r->count; i++) {
        const OzBody *b = &r->body[i];
        double domain = r->physics.parameters.domain;
        if (!oz_body_is_number(*b)) {
            return blowup(r, i, "is no number");
        }
        if (!(fabs(b->position.x) < domain && fabs(b->position.y) < domain &&
              fabs(b->position.z) < domain)) {
            return blowup(r, i, "has escaped");
        }
        double allowed = OZ_BODY_STEP_SHARE * r->shape[i].radius;
        if (!(oz_body_step2(*b, r->shape[i], dt) < allowed * allowed && oz_body_is_turn(*b))) {
            return blowup(r, i, "moves an end farther than half its radius");
        }
    }
    return OZ_OK;
}

OzStatus oz_reference_guard_check(OzReference *reference, double dt)
{
    if (reference->crowded >= 0) {
        return blowup(reference, reference->crowded,
                      "touches a mesh in more places than a grain can, eight,");
    }
    OZ_PASS(check_pairs(reference));
    OZ_PASS(check_walls(reference));
    return check_bodies(reference, dt);
}
