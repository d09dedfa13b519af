/* Converting between doubles and the device's scalars. */
#include "sim/scalars.h"

size_t oz_scalars_bytes(bool is_double)
{
    return is_double ? sizeof(double) : sizeof(float);
}

void oz_scalars_put(void *to, const double *from, size_t count, bool is_double)
{
    for (size_t i = 0; i < count; i++) {
        if (is_double) {
            ((double *)to)[i] = from[i];
        } else {
            ((float *)to)[i] = (float)from[i];
        }
    }
}

double oz_scalars_get(const void *words, size_t index, bool is_double)
{
    return is_double ? ((const double *)words)[index] : (double)((const float *)words)[index];
}
