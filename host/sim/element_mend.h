/* What the host does when beams have broken on the device. */
#pragma once

#include "sim/sim.h"

/* A member that stopped because beams broke, and for no other reason, goes on: triangles that
 * nothing joins any more are of different grains from now on. */
OzStatus oz_element_mend_member(OzSim *sim, int member);

/* Before a launch: outer edges are those of what is left of grains, which no state has. */
OzStatus oz_element_mend_outline(OzSim *sim, int member);

/* What breaks from now on is what is lost. */
OzStatus oz_element_mend_start_ledger(OzSim *sim, int member);
