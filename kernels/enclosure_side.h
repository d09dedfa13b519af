/* A wall, and what of every grain may touch it, as a step's forces see them: where they stand and
 * how the wall moves. OpenCL C only. */
#pragma once

#include "kernels/grains.h"
#include "kernels/wall_drive.h"
#include "kernels/wall_swing.h"

#if OZ_WALL_COUNT > 0

/* The forces of a step see the walls where they stand at the beginning of this step: the next one
 * where the integrator moves grains before the forces. */
#if OZ_MOVES_BEFORE
#define OZ_ENCLOSURE_STEP(step) ((step) + 1)
#else
#define OZ_ENCLOSURE_STEP(step) (step)
#endif

/* The first end at a wall with edges, and the first point of a shaft. */
#define OZ_ENCLOSURE_SHAFT ((OZ_ROUND ? 1 : 2) * OZ_WALL_COUNT)
#define OZ_ENCLOSURE_EDGED (OZ_ENCLOSURE_SHAFT - (OZ_ROUND ? 1 : 2) * OZ_WALL_EDGED)

/* The first slot of touches of meshes, behind all points of shafts. */
#define OZ_ENCLOSURE_MESH (OZ_WALL_ENDS - OZ_MESH_SLOTS * OZ_MESHES)

OZ_INLINE OzWallNumbers oz_enclosure_side_numbers(void)
{
    OzWallNumbers numbers = {OZ_ROUND ? 1 : 2, OZ_WALL_COUNT, OZ_MESHES, OZ_WALL_EDGED};
    return numbers;
}

/* One of the two ends of every grain, or a point of its shaft, paired with one wall: what is the
 * same for all grains in a step. */
typedef struct OzSide {
    int wall;
    real sign; /* of the half-shaft that leads to the end: 1 or -1 */
    int index; /* among all ends and points at all walls           */
    int part;  /* OZ_WALL_TIP ...                                  */
    int first; /* the first end: a sphere has no other             */
    OzWallShape shape;
    fixed_position_kind point[3]; /* the shape's                             */
    scalar unit;
    scalar offset, speed;   /* m, m/s of the wall along its direction: z without OZ_FREE_MOTION */
    scalar rise, rise_rest; /* units: the offset with all its digits   */
    scalar rate;            /* rad/s                                   */
    int gate;               /* OZ_GATE_ bits; with OZ_MOVING only      */
#if OZ_SWUNG
    OzWallSwing swing;
#endif
#if OZ_SERVOS > 0
    int servo;      /* its number among servo walls; -1: it is none          */
    scalar rest[3]; /* units: what point has not of where the piston stands  */
#endif
} OzSide;

#if OZ_SWUNG
/* Turns a side with its wall. */
OZ_INLINE void oz_enclosure_side_swing(const OzWork *w, OzSide *side, int step)
{
    size_t at = (size_t)OZ_ENCLOSURE_STEP(step) * OZ_WALL_COUNT + side->wall;
    global const scalar *words = w->swing + OZ_SWING * at;
    for (int k = 0; k < 9; k++) {
        side->swing.frame[k] = words[OZ_W_FRAME + k];
    }
    for (int c = 0; c < 3; c++) {
        side->swing.away[c] = words[OZ_W_AWAY + c];
        side->swing.lead[c] = words[OZ_W_LEAD + c];
        side->swing.home[c] = words[OZ_W_HOME + c];
    }
    oz_wall_swing_turn(side->swing.frame, side->shape.normal);
    oz_wall_swing_turn(side->swing.frame, side->shape.across);
}
#endif

#if OZ_SERVOS > 0
/* The number of a wall among servos; -1: it is none. */
OZ_INLINE int oz_enclosure_servo(const OzWork *w, int wall)
{
    int servo = -1;
    for (int s = 0; s < OZ_SERVOS; s++) {
        servo = (int)w->parameters->servo[s].wall == wall ? s : servo;
    }
    return servo;
}

