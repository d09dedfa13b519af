/* The parts of a step of trigrains again and again on the state as it is, so that each can be timed
 * by itself: for `orzo bench`. The host puts the state back afterwards. */
#include "kernels/trigrains.cl"

#define OZ_REPEAT(name, ...)                                                                       \
    OZ_ADVANCE_KERNEL oz_repeat_##name(OZ_WORK_ARGUMENTS, int repeats)                     \
    {                                                                                              \
        OZ_WORK_OPEN(0)                                                                         \
        OzElementSums sums;                                                                        \
        oz_element_sums_clear(&sums);                                                              \
        for (int k = 0; k < repeats; k++) {                                                        \
            __VA_ARGS__;                                                                           \
            OZ_WORK_BARRIER();                                                                  \
        }                                                                                          \
    }

OZ_REPEAT(correct, oz_element_move_correct(&w, 0, 0))
OZ_REPEAT(predict_correct, oz_element_move_correct(&w, 0, 1))
OZ_REPEAT(classify, OZ_EACH_REGION(&w) oz_element_contacts_classify(&w, region))
OZ_REPEAT(contacts, OZ_EACH_REGION(&w) oz_element_contacts_push(&w, region, 0, &sums))
OZ_REPEAT(beams, if (OZ_BEAMS) { oz_element_beams_pull(&w, 0, 1, &sums); })
OZ_REPEAT(loads, oz_element_loads_contacts(&w, w.load); oz_element_loads_beams(&w, w.load))
OZ_REPEAT(refresh, oz_lists_measure(&w); OZ_WORK_BARRIER(); refresh(&w))
OZ_REPEAT(rebuild, oz_lists_measure(&w); OZ_WORK_BARRIER(); rebuild(&w); refresh(&w))
