/* The counting rule in numbers. */
#include "bench/bench_cost.h"

#include "sim/constants.h"

enum {
    SPRING = 3,
    SUMMED = 8,                      /* words of a result that the gather reads for one grain */
    MOVING_STATE = OZ_S_ACCELERATION /* what every integrator reads and writes                */
};

enum {
    PLACES = 6,    /* the difference of two places, in metres       */
    CLOSEST = 87,  /* the nearest points of two shafts              */
    CONTACT = 67,  /* normal, overlap, arms, velocity               */
    NORMAL = 19,   /* the normal force and the sum                  */
    FRICTION = 33, /* sliding, its dashpot, Coulomb's limit         */
    SPRINGS = 57,  /* turning, stretching and cutting the spring    */
    TORQUES = 22,  /* on both grains, and the guard of overlaps     */
    GATHER = 12,   /* adding force and torque to both grains        */
    MOTION = 233,  /* one grain: axes, Euler step, turn, guards     */
    WALL_END = 15  /* the distance of one end from one wall         */
};

OzBenchCost oz_bench_cost_step(const OzCounters *probe)
{
    double scalar = probe->is_double ? sizeof(double) : sizeof(float);
    double ends = (probe->round ? 1 : 2) * probe->walls, springs = probe->history ? 2 * SPRING : 0;
    double pair_words = 2 * OZ_RECORD + springs + OZ_PAIR_FORCE + OZ_PAIR_TORQUE + 2 * SUMMED;
    double grain_words = 2 * MOVING_STATE + ends * springs + OZ_RECORD + OZ_REFERENCE_PLAIN;
    double pair_bytes = scalar * pair_words + 3 * sizeof(int);
    double grain_bytes = scalar * grain_words + 3 * sizeof(int);
    double pair = PLACES + (probe->round ? 0 : CLOSEST) + CONTACT + NORMAL + FRICTION +
                  (probe->history ? SPRINGS : 0) + TORQUES + GATHER;
    double pairs = (double)probe->pairs, grains = (double)probe->grains;
    return (OzBenchCost){.bytes = pairs * pair_bytes + grains * grain_bytes,
                         .operations = pairs * pair + grains * (MOTION + ends * WALL_END)};
}
