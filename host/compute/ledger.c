/* Work of contacts. */
#include "compute/ledger.h"

void oz_ledger_note(OzWork *work, OzContact contact, OzContactForce parts, OzVec3 after, double dt)
{
    OzVec3 force = parts.force, n = contact.normal;
    OzVec3 dashpot = oz_along(parts.dashpot_tangential, parts.dashpot, n);
    OzVec3 tangential = oz_along(force, -oz_dot(force, n), n);
    OzVec3 spring = oz_minus(tangential, parts.dashpot_tangential);
    OzVec3 mean = oz_scale(oz_add(contact.velocity, after), 0.5);
    work->spring -= dt * oz_dot(spring, mean);
    work->dissipated -= dt * oz_dot(dashpot, mean);
}

void oz_ledger_push(OzWork *work, OzVec3 force, double mean_speed, double dt)
{
    work->walls += dt * force.z * mean_speed;
}
