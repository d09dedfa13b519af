/* The stable step of each wall. */
#include "command/inspect_walls.h"

#include "base/memory.h"
#include "sim/stiffness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS = 32 };

typedef struct Limit {
    char text[WORDS]; /* as it is printed */
    bool too_small;   /* for the scene's step */
} Limit;

static OzStatus find_limit(Limit *limit, const OzScene *scene, const OzGrains *grains,
                           const OzPrediction *rows, int w)
{
    OzStiffness lying;
    double largest = INFINITY;
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        largest = rows[i].wall == w ? fmin(largest, rows[i].largest_step) : largest;
    }
    if (oz_stiffness_applies(scene)) {
        OZ_PASS(oz_stiffness_at_wall(&lying, scene, grains, w));
        largest = lying.largest_step;
    }
    limit->too_small = scene->step >= largest;
    snprintf(limit->text, sizeof limit->text, "%.3g s%s", largest,
             limit->too_small ? ", less than the step" : "");
    return OZ_OK;
}

static void print_walls(FILE *file, int first, int last, const char *text)
{
    if (last > first) {
        fprintf(file, "; at walls %d to %d %s", first, last, text);
    } else {
        fprintf(file, "; at wall %d %s", first, text);
    }
}

OzStatus oz_inspect_walls_print(FILE *file, const OzScene *scene, const OzGrains *grains,
                                const OzPrediction *rows)
{
    OzStatus status = OZ_OK;
    Limit *limits = NULL;
    if (scene->wall_count == 0) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&limits, scene->wall_count));
    for (int w = 0; w < scene->wall_count; w++) {
        OZ_TRY(find_limit(&limits[w], scene, grains, rows, w));
    }
    double pairs = INFINITY;
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        pairs = rows[i].wall < 0 ? fmin(pairs, rows[i].largest_step) : pairs;
    }
    fprintf(file, "  largest steps    two grains %.3g s", pairs);
    for (int first = 0, last; first < scene->wall_count; first = last + 1) {
        last = first;
        while (last + 1 < scene->wall_count &&
               strcmp(limits[last + 1].text, limits[first].text) == 0) {
            last++;
        }
        print_walls(file, first, last, limits[first].text);
    }
    fputc('\n', file);
done:
    free(limits);
    return status;
}
