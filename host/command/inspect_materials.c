/* Printing what materials come to. */
#include "command/inspect_materials.h"

#include <math.h>

enum { WORDS = 64, PLACE = 26 };

static double most_of(const OzPrediction *rows, int count, double (*value)(const OzPrediction *row))
{
    double most = 0;
    for (int i = 0; i < count; i++) {
        most = fmax(most, value(&rows[i]));
    }
    return most;
}

static double rolling_of(const OzPrediction *row)
{
    return row->values.rolling_friction;
}

static double twisting_of(const OzPrediction *row)
{
    return row->values.twisting_friction;
}

static double adhesion_of(const OzPrediction *row)
{
    return row->values.surface_energy;
}

/* Columns that some scenes have. */
static const struct {
    const char *name;
    double (*value)(const OzPrediction *row);
} extras[] = {{"rolling", rolling_of}, {"twisting", twisting_of}, {"adhesion", adhesion_of}};

enum { EXTRAS = sizeof extras / sizeof *extras };

/* What a law has of how hard two bodies are together. */
static double hardness(const OzPrediction *row)
{
    const OzContactValues *v = &row->values;
    double one = (1 - v->poisson_ratio * v->poisson_ratio) / v->youngs_modulus;
    double other = (1 - v->other_ratio * v->other_ratio) / v->other_modulus;
    return v->law == OZ_LAW_HOOKE   ? v->contact_time
           : v->law == OZ_LAW_HERTZ ? v->hertz_stiffness
                                    : 1 / (one + other);
}

/* Whether an earlier wall is of the same material. */
static bool is_told(const OzScene *scene, int wall)
{
    int own = scene->walls[wall].material_number;
    for (int w = 0; own > 0 && w < wall; w++) {
        if (scene->walls[w].material_number == own) {
            return true;
        }
    }
    return false;
}

static void print_place(FILE *file, const OzScene *scene, const OzPrediction *row)
{
    char text[WORDS];
    const char *one = oz_mixing_name(scene, row->one);
    if (row->wall < 0) {
        snprintf(text, sizeof text, "%s, %s", one, oz_mixing_name(scene, row->other));
    } else if (scene->walls[row->wall].material) {
        snprintf(text, sizeof text, "%s, wall of %s", one, oz_mixing_wall_name(scene, row->wall));
    } else {
        snprintf(text, sizeof text, "%s, wall %d", one, row->wall);
    }
    fprintf(file, "  %-*s", PLACE, text);
}

/* The entry of pairs that a row's values are of. */
static const OzMaterialPair *pair_of(const OzScene *scene, const OzPrediction *row)
{
    for (int i = 0; i < scene->pair_count; i++) {
        const char *one = oz_mixing_name(scene, row->one);
        const char *other = row->wall < 0 ? oz_mixing_name(scene, row->other)
                                          : oz_mixing_wall_name(scene, row->wall);
        if (oz_mixing_joins(&scene->pairs[i], one, other)) {
            return &scene->pairs[i];
        }
    }
    return NULL;
}

static void print_told(FILE *file, const OzScene *scene, const OzPrediction *row)
{
    const OzMaterialPair *pair = pair_of(scene, row);
    const char *lead = "  pairs: ";
#define TELL(name, rule)                                                                           \
    if (pair && pair->has_##name) {                                                                \
        fprintf(file, "%s" #name, lead);                                                           \
        lead = ", ";                                                                               \
    }
    OZ_MIXED(TELL)
#undef TELL
    fputc('\n', file);
}

static void print_row(FILE *file, const OzScene *scene, const OzPrediction *row,
                      const bool shown[EXTRAS])
{
    print_place(file, scene, row);
    fprintf(file, " %-11.4g %-11.4g", hardness(row), row->mass_high * row->constants.stiffness);
    fprintf(file, " %-11.4g %-7.4g %-9.4g", row->values.restitution, row->hits.mean,
            row->values.friction);
    for (int k = 0; k < EXTRAS; k++) {
        if (shown[k]) {
            fprintf(file, " %-9.4g", extras[k].value(row));
        }
    }
    fprintf(file, " %.4g", row->largest_step);
    print_told(file, scene, row);
}

void oz_inspect_materials_print(FILE *file, const OzScene *scene, const OzPrediction *rows,
                                int count)
{
    static const char *const hardnesses[] = {[OZ_LAW_HOOKE] = "time, s",
                                             [OZ_LAW_HERTZ] = "Y, N/m^1.5",
                                             [OZ_LAW_HERTZ_MINDLIN] = "E*, Pa"};
    bool shown[EXTRAS];
    if (scene->material_count == 0) {
        return;
    }
    fprintf(file, "%-*s %-11s %-11s %-11s %-7s %-9s", PLACE + 2, "materials",
            hardnesses[scene->contact.law], "k_n, N/m", "restitution", "gives", "friction");
    for (int k = 0; k < EXTRAS; k++) {
        shown[k] = most_of(rows, count, extras[k].value) > 0;
        fprintf(file, shown[k] ? " %-9s" : "%.0s", extras[k].name);
    }
    fputs(" largest step, s\n", file);
    for (int i = 0; i < count; i++) {
        if (rows[i].wall < 0 || !is_told(scene, rows[i].wall)) {
            print_row(file, scene, &rows[i], shown);
        }
    }
}

void oz_inspect_materials_place(char *text, size_t size, const OzScene *scene,
                                const OzPrediction *row)
{
    bool several = oz_mixing_count(scene) > 1;
    if (row->wall >= 0) {
        snprintf(text, size, "%s at wall %d", several ? oz_mixing_name(scene, row->one) : "a grain",
                 row->wall);
    } else if (several) {
        snprintf(text, size, "%s and %s", oz_mixing_name(scene, row->one),
                 oz_mixing_name(scene, row->other));
    } else {
        snprintf(text, size, "two grains");
    }
}
