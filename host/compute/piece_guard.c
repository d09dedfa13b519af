/* Trigrains' stop bits in words, and what would help. */
#include "compute/piece_guard.h"

#include "compute/piece_advice.h"
#include "kernels/piece_layout.h"

#include <stdio.h>

const OzStop oz_piece_guard_stops[OZ_PIECE_GUARD_STOPS] = {
    {OZ_PIECE_STOP_NAN, "its state is not a number"},
    {OZ_PIECE_STOP_ESCAPED, "it has left its container"},
    {OZ_PIECE_STOP_SWALLOWED, "a triangle of it is wholly inside another, or around one"},
    {OZ_PIECE_STOP_DEEP, "a piece of it overlaps another body by more than half"},
    {OZ_PIECE_STOP_STRETCHED, "a beam of it is shorter than half or longer than 1.5 times its "
                              "length at rest"},
    {OZ_PIECE_STOP_BENT, "a beam of it is bent by more than 1 rad"},
    {OZ_PIECE_STOP_FAST, "a piece of it moves more than half its thickness in one step"},
};

int oz_piece_guard_grain(const OzGrains *grains, int slot)
{
    const OzPieces *pieces = grains->pieces;
    return slot >= 0 && slot < pieces->free_count ? pieces->body[slot] : -1;
}

/* What would help: the step only where it is to blame. */
void oz_piece_guard_advise(char *text, size_t size, const OzControlHead *control,
                           const OzSnapshot *now)
{
    static const struct {
        int bits;
        OzPieceSoft soft;
    } soft[] = {
        {OZ_PIECE_STOP_SWALLOWED | OZ_PIECE_STOP_DEEP, OZ_PIECE_SOFT_CONTACT},
        {OZ_PIECE_STOP_BENT, OZ_PIECE_SOFT_BENDING},
        {OZ_PIECE_STOP_STRETCHED, OZ_PIECE_SOFT_STRETCH},
    };
    bool known = oz_piece_guard_grain(now->grains, control->stop_index) >= 0;
    snprintf(text, size, "`orzo check` says what step is stable");
    if (control->stop_bits & OZ_PIECE_STOP_FAST) {
        snprintf(text, size, "try a smaller time.step (`orzo check` says what is stable)");
        return;
    }
    if (control->stop_bits == OZ_PIECE_STOP_ESCAPED) {
        snprintf(text, size, "no wall holds it");
        return;
    }
    for (size_t i = 0; i < sizeof soft / sizeof soft[0]; i++) {
        if (known && !(control->stop_bits & OZ_PIECE_STOP_NAN) &&
            (control->stop_bits & soft[i].bits)) {
            oz_piece_advice_write(text, size, now, control->stop_index, soft[i].soft);
            return;
        }
    }
}
