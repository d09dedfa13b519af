/* Keeping count of members. It knows nothing of what they are made of. */
#include "compute/crew.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A launch is kept below this so that Ctrl-C and watchdogs are served, s. */
static const double launch_seconds = 0.04;

enum { FIRST_LAUNCH = 16 };

static void begin_clocks(OzCrew *crew)
{
    for (int m = 0; m < crew->member_count; m++) {
        crew->clock[m] = oz_step_clock_begin(crew->members[m].scene->step);
    }
}

OzStatus oz_crew_create(OzCrew *crew, const OzMember *members, int member_count)
{
    OzStatus status = OZ_OK;
    *crew = (OzCrew){.member_count = member_count, .launch_steps = FIRST_LAUNCH};
    OZ_TRY(OZ_NEW(&crew->members, member_count));
    OZ_TRY(OZ_NEW(&crew->reached, member_count));
    OZ_TRY(OZ_NEW(&crew->clock, member_count));
    OZ_TRY(OZ_NEW(&crew->waits, member_count));
    OZ_TRY(OZ_NEW(&crew->stopped, member_count));
    OZ_TRY(OZ_NEW(&crew->deep_count, member_count));
    OZ_TRY(OZ_NEW(&crew->deep_told, member_count));
    memcpy(crew->members, members, (size_t)member_count * sizeof *members);
    begin_clocks(crew);
done:
    return status;
}

void oz_crew_free(OzCrew *crew)
{
    for (int m = 0; crew->stopped && m < crew->member_count; m++) {
        free(crew->stopped[m]);
    }
    free(crew->members);
    free(crew->reached);
    free(crew->clock);
    free(crew->waits);
    free(crew->stopped);
    free(crew->deep_count);
    free(crew->deep_told);
    *crew = (OzCrew){0};
}

bool oz_crew_goes_on(const OzCrew *crew, int member)
{
    return !crew->waits[member] && !crew->stopped[member];
}

static bool all_stopped(const OzCrew *crew)
{
    for (int m = 0; m < crew->member_count; m++) {
        if (!crew->stopped[m]) {
            return false;
        }
    }
    return true;
}

OzStatus oz_crew_check(const OzCrew *crew)
{
    if (all_stopped(crew)) {
        return oz_status_fail(OZ_ERR_BLOWUP, "%s", crew->stopped[crew->member_count - 1]);
    }
    return OZ_OK;
}

void oz_crew_skip(OzCrew *crew, int64_t step)
{
    crew->step = step > crew->step ? step : crew->step;
    for (int m = 0; m < crew->member_count; m++) {
        crew->reached[m] = crew->step;
    }
}

int oz_crew_launch_steps(const OzCrew *crew, int64_t step)
{
    int64_t left = step - crew->step;
    return left < crew->launch_steps ? (int)left : crew->launch_steps;
}

void oz_crew_note_launch(OzCrew *crew, int made, double seconds, int most_steps)
{
    double wanted = launch_seconds / (seconds / fmax(made, 1));
    double most = fmin(4.0 * crew->launch_steps, most_steps);
    if (made == crew->launch_steps || wanted < crew->launch_steps) {
        crew->launch_steps = (int)fmax(1, fmin(wanted, most));
    }
}

void oz_crew_count(OzCrew *crew, int member, int own, int *most)
{
    crew->reached[member] += own;
    *most = own > *most ? own : *most;
}

OzStatus oz_crew_stop(OzCrew *crew, int member)
{
    return oz_memory_text(&crew->stopped[member], oz_status_text());
}

OzStatus oz_crew_end_launch(OzCrew *crew, int steps, int most)
{
    int made = all_stopped(crew) ? most : steps;
    crew->step += made;
    crew->counts.steps += made;
    return oz_crew_check(crew);
}

double oz_crew_time(const OzCrew *crew, int member, int64_t step)
{
    return oz_step_clock_time(&crew->clock[member], step);
}

void oz_crew_start_clock(OzCrew *crew)
{
    crew->step = 0;
    begin_clocks(crew);
    memset(crew->reached, 0, (size_t)crew->member_count * sizeof *crew->reached);
    memset(crew->deep_count, 0, (size_t)crew->member_count * sizeof *crew->deep_count);
    memset(crew->deep_told, 0, (size_t)crew->member_count * sizeof *crew->deep_told);
    crew->walls_still = false;
    crew->counts = (OzSimCounts){0};
}
