/* Phases of moving walls. */
#include "model/motion.h"
#include "scene/boundary.h"
#include "scene/trace.h"
#include "scene/wall_shape.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* An odd number of half periods turns a sine round, exactly. */
static double sign_of(const OzShake *shake)
{
    return fmod(shake->halves, 2) == 0 ? 1 : -1;
}

static const OzShake *shake_at(const OzMotion *motion, double time)
{
    bool is_before = time < motion->shake.since && motion->before.frequency > 0;
    return is_before ? &motion->before : &motion->shake;
}

/* The scene's numbers are those of the shake that it asks for. */
static double amplitude_of(const OzMotion *motion, const OzShake *shake)
{
    return shake == &motion->before ? shake->amplitude : motion->amplitude;
}

static double frequency_of(const OzMotion *motion, const OzShake *shake)
{
    return shake == &motion->before ? shake->frequency : motion->frequency;
}

static double steady_speed(const OzMotion *motion)
{
    const double *v = motion->velocity;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double end_of(const OzMotion *motion)
{
    return motion->until > 0 ? motion->until : INFINITY;
}

/* The time, or that of its start or its end where it stands still. */
static double time_under_way(const OzMotion *motion, double time)
{
    return fmin(fmax(time, motion->from), fmax(end_of(motion), motion->from));
}

static bool is_under_way(const OzMotion *motion, double time)
{
    return time >= motion->from && time < end_of(motion);
}

void oz_motion_offset(const OzMotion *motion, double time, double *offset, double *velocity)
{
    double way = time_under_way(motion, time);
    bool moves = is_under_way(motion, time);
    const OzShake *shake = shake_at(motion, way);
    if (motion->is_driven) {
        *offset = motion->driven[1] + motion->driven[2] * (time - motion->driven[0]);
        *velocity = motion->driven[2];
        return;
    }
    double amplitude = sign_of(shake) * amplitude_of(motion, shake);
    double rate = 2 * PI * frequency_of(motion, shake),
           phase = rate * (way - shake->since) + shake->phase;
    *offset = motion->present ? amplitude * sin(phase) - shake->base : 0;
    *velocity = motion->present && moves ? amplitude * rate * cos(phase) : 0;
    double speed = motion->present ? steady_speed(motion) : 0;
    double end = end_of(motion);
    if (motion->present && motion->trace) {
        oz_trace_at(motion->trace, fmin(time, end) - motion->from, offset, velocity);
        *velocity = time < end ? *velocity : 0;
    }
    if (speed > 0) {
        *offset = speed * (way - motion->from);
        *velocity = moves ? speed : 0;
    }
}

void oz_motion_drive(OzMotion *motion, double time, double speed)
{
    double offset, before;
    oz_motion_offset(motion, time, &offset, &before);
    motion->is_driven = true;
    motion->driven[0] = time;
    motion->driven[1] = offset;
    motion->driven[2] = speed;
}

/* Who is driven stays so. */
static void copy_drive(OzMotion *to, const OzMotion *from)
{
    to->is_driven = from->is_driven;
    memcpy(to->driven, from->driven, sizeof to->driven);
}

double oz_motion_reach(const OzMotion *motion)
{
    double shaken = motion->present ? motion->amplitude + fabs(motion->shake.base) : 0;
    return motion->present && motion->trace ? motion->trace->reach : shaken;
}

double oz_motion_speed(const OzMotion *motion)
{
    double shaken = 2 * PI * motion->frequency * motion->amplitude;
    shaken = motion->trace ? motion->trace->speed : shaken;
    return motion->present ? fmax(shaken, steady_speed(motion)) : 0;
}

void oz_motion_direction(const OzMotion *motion, double direction[3])
{
    const OzWall wall = {.motion = *motion};
    oz_wall_shape_shift(&wall, 1, direction);
}

bool oz_motion_is_free(const OzMotion *motion)
{
    double direction[3];
    oz_motion_direction(motion, direction);
    return motion->present && (direction[2] != 1 || motion->angular_velocity != 0);
}

double oz_motion_rate(const OzMotion *motion, double time)
{
    return motion->present && is_under_way(motion, time) ? motion->angular_velocity : 0;
}

double oz_motion_turn(const OzMotion *motion, double time)
{
    double since = time_under_way(motion, motion->turned_since);
    return motion->turned + motion->angular_velocity * (time_under_way(motion, time) - since);
}

/* The wall whose periods are taps; NULL: none. */
static const OzMotion *leader(const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzMotion *motion = &scene->walls[w].motion;
        if (motion->present && motion->frequency > 0) {
            return motion;
        }
    }
    return NULL;
}

double oz_motion_tap(const OzScene *scene, double time)
{
    const OzMotion *motion = leader(scene);
    if (!motion) {
        return scene->period > 0 ? time / scene->period : 0;
    }
    const OzShake *shake = shake_at(motion, time);
    return shake->taps + (time - shake->since) / (1 / frequency_of(motion, shake));
}

double oz_motion_time(const OzScene *scene, double tap)
{
    const OzMotion *motion = leader(scene);
    if (!motion) {
        return tap * scene->period;
    }
    bool is_before = tap < motion->shake.taps && motion->before.frequency > 0;
    const OzShake *shake = is_before ? &motion->before : &motion->shake;
    return shake->since + (tap - shake->taps) * (1 / frequency_of(motion, shake));
}

double oz_motion_since(const OzScene *scene)
{
    const OzMotion *motion = leader(scene);
    return motion ? motion->shake.since : 0;
}

/* The shake that is on at this time, with its own numbers. */
static OzShake running_shake(const OzMotion *motion, double time)
{
    const OzShake *shake = shake_at(motion, time);
    OzShake own = *shake;
    own.amplitude = amplitude_of(motion, shake);
    own.frequency = frequency_of(motion, shake);
    return own;
}

