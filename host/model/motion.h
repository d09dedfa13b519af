/* Where a moving wall is at a time, and how a motion of other numbers takes over from a running
 * one: a shaken wall changes at its next zero crossing, a turning one at once; neither ever jumps.
 * A motion as loaded has phase 0 at time 0. */
#pragma once

#include "base/state.h"
#include "scene/scene.h"

#include <stdbool.h>

/* Offset (m, upwards) and velocity (m/s) at a time, s. */
void oz_motion_offset(const OzMotion *motion, double time, double *offset, double *velocity);

/* From this time on it goes at this speed from where it is, m/s along its direction, instead. */
void oz_motion_drive(OzMotion *motion, double time, double speed);

/* Its greatest offset from where it was built, m; 0 of one that goes on. */
double oz_motion_reach(const OzMotion *motion);

/* Its greatest speed without its turning, m/s. */
double oz_motion_speed(const OzMotion *motion);

/* The unit vector along which it is shaken, or goes on. */
void oz_motion_direction(const OzMotion *motion, double direction[3]);

/* Whether it is anything else than up and down. */
bool oz_motion_is_free(const OzMotion *motion);

/* rad/s about its axis at a time; 0 of a wall at rest. */
double oz_motion_rate(const OzMotion *motion, double time);

/* Angle, rad, by which the wall has turned about its point. */
double oz_motion_turn(const OzMotion *motion, double time);

/* The tap of a time: periods of the first moving wall since time 0, a real number that counts true
 * periods across changes of its frequency; 0 without one. And the time of a tap, s. */
double oz_motion_tap(const OzScene *scene, double time);
double oz_motion_time(const OzScene *scene, double tap);

/* The time from which taps go by scene->period, s: of the last change, perhaps still to come. */
double oz_motion_since(const OzScene *scene);

/* Lets the motions of `next` (walls', and a cell's shear), as loaded, go on from those of the scene
 * that runs at this time, the same walls moving in both: a wall whose amplitude or frequency
 * differs moves as before until its next zero crossing, phases are continuous, and what next says
 * in taps lies where these taps will be (duration, snapshots). */
void oz_motion_take_over(OzScene *next, const OzScene *running, double time);

/* Gives the walls of a scene the phases that the same walls have in another one, and what follows
 * from them. */
void oz_motion_copy(OzScene *scene, const OzScene *from);

/* Saves or loads (base/state.h) the phases of all walls, a cell's strain, and what follows from
 * them. */
OzStatus oz_motion_state(OzScene *scene, OzStateVisit *visit);

/* Saves which traces walls follow, or refuses a scene whose files hold others now. */
OzStatus oz_motion_trace_state(const OzScene *scene, OzStateVisit *visit);
