/* Elements between the host's arrays by id and the device's words by slot and lane. */
#pragma once

#include "model/snapshot.h"
#include "sim/element_fields.h"

/* Derivatives of the free elements' coordinates at the start: acceleration, third and fourth, each
 * 3 x free_count (x, y, angle). */
typedef struct OzElementStart {
    double *acceleration, *third, *fourth;
    double *touch;         /* 3 x free_count: N, N, N m of contacts, where beams go in substeps; the
                              acceleration is then that of beams and gravity alone                */
    OzElementLedger power; /* W: how fast each entry of the ledger grows */
} OzElementStart;

/* Writes what never changes: shapes, bodies, beams; and the start. Counts in the parameters' units.
 */
OzStatus oz_element_pack_start(OzArrays *arrays, int member, const OzElementParameters *parameters,
                               const OzGrains *grains, const OzElementStart *start);

OzStatus oz_element_pack_parameters(OzArrays *arrays, int member,
                                    const OzElementParameters *parameters);

/* Writes the body of every slot; -1 where there is no element and for those of walls that are not
 * present (a bit of present for each wall), which are in no list then. */
OzStatus oz_element_pack_bodies(OzArrays *arrays, int member, const OzGrains *grains,
                                unsigned present);

/* Writes which edges are outer ones, for contacts with a potential. */
OzStatus oz_element_pack_outer_edges(OzArrays *arrays, int member, const OzElements *elements);

/* Writes the state that other arrays of the same elements hold, for steps `ratio` times as long as
 * theirs and as many derivatives as there are here; those that the others lack are zero. */
OzStatus oz_element_pack_adopt(OzArrays *arrays, const OzArrays *from, int member, double ratio);

/* Reads the free elements' state into snapshot. */
OzStatus oz_element_pack_state(const OzArrays *arrays, int member,
                               const OzElementParameters *parameters, OzSnapshot *snapshot);
