/* Printing what each kind of contact of a scene of rods comes to. */
#include "command/inspect_contacts.h"

#include "command/inspect_materials.h"
#include "command/inspect_range.h"
#include "model/calibrate.h"
#include "model/prediction.h"

#include <stdlib.h>
#include <string.h>

/* In the order of OzCalibrated. */
static const char *const calibrated[] = {
    NULL,
    "discrete: exact at every phase of first touch",
    "discrete: exact in the mean over the phases of first touch",
    "discrete: no damping gives what was asked; as if continuous",
};

static void print_restitution(FILE *file, const OzPrediction *row)
{
    char low[32], high[32];
    snprintf(low, sizeof low, "%.6g", row->hits.low);
    snprintf(high, sizeof high, "%.6g", row->hits.high);
    fprintf(file, "  restitution      asked %.6g, this integrator gives %.6g",
            row->values.restitution, row->hits.mean);
    if (strcmp(low, high) == 0) {
        fputs(" at every phase\n", file);
    } else {
        fprintf(file, " (%s ... %s by phase)\n", low, high);
    }
    if (row->values.law != OZ_LAW_HERTZ && row->values.restitution < OZ_CONTACT_RESTITUTION_LEAST) {
        fprintf(file, "  restitution      %g is used as %g\n", row->values.restitution,
                OZ_CONTACT_RESTITUTION_LEAST);
    }
}

/* The one choice with which friction is no loss. */
static void print_slip(FILE *file, const OzScene *scene, const OzPrediction *row)
{
    if (row->values.slip == OZ_SLIP_SCALE && row->values.friction > 0) {
        fprintf(file,
                "  friction         slip: scale gives energy back whatever the step; the guard "
                "against energy from nowhere %s\n",
                scene->observe.ledger ? "leaves it out" : "needs observe.ledger, and is off");
    }
}

static void print_contact(FILE *file, const OzScene *scene, const OzPrediction *row)
{
    const char *calibration = calibrated[oz_calibrate_outcome(scene, &row->values)];
    const OzContactConstants *c = &row->constants;
    if (row->speed > 0) {
        fprintf(file, "  hit              at %.4g m/s, stiffness at its deepest point\n",
                row->speed);
    }
    oz_inspect_range_print(file, "k_n", c->stiffness * row->mass_low, c->stiffness * row->mass_high,
                           "N/m");
    oz_inspect_range_print(file, "c_n", c->damping * row->mass_low, c->damping * row->mass_high,
                           "kg/s");
    fprintf(file, "  steps            %.4g a contact\n", row->steps);
    print_restitution(file, row);
    if (calibration) {
        fprintf(file, "  calibration      %s\n", calibration);
    }
    fprintf(file, "  stable           %s: largest step %.6g s, margin %.3g\n",
            row->stable ? "yes" : "NO", row->largest_step, row->margin);
    print_slip(file, scene, row);
    if (!row->tangential_stable) {
        fprintf(file, "  warning          a sticking tangential spring is unstable at this step\n");
    }
}

/* What is printed of a row below its heading; the caller frees it. */
static OzStatus describe_contact(char **text, const OzScene *scene, const OzPrediction *row)
{
    size_t length = 0;
    *text = NULL;
    FILE *file = open_memstream(text, &length);
    if (!file) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for the text of a contact");
    }
    print_contact(file, scene, row);
    return fclose(file) == 0 && *text
               ? OZ_OK
               : oz_status_fail(OZ_ERR_MEMORY, "out of memory for the text of a contact");
}

static void print_heading(FILE *file, const OzScene *scene, const OzPrediction *row, int last_wall)
{
    int first_wall = row->wall;
    if (oz_mixing_count(scene) > 1) {
        char place[64];
        oz_inspect_materials_place(place, sizeof place, scene, row);
        fprintf(file, "contact            of %s\n", place);
    } else if (first_wall < 0) {
        fprintf(file, "contact            of two grains\n");
    } else if (first_wall == last_wall) {
        fprintf(file, "contact            at wall %d\n", first_wall);
    } else {
        fprintf(file, "contact            at walls %d to %d\n", first_wall, last_wall);
    }
}

OzStatus oz_inspect_contacts_print(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    OzPrediction *rows = NULL;
    char *text = NULL, *next = NULL;
    int count = 0, last = 0;
    OzStatus status = OZ_OK;
    OZ_TRY(oz_prediction_rows(&rows, &count, scene, grains));
    for (int first = 0; first < count; first = last + 1) {
        free(text);
        OZ_TRY(describe_contact(&text, scene, &rows[first]));
        bool alone = rows[first].wall < 0 || oz_mixing_count(scene) > 1;
        for (last = first; !alone && last + 1 < count; last++) {
            free(next);
            OZ_TRY(describe_contact(&next, scene, &rows[last + 1]));
            if (strcmp(text, next) != 0) {
                break;
            }
        }
        print_heading(file, scene, &rows[first], rows[last].wall);
        fputs(text, file);
    }
    oz_inspect_materials_print(file, scene, rows, count);
done:
    free(rows);
    free(text);
    free(next);
    return status;
}
