/* Stop bits into text. */
#include "compute/piece_guard.h"

#include "compute/piece_advice.h"

#include <stdio.h>
#include <string.h>

/* What would help: the step only where it is to blame. */
static void advise(char *text, size_t size, const OzPieceControl *control, const OzSnapshot *now)
{
    static const struct {
        int bits;
        OzPieceSoft soft;
    } soft[] = {
        {OZ_PIECE_STOP_SWALLOWED | OZ_PIECE_STOP_DEEP, OZ_PIECE_SOFT_CONTACT},
        {OZ_PIECE_STOP_BENT, OZ_PIECE_SOFT_BENDING},
        {OZ_PIECE_STOP_STRETCHED, OZ_PIECE_SOFT_STRETCH},
    };
    bool known = control->stop_index >= 0 && control->stop_index < now->grains->pieces->free_count;
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

OzStatus oz_piece_guard_fail(const OzPieceControl *control, const OzSnapshot *now, bool settling)
{
    static const struct {
        int bit;
        const char *text;
    } reasons[] = {
        {OZ_PIECE_STOP_NAN, "its state is not a number"},
        {OZ_PIECE_STOP_ESCAPED, "it has left its container"},
        {OZ_PIECE_STOP_SWALLOWED, "a triangle of it is wholly inside another, or around one"},
        {OZ_PIECE_STOP_DEEP, "a piece of it overlaps another body by more than half"},
        {OZ_PIECE_STOP_STRETCHED, "a beam of it is shorter than half or longer than 1.5 times its "
                                  "length at rest"},
        {OZ_PIECE_STOP_BENT, "a beam of it is bent by more than 1 rad"},
        {OZ_PIECE_STOP_FAST, "a piece of it moves more than half its thickness in one step"},
    };
    char text[512] = "", advice[256];
    for (size_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++) {
        if (control->stop_bits & reasons[i].bit) {
            size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? "; " : "", reasons[i].text);
        }
    }
    const OzPieces *pieces = now->grains->pieces;
    bool known = control->stop_index >= 0 && control->stop_index < pieces->free_count;
    advise(advice, sizeof advice, control, now);
    return oz_status_fail(OZ_ERR_BLOWUP,
                          "%s: stopped at step %lld%s, time %.9g s, grain %d: %s; %s",
                          now->scene->path, (long long)now->step, settling ? " of settling" : "",
                          now->time, known ? pieces->body[control->stop_index] : -1, text, advice);
}
