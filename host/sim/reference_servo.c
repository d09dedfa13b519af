/* Pistons of the reference: as kernels/servo.h. */
#include "sim/reference_servo.h"

static int count_of(const OzReference *r)
{
    return r->physics.switches.servos;
}

static const OzServoConstants *constants_of(const OzReference *r, int s)
{
    return &r->physics.parameters.servo[s];
}

static bool is_gone(const OzReference *r, int s)
{
    int wall = (int)constants_of(r, s)->wall;
    return r->physics.switches.gated && r->physics.parameters.wall[wall].shape.gone != 0;
}

void oz_reference_servo_before(OzReference *r, double dt)
{
    OZ_USE_SWITCHES(oz_host_switches_rods(&r->physics.switches));
    for (int s = 0; s < count_of(r); s++) {
        OzWallDrive *drive = &r->wall_drive[(int)constants_of(r, s)->wall];
        if (OZ_MOVES_BEFORE && !is_gone(r, s)) {
            oz_servo_before(&r->servo[s], dt);
        }
        drive->offset = r->servo[s].place;
        drive->speed = r->servo[s].seen;
    }
}

/* N, of all grains on kernel wall w, along its normal. */
static double push_on(const OzReference *r, int w)
{
    OzVec3 normal = oz_dialect_load3(r->physics.parameters.wall[w].direction);
    int64_t touches = r->physics.touches;
    double sum = 0;
    for (int64_t k = 0; k < r->count * touches; k++) {
        int wall, part = oz_dialect_part(&r->physics, (int)(k % touches), &wall);
        (void)part;
        sum -= wall == w ? oz_dot(r->wall_force[k].parts.force, normal) : 0;
    }
    return sum;
}

void oz_reference_servo_after(OzReference *r, double dt)
{
    OZ_USE_SWITCHES(oz_host_switches_rods(&r->physics.switches));
    double places[OZ_SERVOS_MAX];
    for (int s = 0; s < count_of(r); s++) {
        places[s] = r->servo[s].place;
    }
    for (int s = 0; s < count_of(r); s++) {
        OzServoConstants servo = *constants_of(r, s);
        double drive = oz_servo_drive(servo, places);
        r->servo[s].push = push_on(r, (int)servo.wall);
        if (is_gone(r, s)) {
            oz_servo_stand(&r->servo[s], servo, drive);
        } else {
            OzServoWork work = oz_servo_after(&r->servo[s], servo, drive, dt);
            r->work.walls += work.given;
            r->work.dissipated += work.lost;
        }
    }
}

bool oz_reference_servo_speed(const OzReference *r, int wall, double *speed)
{
    bool is_servo = false;
    for (int s = 0; s < count_of(r); s++) {
        if ((int)constants_of(r, s)->wall == wall) {
            is_servo = true;
            *speed = r->servo[s].speed;
        }
    }
    return is_servo;
}

void oz_reference_servo_write(const OzReference *r, OzSnapshot *snapshot)
{
    for (int s = 0; s < count_of(r); s++) {
        int wall = r->physics.wall_order[(int)constants_of(r, s)->wall];
        snapshot->wall_offset[wall] = r->servo[s].place;
        snapshot->wall_velocity[wall] = r->servo[s].speed;
        snapshot->wall_push[wall] = r->servo[s].push;
    }
}
