/* Stop bits into text. */
#include "compute/guard.h"

#include <stdio.h>
#include <string.h>

OzStatus oz_guard_fail(const OzControl *control, const OzScene *scene, int64_t step, bool settling)
{
    static const struct {
        int bit;
        const char *text;
    } reasons[] = {
        {OZ_STOP_NAN, "its state is not a number"},
        {OZ_STOP_ESCAPED, "it has left its container"},
        {OZ_STOP_DEEP, "it overlaps another body by more than its radius"},
        {OZ_STOP_FAST, "an end of it moves more than half its radius in one step"},
    };
    char text[256] = "";
    for (size_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++) {
        if (control->stop_bits & reasons[i].bit) {
            size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? "; " : "", reasons[i].text);
        }
    }
    return oz_status_fail(OZ_ERR_BLOWUP,
                          "%s: stopped at step %lld%s, time %.9g s, grain %d: %s; try a smaller "
                          "time.step (`orzo check` says what is stable)",
                          scene->path, (long long)step, settling ? " of settling" : "",
                          (double)step * scene->step, control->stop_grain, text);
}
