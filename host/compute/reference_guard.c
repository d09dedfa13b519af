/* What stops the reference: contacts too deep, bodies too fast or gone. */
#include "compute/reference_guard.h"

static OzStatus blowup(const OzReference *r, int grain, const char *what)
{
    return oz_status_fail(OZ_ERR_BLOWUP,
                          "grain %d %s in step %lld (time %g s); a smaller time.step may help",
                          grain, what, (long long)r->step, (double)r->step * r->scene->step);
}

static OzStatus check_contacts(const OzReference *r)
{
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        if (r->pair_force[p].deep) {
            char what[96];
            snprintf(what, sizeof what, "overlaps grain %d by more than the smaller radius",
                     r->near.pairs.pair[p].b);
            return blowup(r, r->near.pairs.pair[p].a, what);
        }
    }
    for (int64_t k = 0; k < (int64_t)r->count * r->wall_ends; k++) {
        const OzContact *contact = &r->wall_force[k].contact;
        int i = (int)(k / r->wall_ends);
        if (contact->touching && contact->overlap > r->shape[i].radius) {
            return blowup(r, i,
                          contact->overlap > 2 * r->shape[i].radius
                              ? "is through a wall"
                              : "overlaps a wall by more than its radius");
        }
    }
    return OZ_OK;
}

/* The bounds are those of the kernels; the comparisons are false for NaN. */
static OzStatus check_bodies(const OzReference *r, double dt)
{
    for (int i = 0; i < r->count; i++) {
        const OzBody *b = &r->body[i];
        double speed2 = oz_dot(b->velocity, b->velocity), spin2 = oz_dot(b->spin, b->spin);
        double far = fmax(fabs(b->place.x), fmax(fabs(b->place.y), fabs(b->place.z)));
        if (!(speed2 + spin2 < 1e30)) {
            return blowup(r, i, "is NaN or faster than 1e15 m/s");
        }
        if (!(far < r->physics.parameters.domain)) {
            return blowup(r, i, "has escaped");
        }
        double allowed = OZ_BODY_STEP_SHARE * r->shape[i].radius;
        if (!(oz_body_step2(*b, r->shape[i], dt) < allowed * allowed)) {
            return blowup(r, i, "moves an end farther than half its radius");
        }
    }
    return OZ_OK;
}

OzStatus oz_reference_guard_check(const OzReference *reference, double dt)
{
    OzStatus status = OZ_OK;
    dialect = reference->physics.switches;
    OZ_TRY(check_contacts(reference));
    OZ_TRY(check_bodies(reference, dt));
done:
    return status;
}