/* Half periods until the next zero crossing; a step that lies there to rounding lies there. */
static double halves_to_go(const OzShake *shake, double time)
{
    const double rounding = 1e-9;
    return ceil(2 * shake->frequency * (time - shake->since) + shake->phase / PI - rounding);
}

static void take_shake(OzMotion *next, const OzMotion *running, double time)
{
    if (next->amplitude == running->amplitude && next->frequency == running->frequency) {
        next->shake = running->shake;
        next->before = running->before;
        return;
    }
    next->before = running_shake(running, time);
    next->shake.since = time;
    if (next->before.frequency > 0) {
        double halves = halves_to_go(&next->before, time_under_way(running, time));
        double left = halves - next->before.phase / PI;
        next->shake.since = next->before.since + left / (2 * next->before.frequency);
        next->shake.halves = next->before.halves + halves;
        next->shake.taps = next->before.taps + left / 2;
        next->shake.base = next->before.base;
        next->shake.phase = 0;
    }
}

static void take_turn(OzMotion *next, const OzMotion *running, double time)
{
    bool same = next->angular_velocity == running->angular_velocity;
    next->turned = same ? running->turned : oz_motion_turn(running, time);
    next->turned_since = same ? running->turned_since : time;
}

/* Times that were written as taps. */
static void derive_times(OzScene *scene)
{
    OzSnapshotSettings *shots = &scene->snapshots;
    if (scene->taps > 0) {
        scene->duration = oz_motion_time(scene, scene->taps);
    }
    for (int i = 0; shots->tap_count > 0 && i < shots->count; i++) {
        shots->times[i] = oz_motion_time(scene, shots->taps[i]);
    }
    for (int i = 0; scene->checkpoint.tap_count > 0 && i < scene->checkpoint.count; i++) {
        scene->checkpoint.times[i] = oz_motion_time(scene, scene->checkpoint.taps[i]);
    }
}

void oz_motion_take_over(OzScene *next, const OzScene *running, double time)
{
    for (int w = 0; w < next->wall_count && w < running->wall_count; w++) {
        OzMotion *motion = &next->walls[w].motion;
        if (motion->present && running->walls[w].motion.present) {
            take_shake(motion, &running->walls[w].motion, time);
            take_turn(motion, &running->walls[w].motion, time);
            copy_drive(motion, &running->walls[w].motion);
        }
    }
    oz_boundary_take_over(&next->boundary, &running->boundary, time);
    derive_times(next);
}

void oz_motion_copy(OzScene *scene, const OzScene *from)
{
    for (int w = 0; w < scene->wall_count && w < from->wall_count; w++) {
        OzMotion *to = &scene->walls[w].motion;
        const OzMotion *motion = &from->walls[w].motion;
        to->shake = motion->shake;
        to->before = motion->before;
        to->turned = motion->turned;
        to->turned_since = motion->turned_since;
        copy_drive(to, motion);
    }
    scene->boundary.strain = from->boundary.strain;
    scene->boundary.since = from->boundary.since;
    derive_times(scene);
}

static OzStatus shake_state(OzShake *shake, OzStateVisit *visit, const char *name)
{
    OZ_PASS(oz_state_enter(visit, name, 1));
    OZ_PASS(oz_state_double(visit, "since", "s", &shake->since, 1));
    OZ_PASS(oz_state_double(visit, "halves", "half periods", &shake->halves, 1));
    OZ_PASS(oz_state_double(visit, "phase", "rad", &shake->phase, 1));
    OZ_PASS(oz_state_double(visit, "base", "m", &shake->base, 1));
    OZ_PASS(oz_state_double(visit, "taps", "periods", &shake->taps, 1));
    OZ_PASS(oz_state_double(visit, "amplitude", "m", &shake->amplitude, 1));
    OZ_PASS(oz_state_double(visit, "frequency", "Hz", &shake->frequency, 1));
    oz_state_leave(visit);
    return OZ_OK;
}

OzStatus oz_motion_state(OzScene *scene, OzStateVisit *visit)
{
    for (int w = 0; w < scene->wall_count; w++) {
        OzMotion *motion = &scene->walls[w].motion;
        oz_state_enter_one(visit, "wall", w);
        OZ_PASS(shake_state(&motion->shake, visit, "shake"));
        OZ_PASS(shake_state(&motion->before, visit, "before"));
        OZ_PASS(oz_state_double(visit, "turned", "rad", &motion->turned, 1));
        OZ_PASS(oz_state_double(visit, "turned_since", "s", &motion->turned_since, 1));
        OZ_PASS(oz_state_bool(visit, "is_driven", &motion->is_driven));
        OZ_PASS(oz_state_double(visit, "driven", "s, m, m/s", motion->driven, 3));
        oz_state_leave(visit);
    }
    if (scene->boundary.present) {
        OZ_PASS(oz_state_double(visit, "strain", "none", &scene->boundary.strain, 1));
        OZ_PASS(oz_state_double(visit, "strain_since", "s", &scene->boundary.since, 1));
    }
    if (visit->is_loading) {
        derive_times(scene);
    }
    return OZ_OK;
}

OzStatus oz_motion_trace_state(const OzScene *scene, OzStateVisit *visit)
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzMotion *motion = &scene->walls[w].motion;
        int64_t own = motion->trace ? motion->trace->digest : 0, saved = own;
        oz_state_enter_one(visit, "wall", w);
        OZ_PASS(oz_state_index(visit, "trace", &saved, 0, INT64_MAX));
        oz_state_leave(visit);
        if (saved != own) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: walls.%d.motion.file holds another trace than the run was "
                                  "begun with; expected the same numbers, or another run",
                                  scene->path, w);
        }
    }
    return OZ_OK;
}
