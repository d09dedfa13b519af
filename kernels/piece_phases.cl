/* The parts of a step of trigrains again and again on the state as it is, so that each can be timed by itself: for
 * `orzo bench`. The host puts the state back afterwards. */
#include "kernels/trigrains.cl"

#define OZ_REPEAT(name, ...)                                                                       \
    OZ_PIECE_KERNEL void oz_repeat_##name(OZ_PIECE_ARGUMENTS, int repeats)                         \
    {                                                                                              \
        OZ_PIECE_OPEN(0)                                                                           \
        OzPieceSums sums;                                                                          \
        oz_piece_sums_clear(&sums);                                                                \
        for (int k = 0; k < repeats; k++) {                                                        \
            __VA_ARGS__;                                                                           \
            OZ_PIECE_MEET();                                                                       \
        }                                                                                          \
    }

OZ_REPEAT(correct, oz_piece_move_correct(&w, 0, 0))
OZ_REPEAT(predict_correct, oz_piece_move_correct(&w, 0, 1))
OZ_REPEAT(classify, OZ_EACH(&w, region, w.z.regions) oz_piece_contacts_classify(&w, region))
OZ_REPEAT(contacts, OZ_EACH(&w, region, w.z.regions) oz_piece_contacts_push(&w, region, 0, &sums))
OZ_REPEAT(beams, oz_piece_beams_pull(&w, 0, &sums))
OZ_REPEAT(loads, oz_piece_loads_contacts(&w, w.load); oz_piece_loads_beams(&w, w.load))
OZ_REPEAT(refresh, oz_piece_lists_measure(&w); OZ_PIECE_MEET(); refresh(&w))
OZ_REPEAT(rebuild, oz_piece_lists_measure(&w); OZ_PIECE_MEET(); rebuild(&w); refresh(&w))
