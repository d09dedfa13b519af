/* Work of contacts. */
#include "sim/ledger.h"

void oz_ledger_note(OzWork *work, OzContact contact, OzContactForce parts, OzVec3 after, double dt)
{
    OzVec3 mean = oz_scale(oz_add(contact.velocity, after), 0.5);
    work->spring -= dt * oz_dot(parts.spring, mean);
    work->dissipated -= dt * oz_dot(parts.dashpot, mean);
}

void oz_ledger_note_couple(OzWork *work, OzVec3 couple, OzVec3 turning, OzVec3 after, double dt)
{
    work->dissipated -= dt * oz_dot(couple, oz_scale(oz_add(turning, after), 0.5));
}

void oz_ledger_push(OzWork *work, OzVec3 force, OzVec3 velocity, double dt)
{
    work->walls += dt * oz_dot(force, velocity);
}
