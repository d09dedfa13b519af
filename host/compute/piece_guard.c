/* Stop bits into text. */
#include "compute/piece_guard.h"

#include <stdio.h>
#include <string.h>

OzStatus oz_piece_guard_fail(const OzPieceControl *control, const OzMember *member, int64_t step,
                             bool settling)
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
    char text[512] = "";
    for (size_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++) {
        if (control->stop_bits & reasons[i].bit) {
            size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? "; " : "", reasons[i].text);
        }
    }
    const OzPieces *pieces = member->grains->pieces;
    bool known = control->stop_slot >= 0 && control->stop_slot < pieces->free_count;
    return oz_status_fail(OZ_ERR_BLOWUP,
                          "%s: stopped at step %lld%s, time %.9g s, grain %d: %s; try a smaller "
                          "time.step (`orzo check` says what is stable)",
                          member->scene->path, (long long)step, settling ? " of settling" : "",
                          (double)step * member->scene->step,
                          known ? pieces->body[control->stop_slot] : -1, text);
}
