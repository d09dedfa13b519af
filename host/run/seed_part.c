/* Parts as even as they can be. */
#include "run/seed_part.h"

OzStatus oz_seed_part_take(OzOptions *options)
{
    uint64_t count = options->seed_last - options->seed_first + 1, first = options->seed_first;
    uint64_t part = (uint64_t)options->part, parts = (uint64_t)options->parts;
    if (parts == 0) {
        return OZ_OK;
    }
    if (!options->has_seeds) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "orzo: --part without --seeds; expected --seeds with it");
    }
    options->seed_first = first + count * (part - 1) / parts;
    options->seed_last = first + count * part / parts - 1;
    return count * part / parts > count * (part - 1) / parts
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INPUT,
                                "orzo: part %d of %d has none of %llu seeds; expected as many "
                                "parts, or fewer",
                                options->part, options->parts, (unsigned long long)count);
}
