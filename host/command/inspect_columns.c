/* Columns without a meaning in a scene. A row for each reason; which columns exist is read off THE
 * list of observables. */
#include "command/inspect_columns.h"

#include "observe/basin.h"
#include "observe/series.h"

#include <stdbool.h>
#include <string.h>

static bool lacks_area(const OzScene *scene, const OzGrains *grains)
{
    (void)grains;
    return !(oz_basin_area(scene) > 0);
}

static bool lacks_floor(const OzScene *scene, const OzGrains *grains)
{
    (void)grains;
    return oz_basin_floor(scene) < 0;
}

static bool lacks_shafts(const OzScene *scene, const OzGrains *grains)
{
    (void)scene;
    for (int64_t i = 0; i < grains->count; i++) {
        if (grains->length[i] > 0) {
            return false;
        }
    }
    return true;
}

static bool lacks_period(const OzScene *scene, const OzGrains *grains)
{
    (void)grains;
    return !(scene->period > 0);
}

static bool lacks_outlet(const OzScene *scene, const OzGrains *grains)
{
    (void)grains;
    return !scene->observe.has_outlet;
}

static bool lacks_drum(const OzScene *scene, const OzGrains *grains)
{
    (void)grains;
    bool drum = false;
    for (int w = 0; w < scene->wall_count; w++) {
        drum |= scene->walls[w].kind == OZ_WALL_DRUM;
    }
    return !drum || (scene->gravity[0] == 0 && scene->gravity[1] == 0);
}

static bool lacks_beams(const OzScene *scene, const OzGrains *grains)
{
    (void)scene;
    return grains->elements && grains->elements->beam_count == 0;
}

static bool lacks_second(const OzScene *scene, const OzGrains *grains)
{
    (void)scene;
    return grains->count < 2;
}

#define NO_FLOOR "no level floor, from which they are measured"

/* A column belongs to the first row whose beginning and end its name has. */
static const struct {
    const char *begin, *end;
    bool (*lacks)(const OzScene *scene, const OzGrains *grains);
    const char *why;
} reasons[] = {
    {"density", "", lacks_area, "no upright cylinder, box or periodic cell, whose area they need"},
    {"density", "", lacks_floor, NO_FLOOR},
    {"count_layer", "", lacks_floor, NO_FLOOR},
    {"angle_layer", "", lacks_floor, NO_FLOOR},
    {"angle", "", lacks_shafts, "no shafts"},
    {"nematic_", "", lacks_shafts, "no shafts"},
    {"psi6", "", lacks_shafts, "no shafts"},
    {"tap", "", lacks_period, "no wall moves up and down"},
    {"", "_tap_mean", lacks_period, "no wall moves up and down"},
    {"outflow_", "", lacks_outlet, "no observe.outlet"},
    {"inclination", "", lacks_drum, "no drum or no gravity"},
    {"avalanche_count", "", lacks_drum, "no drum or no gravity"},
    {"avalanche_size", "", lacks_drum, "no drum or no gravity"},
    {"stretch_", "", lacks_beams, "no beams"},
    {"bend_max", "", lacks_beams, "no beams"},
    {"spin_1", "", lacks_second, "one grain"},
};

enum { REASONS = sizeof reasons / sizeof *reasons };

static bool matches(const char *name, int reason)
{
    size_t length = strlen(name), end = strlen(reasons[reason].end);
    return strncmp(name, reasons[reason].begin, strlen(reasons[reason].begin)) == 0 &&
           length >= end && strcmp(name + length - end, reasons[reason].end) == 0;
}

/* Why the column stays empty, or NULL. */
static const char *reason_for(const OzColumn *column, const OzScene *scene, const OzGrains *grains)
{
    for (int r = 0; oz_observables_cells(column, scene) > 0 && r < REASONS; r++) {
        if (matches(column->name, r) && reasons[r].lacks(scene, grains)) {
            return reasons[r].why;
        }
    }
    return NULL;
}

void oz_inspect_columns_print(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    const char *last = NULL;
    char name[OZ_COLUMN_NAME];
    for (int r = 0; r < REASONS; r++) {
        const char *why = reasons[r].why, *lead = last ? "; " : "";
        for (int before = 0; before < r; before++) { /* said with the first row that says so */
            why = why && strcmp(reasons[before].why, why) == 0 ? NULL : why;
        }
        bool any = false;
        for (const OzColumn *column = oz_series_columns(); why && column->name; column++) {
            const char *found = reason_for(column, scene, grains);
            int cells = found && strcmp(found, why) == 0 ? oz_observables_cells(column, scene) : 0;
            for (int cell = 0; cell < cells; cell++, any = true) {
                oz_observables_name(column, scene, cell, name);
                fprintf(file, "%s%s", any ? ", " : lead, name);
            }
        }
        if (any) {
            fprintf(file, ": %s", why);
            last = why;
        }
    }
    fputs(last ? "\n" : "none\n", file);
}
