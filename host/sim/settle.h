/* Letting the grains of a simulation come to rest before time 0. */
#pragma once

#include "sim/relax.h"
#include "sim/sim.h"

/* As oz_relax_run; walls that will go later are all there meanwhile. */
OzStatus oz_settle_run(OzSim *sim, double *seconds, OzSettleWatch watch, void *context);

/* The same, and every interval, s, of a member's settling it is shown; its snapshots then have step
 * and time since its settling began. The bits do not depend on that. 0: nothing is shown. */
OzStatus oz_settle_show(OzSim *sim, double *seconds, OzSettleWatch watch, void *context,
                        OzSettleShow show, double interval);

/* Whether time 0 has come: there was nothing to settle, or it is done. */
bool oz_settle_is_over(const OzSim *sim);
