/* Trigrains' stop bits in words, and what would help. */
#include "sim/element_guard.h"

#include "kernels/element_layout.h"
#include "sim/element_advice.h"

#include <stdio.h>

const OzStop oz_element_guard_stops[OZ_ELEMENT_GUARD_STOPS] = {
    {OZ_ELEMENT_STOP_NAN, "its state is not a number"},
    {OZ_ELEMENT_STOP_ESCAPED, "it has left its container"},
    {OZ_ELEMENT_STOP_SWALLOWED, "a triangle of it is wholly inside another, or around one"},
    {OZ_ELEMENT_STOP_DEEP, "an element of it overlaps another body by more than half"},
    {OZ_ELEMENT_STOP_STRETCHED, "a beam of it is shorter than half or longer than 1.5 times its "
                                "length at rest"},
    {OZ_ELEMENT_STOP_BENT, "a beam of it is bent by more than 1 rad"},
    {OZ_ELEMENT_STOP_FAST, "an element of it moves more than half its thickness in one step"},
};

int oz_element_guard_grain(const OzGrains *grains, int slot)
{
    const OzElements *elements = grains->elements;
    return slot >= 0 && slot < elements->free_count ? elements->body[slot] : -1;
}

/* What would help: the step only where it is to blame. */
void oz_element_guard_advise(char *text, size_t size, const OzControlHead *control,
                             const OzSnapshot *now)
{
    static const struct {
        int bits;
        OzElementSoft soft;
    } soft[] = {
        {OZ_ELEMENT_STOP_SWALLOWED | OZ_ELEMENT_STOP_DEEP, OZ_ELEMENT_SOFT_CONTACT},
        {OZ_ELEMENT_STOP_BENT, OZ_ELEMENT_SOFT_BENDING},
        {OZ_ELEMENT_STOP_STRETCHED, OZ_ELEMENT_SOFT_STRETCH},
    };
    bool known = oz_element_guard_grain(now->grains, control->stop_index) >= 0;
    snprintf(text, size, "`orzo check` says what step is stable");
    if (control->stop_bits & OZ_ELEMENT_STOP_FAST) {
        snprintf(text, size, "try a smaller time.step (`orzo check` says what is stable)");
        return;
    }
    if (control->stop_bits == OZ_ELEMENT_STOP_ESCAPED) {
        snprintf(text, size, "no wall holds it");
        return;
    }
    for (size_t i = 0; i < sizeof soft / sizeof soft[0]; i++) {
        if (known && !(control->stop_bits & OZ_ELEMENT_STOP_NAN) &&
            (control->stop_bits & soft[i].bits)) {
            oz_element_advice_write(text, size, now, control->stop_index, soft[i].soft);
            return;
        }
    }
}
