/* Printing what trigrains are made of and how large their step may be. */
#include "command/inspect_elements.h"

#include "command/inspect_motion.h"
#include "command/inspect_range.h"
#include "model/beam_limits.h"
#include "model/shape.h"
#include "sim/start.h"
#include "sim/trial.h"

#include <math.h>

static void print_bodies(FILE *file, const OzGrains *grains)
{
    const OzElements *elements = grains->elements;
    fprintf(file, "grains             %lld\n", (long long)grains->count);
    oz_inspect_range_print_all(file, "diameter", grains->diameter, NULL, grains->count,
                               "m (circle around)");
    oz_inspect_range_print_all(file, "mass", grains->mass, NULL, grains->count, "kg");
    oz_inspect_range_print_all(file, "inertia", grains->inertia, NULL, grains->count, "kg m^2");
    oz_inspect_range_print_places(file, grains->position, grains->count, true);
    fprintf(file, "elements             %lld of grains, %lld of walls\n",
            (long long)elements->free_count, (long long)(elements->count - elements->free_count));
    oz_inspect_range_print_all(file, "triangle", elements->area, elements->radius,
                               elements->free_count, "m^2");
    fprintf(file, "beams              %lld\n", (long long)elements->beam_count);
    oz_inspect_range_print_all(file, "length", elements->beam_length, NULL, elements->beam_count,
                               "m");
}

/* Grains that are not as symmetric as they look. */
static void print_symmetry(FILE *file, const OzScene *scene)
{
    for (int i = 0; i < scene->population_count; i++) {
        if (!oz_shape_keeps_symmetry(scene, &scene->populations[i])) {
            fprintf(
                file,
                "symmetry           grains.%d: the outline has one that its triangles have not; "
                "it bends more on one side, and may begin to turn where it should not\n",
                i);
        }
    }
}

/* From what speed on a hit breaks the grain that was thrown. */
static OzStatus print_strength(FILE *file, const OzScene *scene, const OzGrains *grains,
                               const OzTrial *trial)
{
    double slowest = 0;
    if (!scene->beams.strength.present || trial->grain < 0) {
        return OZ_OK;
    }
    OZ_PASS(oz_trial_break(&slowest, scene, grains, trial->grain, trial->speed));
    if (slowest > 0) {
        double gravity = hypot(scene->gravity[0], scene->gravity[1]);
        fprintf(file, "  strength         grain %lld breaks in a hit at %.2g m/s and faster",
                (long long)trial->grain, slowest);
        fprintf(file, gravity > 0 ? ", a fall of %.2g m\n" : "\n",
                0.5 * slowest * slowest / fmax(gravity, 1e-300));
    } else if (trial->speed > 0) {
        fprintf(file, "  strength         no hit that contacts bear breaks grain %lld\n",
                (long long)trial->grain);
    }
    return OZ_OK;
}

/* What hits and the pile's weight do to beams; the weight at rest by the force of the hit. */
static OzStatus print_softness(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    OzTrial trial;
    OZ_PASS(oz_trial_worst(&trial, scene, grains));
    if (trial.grain >= 0 && trial.speed > 0) {
        fprintf(
            file,
            "beams              a hit at %.3g m/s bends grain %lld by %.2g rad and stretches it "
            "by %.2g",
            trial.speed, (long long)trial.grain, trial.bend, trial.stretch);
        if (trial.force > 0 && grains->count > 1) {
            double load = oz_start_overlap_load(scene, grains);
            fprintf(file, "; the weight of the pile by %.2g rad", trial.bend * load / trial.force);
        }
        fprintf(file, "\n");
    }
    return print_strength(file, scene, grains, &trial);
}

OzStatus oz_inspect_elements_warn(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    OzTrial trial;
    char advice[256];
    OZ_PASS(oz_trial_worst(&trial, scene, grains));
    if (trial.grain >= 0 && trial.speed > 0) {
        double breaks = 0;
        OZ_PASS(oz_trial_break(&breaks, scene, grains, trial.grain, trial.speed));
        oz_trial_advise(advice, sizeof advice, &trial, scene);
        if (breaks > 0 && breaks <= trial.speed) {
            advice[0] = 0; /* beams break before they go so far */
        }
        fprintf(file, advice[0] ? "  warning          %s\n" : "%s", advice);
    }
    return OZ_OK;
}

OzStatus oz_inspect_elements_print(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    OzBeamLimit limit;
    print_bodies(file, grains);
    print_symmetry(file, scene);
    oz_inspect_motion_print(file, scene);
    if (scene->precision == OZ_PRECISION_FLOAT) {
        fprintf(file, "precision          float: rounds away what a small step moves; energies and "
                      "rest are not to be trusted\n");
    }
    OzStatus status = print_softness(file, scene, grains);
    if (status != OZ_OK) {
        return status;
    }
    status = oz_beam_limits_find(&limit, scene, grains);
    if (status != OZ_OK || isinf(limit.largest_step)) {
        return status;
    }
    fprintf(file, "stiffest           grain %lld: %.4g rad/s, damped at %.4g 1/s; set by %s",
            (long long)limit.grain, limit.rate, limit.damping, limit.beam < 0 ? "a contact" : "");
    if (limit.beam >= 0) {
        fprintf(file, "beam %lld of %.4g m", (long long)limit.beam,
                grains->elements->beam_length[limit.beam]);
    }
    fprintf(file, "\n  stable           %s: largest step %.6g s, margin %.3g\n",
            scene->step < limit.largest_step ? "yes" : "NO", limit.largest_step,
            limit.largest_step / scene->step);
    return OZ_OK;
}
