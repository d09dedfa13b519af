/* Sums over pieces. Those of walls have no mass. */
#include "observe/piece_energy.h"

double oz_piece_energy_translational(const OzSnapshot *snapshot)
{
    const OzPieces *pieces = snapshot->grains->pieces;
    double sum = 0;
    for (int64_t i = 0; i < pieces->free_count; i++) {
        const double *v = snapshot->piece_velocity + 2 * i;
        sum += pieces->mass[i] / 2 * (v[0] * v[0] + v[1] * v[1]);
    }
    return sum;
}

double oz_piece_energy_rotational(const OzSnapshot *snapshot)
{
    const OzPieces *pieces = snapshot->grains->pieces;
    double sum = 0;
    for (int64_t i = 0; i < pieces->free_count; i++) {
        sum += pieces->inertia[i] / 2 * snapshot->piece_spin[i] * snapshot->piece_spin[i];
    }
    return sum;
}

double oz_piece_energy_potential(const OzSnapshot *snapshot)
{
    const OzPieces *pieces = snapshot->grains->pieces;
    const double *g = snapshot->scene->gravity;
    double sum = 0;
    for (int64_t i = 0; i < pieces->free_count; i++) {
        const double *x = snapshot->piece_position + 2 * i;
        sum -= pieces->mass[i] * (g[0] * x[0] + g[1] * x[1]);
    }
    return sum;
}

double oz_piece_energy_stored(const OzSnapshot *snapshot)
{
    return snapshot->pieces.contact_energy + snapshot->pieces.beam_energy;
}

double oz_piece_energy_lost(const OzSnapshot *snapshot)
{
    const OzPieceLedger *ledger = &snapshot->piece_ledger;
    return ledger->beam_axial + ledger->beam_bending + ledger->disc_damping + ledger->disc_friction;
}
