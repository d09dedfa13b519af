/* The state of a simulation: what its driver, its model and its device's arrays hold of it. */
#pragma once

#include "base/state.h"
#include "sim/sim.h"

/* Saves or loads (base/state.h), between launches, all that later steps depend on: each array of
 * the device whose class is STATE or SPRING, as it is in the device's memory and units. The
 * simulation that loads was made of the same scenes for a device of the same kind; switches or
 * sizes that differ are refused by name. Neighbour lists are left out: both the saved and the
 * loaded simulation make them anew, which changes no bit of what follows. */
OzStatus oz_sim_state_visit(OzSim *sim, OzStateVisit *visit);

/* Gives `to`, made of other scenes of the same grains and members, in the units of `from`, the
 * state that `from` has between launches: what arrays of both hold, tangential springs too; what
 * the other program lacks begins anew. Lists are made again later (oz_sim_state_renew). With the
 * same switches, no bit of what follows changes. */
OzStatus oz_sim_state_move(OzSim *to, OzSim *from);

/* Puts springs where they outlive the lists, which are then to be made again; and makes them. */
OzStatus oz_sim_state_save_springs(OzSim *sim);
OzStatus oz_sim_state_renew(OzSim *sim);
