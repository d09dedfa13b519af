/* Lengths of phases, and their settings cut up. */
#include "scene/phases.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int64_t oz_phases_count(const OzScene *scene)
{
    return scene->cycles * scene->phase_count;
}

/* s, of the first so many rows. */
static double sum(const OzScene *scene, int64_t rows)
{
    double length = 0;
    for (int64_t i = 0; i < rows; i++) {
        length += scene->phases[i].length;
    }
    return length;
}

double oz_phases_begin(const OzScene *scene, int64_t phase)
{
    int64_t cycle = phase / scene->phase_count;
    double before =
        cycle > 0 ? (double)cycle * sum(scene, scene->phase_count) : 0; /* 0 of endless */
    return before + sum(scene, phase % scene->phase_count);
}

int64_t oz_phases_at(const OzScene *scene, double time)
{
    int64_t phase = 0, count = oz_phases_count(scene);
    if (count == 0) {
        return -1;
    }
    double cycle = floor(time / sum(scene, scene->phase_count));
    phase = (int64_t)fmin(fmax(cycle, 0), (double)(scene->cycles - 1)) * scene->phase_count;
    while (phase + 1 < count && time >= oz_phases_begin(scene, phase + 1)) {
        phase++;
    }
    return phase;
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
    } else if (!(phase->length > 0) && (i + 1 < scene->phase_count || scene->cycles > 1)) {
        snprintf(path, sizeof path, "phases.%d", i);
        oz_tree_fault(root, faults, path,
                      "%s has no length, and another phase follows; expected time or taps", path);
    } else if (!(phase->length > 0)) {
        phase->length = fmax(scene->duration - sum(scene, i), 0);
    }
}

void oz_phases_check(OzScene *scene, OzNode *root, OzFaults *faults)
{
    const double slack = 1 + 1e-9; /* rounding of sums of lengths */
    for (int i = 0; i < scene->phase_count; i++) {
        find_length(scene, i, root, faults);
    }
    double all = (double)scene->cycles * sum(scene, scene->phase_count);
    if (scene->cycles > 1 && scene->phase_count == 0) {
        oz_tree_fault(root, faults, "cycles", "cycles without phases; expected phases with them");
    }
    if (all > scene->duration * slack) {
        oz_tree_fault(root, faults, "phases",
                      "the phases last %.9g s together, the run %.9g s; expected no longer ones, "
                      "or a longer run (time)",
                      all, scene->duration);
    }
}
