/* What contacts did in a step, as kernels/ledger.h has it. */
#include "sim/reference_ledger.h"

#include "sim/gates.h"
#include "sim/reference_servo.h"
#include "sim/swings.h"

static void note_rolling(OzReference *r, OzContact contact, OzContactForce parts, OzVec3 after,
                         double dt)
{
    if (OZ_ROLLING) {
        OzVec3 mean = oz_scale(oz_add(contact.turning, after), 0.5);
        r->work.spring -= dt * oz_dot(parts.couple.spring, mean);
        r->work.dissipated -= dt * oz_dot(parts.couple.dashpot, mean);
    }
}

static void note_pairs(OzReference *r, double dt)
{
    OzSpace space = oz_reference_space(r);
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        const OzPairForce *f = &r->pair_force[p];
        if (f->contact.touching) {
            OzGrain a = oz_reference_now(r, r->near.pairs.pair[p].a),
                    b = oz_reference_now(r, r->near.pairs.pair[p].b);
            OzVec3 apart = oz_space_minus(a.position, b.position, space);
            b.velocity = oz_rods_beside(b.velocity, apart, space);
            OzVec3 after =
                oz_minus(oz_grain_velocity_at(b, f->arm_b), oz_grain_velocity_at(a, f->arm_a));
            oz_ledger_note(&r->work, f->contact, f->parts, after, dt);
            if (OZ_LINE) {
                oz_ledger_note_couple(&r->work, f->couple, f->turning, oz_minus(b.rate, a.rate),
                                      dt);
            }
            note_rolling(r, f->contact, f->parts, oz_minus(b.rate, a.rate), dt);
        }
    }
}

/* As kernels/ledger.h. */
static void note_gate(OzReference *r, int wall, const OzWallForce *f, OzVec3 after, double dt)
{
    int64_t step = r->step + (OZ_MOVES_BEFORE && dt > 0);
    double times[3];
    for (int k = 0; k < 3; k++) {
        times[k] = oz_step_clock_time(&r->clock, dt > 0 ? step + k - 1 : step);
    }
    int gate = oz_gates_bits(&r->scene->walls[r->physics.wall_order[wall]], times, false);
    OzVec3 force = oz_minus(f->parts.force, oz_add(f->parts.spring, f->parts.dashpot));
    OzVec3 mean = oz_scale(oz_add(f->contact.velocity, after), 0.5);
    double given = oz_dot(force, mean) * dt * (OZ_MOVES_BEFORE ? 0.5 : 1);
    r->work.walls += gate & OZ_GATE_COMES ? f->parts.energy : 0;
    r->work.walls -= gate & OZ_GATE_GOES ? f->parts.energy - given : 0;
}

static void note_wall(OzReference *r, int i, int index, double dt)
{
    const OzWallForce *f = &r->wall_force[(int64_t)i * r->physics.touches + index];
    int wall, part = oz_dialect_part(&r->physics, index, &wall);
    (void)part;
    if (f->contact.touching) {
        OzGrain now = oz_reference_now(r, i);
        OzWallDrive drive = oz_swings_drive_at(&r->physics, r->scene, wall,
                                               oz_step_clock_time(&r->clock, r->step) + dt);
        bool is_servo = oz_reference_servo_speed(r, wall, &drive.speed);
        OzVec3 before =
            oz_dialect_wall_velocity(&r->physics, wall, now.position, f->arm, r->wall_drive[wall]);
        OzVec3 after = oz_dialect_wall_velocity(&r->physics, wall, now.position, f->arm, drive);
        OzVec3 left = oz_minus(oz_grain_velocity_at(now, f->arm), after);
        oz_ledger_note(&r->work, f->contact, f->parts, left, dt);
        note_gate(r, wall, f, left, dt);
        if (!is_servo) { /* a piston's work on grains stays within what the ledger is of */
            oz_ledger_push(&r->work, f->parts.force, oz_scale(oz_add(before, after), 0.5), dt);
        }
        OzVec3 turning = oz_scale(drive.axis, drive.rate);
        note_rolling(r, f->contact, f->parts, oz_minus(now.rate, turning), dt);
        if (OZ_ROLLING) {
            OzVec3 couple = oz_add(f->parts.couple.spring, f->parts.couple.dashpot);
            oz_ledger_push(&r->work, couple, turning, dt);
        }
    }
}

void oz_reference_ledger_note(OzReference *r, double dt)
{
    note_pairs(r, dt);
    for (int i = 0; i < r->count; i++) {
        for (int index = 0; index < r->physics.touches; index++) {
            note_wall(r, i, index, dt);
        }
    }
}