/* Puts the point of a servo wall where the piston stands, in whole units and the rest. */
OZ_INLINE void oz_enclosure_side_serve(const OzWork *w, OzSide *side)
{
    side->servo = oz_enclosure_servo(w, side->wall);
    side->rest[0] = side->rest[1] = side->rest[2] = 0;
    if (!OZ_MOVING) {
        side->rate = 0;
        side->gate = 0;
    }
    if (side->servo < 0) {
        return;
    }
    global const double *words = w->servo + side->servo * OZ_SERVO;
    global const scalar *direction = w->parameters->wall[side->wall].direction;
    side->speed = (scalar)words[OZ_SERVO_SEEN];
    for (int c = 0; c < 3; c++) {
        double way = words[OZ_SERVO_PLACE] * (double)direction[c] * (double)(1 / side->unit);
#if defined(OZ_DOUBLE)
        side->point[c] += way;
#else
        double whole = rint(way);
        side->point[c] += convert_int(whole);
        side->rest[c] = (scalar)(way - whole);
#endif
    }
}
#endif

OZ_INLINE OzSide oz_enclosure_side_of(const OzWork *w, int index, int step)
{
    OzSide side;
    side.index = index;
    side.wall = oz_wall_shaft_wall(index, oz_enclosure_side_numbers());
    side.part = oz_wall_shaft_part(index, oz_enclosure_side_numbers());
    side.first = side.part == OZ_WALL_TIP;
    side.sign = REAL(side.first ? 1.0 : -1.0);
    side.shape = w->parameters->wall[side.wall].shape;
    side.shape.kind = oz_wall_kind(side.wall);
    for (int c = 0; c < 3; c++) {
        side.point[c] = (fixed_position_kind)side.shape.point[c];
    }
    side.unit = w->parameters->length_unit;
    side.offset = side.speed = side.rise = side.rise_rest = 0;
    if (OZ_MOVING) {
        size_t at = (size_t)OZ_ENCLOSURE_STEP(step) * OZ_WALL_COUNT + side.wall;
        side.offset = w->motion[OZ_MOTION * at];
        side.speed = w->motion[OZ_MOTION * at + OZ_M_SPEED];
        side.rise = w->motion[OZ_MOTION * at + OZ_M_RISE];
        side.rise_rest = w->motion[OZ_MOTION * at + OZ_M_RISE_REST];
        side.rate = w->motion[OZ_MOTION * at + OZ_M_RATE];
        side.gate = OZ_GATED ? (int)w->motion[OZ_MOTION * at + OZ_M_GATE] : 0;
        side.shape.gone = side.gate & OZ_GATE_GONE;
    }
#if OZ_SWUNG
    oz_enclosure_side_swing(w, &side, step);
#endif
#if OZ_SERVOS > 0
    oz_enclosure_side_serve(w, &side);
#endif
    return side;
}

/* What a picked end or point remembers of its contact with the side. */
OZ_INLINE OzMemory oz_enclosure_side_memory(const OzWork *w, const OzSide *side, const int *slots)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzMemory memory = {none, none};
    if (OZ_HISTORY) {
        memory.stretch = oz_work_fetch3(w->wall_history, slots, 3 * OZ_WALL_ENDS, 3 * side->index);
    }
    if (OZ_ROLLING_SPRING) {
        memory.turned = oz_work_fetch3(w->wall_rolling, slots, 3 * OZ_WALL_ENDS, 3 * side->index);
    }
    return memory;
}

OZ_INLINE void oz_enclosure_side_remember(OzWork *w, int index, const int *slots, OzMemory memory)
{
    if (OZ_HISTORY) {
        oz_work_put3(w->wall_history, slots, 3 * OZ_WALL_ENDS, 3 * index, memory.stretch);
    }
    if (OZ_ROLLING_SPRING) {
        oz_work_put3(w->wall_rolling, slots, 3 * OZ_WALL_ENDS, 3 * index, memory.turned);
    }
}

