/* THE list of what the energy ledger adds up, one a model: word of the kernels' sums (OZ_L_, with
 * elements OZ_PL_), member of the host's ledger (model/snapshot.h), column, meaning. Host and
 * kernels. */
#pragma once

/* All models' last one; the others of a model are its losses. */
#define OZ_LEDGER_WORK(X)                                                                          \
    X(WORK_WALLS, work_walls, work_walls,                                                          \
      "put in so far by moving walls, by what drives pistons, and by a cell's shear")

/* The kernels' SPRING is what tangential springs were given: what they do not hold is friction. */
#define OZ_LEDGER_LOSSES(X)                                                                        \
    X(DISSIPATED, dissipated, energy_dissipated,                                                   \
      "lost in dashpots, pistons' too, and to a fluid, so far")                                    \
    X(SPRING, friction, energy_friction, "lost by sliding and resisted rolling so far")

#define OZ_ELEMENT_LEDGER_LOSSES(X)                                                                \
    X(BEAM_AXIAL, beam_axial, energy_beam_axial, "lost along beams so far")                        \
    X(BEAM_BENDING, beam_bending, energy_beam_bending, "lost in beams' bending so far")            \
    X(DISC_DAMPING, disc_damping, energy_disc_damping, "lost in discs' normal damping so far")     \
    X(DISC_FRICTION, disc_friction, energy_disc_friction, "lost in discs' sliding so far")

#define OZ_LEDGER_ID(NAME, member, column, meaning)         OZ_L_##NAME,
#define OZ_ELEMENT_LEDGER_ID(NAME, member, column, meaning) OZ_PL_##NAME,
enum { OZ_LEDGER_LOSSES(OZ_LEDGER_ID) OZ_LEDGER_WORK(OZ_LEDGER_ID) OZ_LEDGER_WORDS };
enum {
    OZ_ELEMENT_LEDGER_LOSSES(OZ_ELEMENT_LEDGER_ID) OZ_LEDGER_WORK(OZ_ELEMENT_LEDGER_ID)
        OZ_ELEMENT_LEDGER
};
#undef OZ_LEDGER_ID
#undef OZ_ELEMENT_LEDGER_ID
