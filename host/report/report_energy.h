/* Mechanical energy of rods. The snapshot's grains are the start. */
#pragma once

#include "model/snapshot.h"

/* Kinetic, rotational and potential energy, J: now, and at the start. */
double oz_report_energy_now(const OzSnapshot *now);
double oz_report_energy_start(const OzSnapshot *now);