/* How the side's wall moves. */
OZ_INLINE OzWallDrive oz_enclosure_side_drive(const OzWork *w, const OzSide *side)
{
    OzWallDrive drive;
    const OzWallParameters wall = w->parameters->wall[side->wall];
    drive.direction =
        oz_vec3(REAL(wall.direction[0]), REAL(wall.direction[1]), REAL(wall.direction[2]));
    drive.axis = oz_vec3(REAL(wall.axis[0]), REAL(wall.axis[1]), REAL(wall.axis[2]));
    drive.offset = REAL(side->offset);
    drive.speed = REAL(side->speed);
    drive.rate = REAL(side->rate);
#if OZ_SWUNG
    const OzWallSwing swing = side->swing;
    drive.away = oz_vec3(REAL(swing.away[0]), REAL(swing.away[1]), REAL(swing.away[2]));
    drive.lead = oz_vec3(REAL(swing.lead[0]), REAL(swing.lead[1]), REAL(swing.lead[2]));
#endif
    return drive;
}

/* A place on a grain, `end` from its centre, seen from the wall's point, where that is now. */
OZ_INLINE OzVec3 oz_enclosure_side_from(const OzWork *w, OzFixedPosition position_, OzVec3 end,
                                        const OzSide *side)
{
    scalar unit = side->unit;
    OzVec3 from = oz_vec3(oz_fixed_position_to_real(position_.x - side->point[0]) * unit + end.x,
                          oz_fixed_position_to_real(position_.y - side->point[1]) * unit + end.y,
                          oz_fixed_position_to_real(position_.z - side->point[2]) * unit + end.z -
                              (OZ_FREE_MOTION ? 0 : side->offset));
    if (OZ_FREE_MOTION) {
        OzWallDrive drive = oz_enclosure_side_drive(w, side);
        from = oz_along(from, -drive.offset, drive.direction);
    }
#if OZ_SWUNG
    from = oz_minus(from, oz_enclosure_side_drive(w, side).away);
#endif
#if OZ_SERVOS > 0
    from = oz_along(from, REAL(-unit),
                    oz_vec3(REAL(side->rest[0]), REAL(side->rest[1]), REAL(side->rest[2])));
#endif
    return from;
}

OZ_INLINE OzWallDistance oz_enclosure_side_distance(const OzWork *w, OzFixedPosition position_,
                                                    OzVec3 end, const OzSide *side)
{
    return oz_wall_distance(oz_enclosure_side_from(w, position_, end, side), side->shape);
}

/* The wall's velocity where it touches a grain, arm from the grain's centre. */
OZ_INLINE OzVec3 oz_enclosure_side_velocity(const OzWork *w, OzFixedPosition position_, OzVec3 arm,
                                            const OzSide *side)
{
    if (!OZ_FREE_MOTION) {
        return oz_vec3(REAL(0.0), REAL(0.0), REAL(side->speed));
    }
    return oz_wall_drive_velocity(oz_enclosure_side_drive(w, side),
                                  oz_enclosure_side_from(w, position_, arm, side));
}

/* How fast it turns. */
OZ_INLINE OzVec3 oz_enclosure_side_turning(const OzWork *w, const OzSide *side)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    if (!OZ_FREE_MOTION) {
        return none;
    }
    OzWallDrive drive = oz_enclosure_side_drive(w, side);
    return oz_scale(drive.axis, drive.rate);
}

#if OZ_FINE
/* The overlap of ends and a wall. */
OZ_INLINE real oz_enclosure_side_fine(const OzWork *w, OzGrain grain, const OzSide *side)
{
    real unit = grain.radius / grain.fine.radius;
    OzFixedPosition from = grain.position; /* of every lane the same */
    from.x = side->point[0];
    from.y = side->point[1];
    from.z = side->point[2];
    OzFine rise = {REAL(side->rise), REAL(side->rise_rest)};
    OzFineVec3 end = oz_fine_end(grain.fine, side->sign, from);
#if OZ_SERVOS > 0
    end.x.low -= REAL(side->rest[0]);
    end.y.low -= REAL(side->rest[1]);
    end.z.low -= REAL(side->rest[2]);
#endif
    return unit *
           oz_wall_overlap(end, side->shape, rise, grain.fine.radius, w->parameters->inverse_unit);
}
#endif

#endif
