/* Rods' stop bits in words, and what would help. */
#include "sim/rods_guard.h"

#include "sim/advice.h"
#include "sim/constants.h"

#include <stdio.h>

const OzStop oz_rods_guard_stops[OZ_RODS_GUARD_STOPS] = {
    {OZ_STOP_NAN, "its state is not a number"},
    {OZ_STOP_ESCAPED, "it has left its container"},
    {OZ_STOP_MET, "it overlaps another body so far that shafts meet, or a centre lies behind "
                  "a wall"},
    {OZ_STOP_DEEP, "it overlaps another body by more than guards.overlap.stop"},
    {OZ_STOP_FAST, "an end of it moves more than half its radius in one step"},
};

int oz_rods_guard_grain(const OzGrains *grains, int index)
{
    (void)grains;
    return index;
}

/* A grain beyond the domain. */
static void advise_escaped(char *text, size_t size, const OzSnapshot *now)
{
    OzParameters parameters;
    int order[OZ_WALLS_MAX];
    bool is_float = now->scene->precision == OZ_PRECISION_FLOAT;
    snprintf(text, size, "no wall holds it");
    if (oz_constants_fill(&parameters, order, now->scene, now->grains) == OZ_OK) {
        snprintf(text, size, "it is beyond %.3g m, where no wall holds it%s",
                 parameters.domain * parameters.length_unit,
                 is_float ? " and precision: float no place (double does)" : "");
    }
}

/* What would help: the guards of depth know, the others say where to look. */
void oz_rods_guard_advise(char *text, size_t size, const OzControlHead *control,
                          const OzSnapshot *now)
{
    if (control->stop_bits & OZ_STOP_NAN) {
        snprintf(text, size, "`orzo check` says what step is stable");
    } else if (control->stop_bits & OZ_STOP_FAST) {
        snprintf(text, size, "try a smaller time.step (`orzo check` says what is stable)");
    } else if (control->stop_bits & (OZ_STOP_DEEP | OZ_STOP_MET)) {
        oz_advice_write(text, size, now, control->stop_index);
    } else {
        advise_escaped(text, size, now);
    }
}
