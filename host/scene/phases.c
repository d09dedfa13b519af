/* Lengths of phases, and their settings cut up. */
#include "scene/phases.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double oz_phases_begin(const OzScene *scene, int phase)
{
    double begin = 0;
    for (int i = 0; i < phase; i++) {
        begin += scene->phases[i].length;
    }
    return begin;
}

int oz_phases_at(const OzScene *scene, double time)
{
    int phase = 0;
    double end = scene->phase_count > 0 ? scene->phases[0].length : 0;
    while (phase + 1 < scene->phase_count && time >= end) {
        end += scene->phases[++phase].length;
    }
    return scene->phase_count > 0 ? phase : -1;
}

OzStatus oz_phases_settings(char ***settings, int *count, const OzPhase *phase)
{
    OzStatus status = OZ_OK;
    char *copy = NULL, *rest = NULL, *part = NULL;
    OZ_TRY(oz_memory_text(&copy, phase->set ? phase->set : ""));
    rest = copy;
    while ((part = strsep(&rest, ";")) != NULL) {
        part += strspn(part, " ");
        for (size_t end = strlen(part); end > 0 && part[end - 1] == ' ';) {
            part[--end] = '\0';
        }
        if (part[0]) {
            OZ_TRY(oz_memory_grow((void **)settings, (size_t)*count, (size_t)*count + 1,
                                  sizeof(char *), "settings"));
            OZ_TRY(oz_memory_text(&(*settings)[*count], part));
            (*count)++;
        }
    }
done:
    free(copy);
    return status;
}

/* The last phase may go on to the end of the run. */
static void find_length(OzScene *scene, int i, OzNode *root, OzFaults *faults)
{
    OzPhase *phase = &scene->phases[i];
    char path[48];
    phase->length = phase->taps > 0 ? phase->taps * scene->period : phase->time;
    if (phase->taps > 0 && !(scene->period > 0)) {
        snprintf(path, sizeof path, "phases.%d.taps", i);
        oz_tree_fault(root, faults, path, "%s without a wall that is shaken; expected time", path);
    } else if (!(phase->length > 0) && i + 1 < scene->phase_count) {
        snprintf(path, sizeof path, "phases.%d", i);
        oz_tree_fault(root, faults, path,
                      "%s has no length, and another phase follows; expected time or taps", path);
    } else if (!(phase->length > 0)) {
        phase->length = fmax(scene->duration - oz_phases_begin(scene, i), 0);
    }
}

void oz_phases_check(OzScene *scene, OzNode *root, OzFaults *faults)
{
    const double slack = 1 + 1e-9; /* rounding of sums of lengths */
    for (int i = 0; i < scene->phase_count; i++) {
        find_length(scene, i, root, faults);
    }
    double all = oz_phases_begin(scene, scene->phase_count);
    if (all > scene->duration * slack) {
        oz_tree_fault(root, faults, "phases",
                      "the phases last %.9g s together, the run %.9g s; expected no longer ones, "
                      "or a longer run (time)",
                      all, scene->duration);
    }
}
