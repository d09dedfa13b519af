/* Grains between the host's arrays by id and the device's words by slot and lane. */
#pragma once

#include "model/snapshot.h"
#include "sim/rods_fields.h"

/* Writes the start of a member: state, shapes, records, ids. Padding repeats the first grain, at
 * rest; the record after the last one is far away and serves unused pairs. */
OzStatus oz_pack_start(OzArrays *arrays, int member, const OzParameters *parameters,
                       const OzGrains *grains);

/* Writes the parameters in the device's precision. */
OzStatus oz_pack_parameters(OzArrays *arrays, int member, const OzParameters *parameters);

/* Reads a member's state into snapshot: position, quaternion, axis, velocity, spin. */
OzStatus oz_pack_state(const OzArrays *arrays, int member, const OzParameters *parameters,
                       OzSnapshot *snapshot);

/* Where word `word` of a slot lies, in scalars, in an array of blocks of `words` words. */
size_t oz_pack_lane(const OzSwitches *switches, int64_t slot, int words, int word);
