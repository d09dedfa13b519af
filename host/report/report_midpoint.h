/* What the force at the chord's midpoint (Poeschel and Buchholtz 1995) does to the energy, beside
 * the force at the overlap's centroid, which for kind i has a potential: the net work of a closed
 * loop, and the power that contacts inject into a pile that should come to rest. */
#pragma once

#include "cli.h"
#include "compute/device.h"
#include "scene/scene.h"

/* A corner is pressed into a face, turned, drawn out and turned back. *share receives the net work
 * that the contact does on it, over the most that it stored. */
OzStatus oz_report_midpoint_loop(double *share, OzForcePoint point);

/* A pile from its fall on. */
typedef struct OzMidpointPile {
    double peak;          /* J, of the kinetic energy, rotation included                         */
    double before, after; /* over that peak: means over the last half's first and second part    */
    double power;         /* W: what contacts inject, the ledger's residual over the last half    */
} OzMidpointPile;

/* Runs the scene (with a ledger) on the device. csv receives a row per sample: force point, time,
 * kinetic energy, energy that the ledger cannot account for; NULL: none. */
OzStatus oz_report_midpoint_pile(OzMidpointPile *pile, const OzScene *scene, const OzDevice *device,
                                 const char *source_dir, FILE *csv);

/* The study of one scene: prints both force points, and leaves folder/midpoint.csv. */
OzStatus oz_report_midpoint_study(const char *path, const char *folder, const OzOptions *options);
