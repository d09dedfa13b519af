/* What the experiments of `orzo report --validate` see of a state; each says what it leaves. */
#pragma once

#include "report/report_trial.h"

/* A ball that starts from rest, at the last look. */
enum {
    OZ_LOOK_BALL_SPEED,  /* over g_x t                                                      */
    OZ_LOOK_BALL_SLIP,   /* the share of it that the touching point has                     */
    OZ_LOOK_BALL_INCLINE /* tan(theta) over the coefficient of friction                     */
};
void oz_report_validate_looks_ball(OzTrialNumbers numbers, const OzSnapshot *now, int look);

/* A hit of two grains, or of one and the plane z = 0, that begins at time 0. */
enum {
    OZ_LOOK_HIT_OVERLAP,     /* m, the greatest                                            */
    OZ_LOOK_HIT_DURATION,    /* s, until they part, between looks along a straight line    */
    OZ_LOOK_HIT_RESTITUTION, /* speed of grain 0 along the normal over that at the start   */
    OZ_LOOK_HIT_TANGENTIAL,  /* the same along the plane (x)                               */
    OZ_LOOK_HIT_SPIN,        /* rad/s, about y, without sign                               */
    OZ_LOOK_HIT_ASKED,       /* the scene's restitution                                    */
    OZ_LOOK_HIT_BEFORE       /* on the way: m, the overlap at the last look                */
};
void oz_report_validate_looks_hit(OzTrialNumbers numbers, const OzSnapshot *now, int look);

/* What a silo's floor (walls.0) carries, in the mean over the later half of the looks. */
enum {
    OZ_LOOK_SILO_FLOOR, /* N, sum over those looks                                        */
    OZ_LOOK_SILO_LOOKS, /* their number                                                   */
    OZ_LOOK_SILO_COLUMN /* N, the weight of a height D / (4 mu) of the bed, mu the wall's friction:
                           what the floor carries in a deep one at K = 1                  */
};
void oz_report_validate_looks_silo(OzTrialNumbers numbers, const OzSnapshot *now, int look);

/* Haff's law: 1/sqrt(T), T = <v^2>/3, grows as a straight line in time; and its slope by kinetic
 * theory, of the box walls.0, whose sides are equal. From the look on when hits have made the
 * velocities random, three tenths of all. */
enum {
    OZ_LOOK_GAS_COUNT,
    OZ_LOOK_GAS_TIME,    /* sums over looks: s,                                            */
    OZ_LOOK_GAS_TIME2,   /* s^2,                                                           */
    OZ_LOOK_GAS_SLOW,    /* s/m, 1/sqrt(T)                                                 */
    OZ_LOOK_GAS_PRODUCT, /* time times it,                                                 */
    OZ_LOOK_GAS_THEORY   /* 1/m: (2 sqrt(pi)/3) (1 - e^2) n d^2 g                          */
};
void oz_report_validate_looks_gas(OzTrialNumbers numbers, const OzSnapshot *now, int look);

/* The slope of a bed in a drum, walls.0, that turns about y: the direction from its axis to the
 * centre of mass against gravity, in the mean over the later half of the looks. */
enum { OZ_LOOK_DRUM_SLOPE /* degrees, sum over those looks */, OZ_LOOK_DRUM_LOOKS };
void oz_report_validate_looks_drum(OzTrialNumbers numbers, const OzSnapshot *now, int look);

/* Spheres that flow out of the tube walls.1 through the cone walls.0 below it: the rate while 15 to
 * 45 % of them flow out, and the bed's density before, five diameters of it, two above the tube's
 * lower end. */
enum {
    OZ_LOOK_HOPPER_DENSITY, /* kg/m^3                                                       */
    OZ_LOOK_HOPPER_FROM,    /* s, the first look when 15 % have flowed out                  */
    OZ_LOOK_HOPPER_BEFORE,  /* kg, what had then                                            */
    OZ_LOOK_HOPPER_TO,      /* s, the last look at which 45 % had not                       */
    OZ_LOOK_HOPPER_AFTER,   /* kg, what had then                                            */
    OZ_LOOK_HOPPER_FREE     /* m, D - 1.4 d of the hole                                     */
};
void oz_report_validate_looks_hopper(OzTrialNumbers numbers, const OzSnapshot *now, int look);

/* What is left of a bed on a level tray, the disc walls.0: how its surface falls off, of the highest
 * spheres over points that lie evenly between 0.4 and 0.9 of the tray's radius. */
enum { OZ_LOOK_HEAP_SLOPE /* degrees, at the last look */ };
void oz_report_validate_looks_heap(OzTrialNumbers numbers, const OzSnapshot *now, int look);
