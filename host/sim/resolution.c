/* Overlaps and speeds against the digits of a float. */
#include "sim/resolution.h"

#include "base/log.h"
#include "model/calibrate.h"
#include "model/hertz.h"
#include "model/motion.h"
#include "sim/constants.h"
#include "sim/sides.h"

#include <math.h>

/* How much finer overlaps are with kernels/fine.h: the rounding of a remainder, and of a few sums.
 */
static const double finer = 0x1p22;

/* Below this share of the speeds of the start, what gravity adds to them in a run does not matter.
 */
static const double weak = 0.01;

/* What a scene's grains meet with. */
typedef struct Pace {
    double gravity; /* m/s^2                                             */
    double start;   /* m/s, of the fastest grain, spin included, or wall */
    double most;    /* m/s, after as long a fall as there is time and room for */
} Pace;

static double length3(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double fastest_start(const OzScene *scene, const OzGrains *grains)
{
    double fastest = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        double reach = (grains->diameter[i] + grains->length[i]) / 2;
        fastest = fmax(fastest, length3(&grains->velocity[3 * i]) +
                                    reach * length3(&grains->angular_velocity[3 * i]));
    }
    for (int w = 0; w < scene->wall_count; w++) {
        double offset, speed;
        oz_motion_offset(&scene->walls[w].motion, 0, &offset, &speed);
        const OzWall *wall = &scene->walls[w];
        double widest = fmax(wall->diameter, fmax(wall->diameters[0], wall->diameters[1]));
        double rim = fabs(wall->motion.angular_velocity) * widest / 2;
        fastest = fmax(fastest, fabs(speed) + rim);
    }
    return fastest;
}

/* m, from the lowest to the highest grain along gravity, and half a diameter. */
static double room_to_fall(const OzScene *scene, const OzGrains *grains, double gravity)
{
    double low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < grains->count; i++) {
        const double *x = &grains->position[3 * i], *g = scene->gravity;
        double height = (x[0] * g[0] + x[1] * g[1] + x[2] * g[2]) / gravity;
        low = fmin(low, height);
        high = fmax(high, height);
    }
    return grains->count > 0 ? high - low + grains->diameter[0] / 2 : 0;
}

static Pace pace_of(const OzScene *scene, const OzGrains *grains)
{
    Pace pace = {.gravity = length3(scene->gravity), .start = fastest_start(scene, grains)};
    double time = scene->duration + (scene->settle.present ? scene->settle.time_max : 0);
    double fall = 0;
    if (pace.gravity > 0) {
        fall = fmin(pace.gravity * time,
                    sqrt(2 * pace.gravity * room_to_fall(scene, grains, pace.gravity)));
    }
    pace.most = pace.start + fall;
    return pace;
}

static bool gravity_matters(const Pace *pace, const OzScene *scene)
{
    return pace->gravity > 0 && pace->gravity * scene->duration > weak * pace->start;
}

/* Overlap of one kind of contact, m: at rest under the grain's own weight, or of a hit. */
static double overlap_of(const OzScene *scene, const OzGrains *grains, const OzMixed *mixed,
                         const Pace *pace, bool rests)
{
    if (oz_contact_is_linear(mixed->values.law)) {
        double stiffness = oz_calibrate_contact(scene, &mixed->values).stiffness;
        return rests ? pace->gravity / stiffness : pace->start / sqrt(stiffness);
    }
    double stiffness = oz_hertz_hit(scene, mixed, grains).stiffness;
    return rests ? pow(pace->gravity / stiffness, 2.0 / 3)
                 : pow(1.25 * pace->start * pace->start / stiffness, 0.4);
}

/* The least of all kinds of contact. */
static double least_overlap(const OzScene *scene, const OzGrains *grains, const Pace *pace,
                            bool rests)
{
    double least = INFINITY;
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        if (mixed.wall >= 0 || grains->count > 1) {
            least = fmin(least, overlap_of(scene, grains, &mixed, pace, rests));
        }
    }
    return least;
}

/* A unit of a place, or a digit of the longest grain. */
static double coarse_digit(const OzParameters *parameters, const OzGrains *grains)
{
    double longest = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        longest = fmax(longest, grains->diameter[i] + grains->length[i]);
    }
    return fmax(parameters->length_unit, longest * 0x1p-23);
}

static OzStatus find(OzResolution *r, const OzScene *scene, const OzGrains *grains)
{
    OzParameters parameters;
    int order[OZ_WALLS_MAX];
    Pace pace = pace_of(scene, grains);
    OZ_PASS(oz_constants_fill(&parameters, order, scene, grains));
    *r = (OzResolution){.overlap = INFINITY, .gain = INFINITY, .speed = pace.most};
    r->rests = gravity_matters(&pace, scene);
    r->digit = coarse_digit(&parameters, grains);
    r->speed_digit = pace.most * 0x1p-23;
    if (r->rests || pace.start > 0) {
        r->overlap = least_overlap(scene, grains, &pace, r->rests);
    }
    if (r->rests) {
        r->gain = pace.gravity * scene->step;
    }
    return OZ_OK;
}

/* Whether every wall's overlap can be had with all digits. */
static bool walls_are_fine(const OzScene *scene)
{
#define ROW(NAME, name, choice, fine, edged) [OZ_WALL_##NAME] = fine,
    static const bool is_fine[OZ_WALLS_END] = {OZ_WALLS(ROW)};
#undef ROW
    OzWallSide sides[OZ_WALLS_MAX];
    int count = oz_sides_list(sides, scene);
    for (int w = 0; w < scene->wall_count; w++) {
        if (oz_motion_is_free(&scene->walls[w].motion)) {
            return false;
        }
    }
    for (int k = 0; k < count && k < OZ_WALLS_MAX; k++) {
        if (!is_fine[(int)sides[k].shape.kind]) {
            return false;
        }
    }
    return true;
}

bool oz_resolution_is_fine(const OzScene *scene, const OzGrains *grains)
{
    OzResolution r;
    return scene->precision == OZ_PRECISION_FLOAT && find(&r, scene, grains) == OZ_OK &&
           r.overlap < OZ_RESOLUTION_ENOUGH * r.digit && walls_are_fine(scene);
}

static OzStatus find_finest(OzResolution *resolution, const OzScene *scene, const OzGrains *grains)
{
    OZ_PASS(find(resolution, scene, grains));
    if (resolution->overlap < OZ_RESOLUTION_ENOUGH * resolution->digit && walls_are_fine(scene)) {
        resolution->digit /= finer;
    }
    return OZ_OK;
}

static const char *overlap_name(const OzResolution *r)
{
    return r->rests ? "a grain at rest" : "hits at the speeds of the start";
}

OzStatus oz_resolution_print(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    OzResolution r;
    if (scene->precision != OZ_PRECISION_FLOAT) {
        return OZ_OK;
    }
    OZ_PASS(find_finest(&r, scene, grains));
    fprintf(file, "  resolution       float tells overlaps of %.3g m apart", r.digit);
    if (isfinite(r.overlap)) {
        fprintf(file, "; %s: %.3g m, %.3g of these", overlap_name(&r), r.overlap,
                r.overlap / r.digit);
    }
    fputc('\n', file);
    if (isfinite(r.gain)) {
        fprintf(file,
                "                   speeds up to %.3g m/s, told apart by %.2g; gravity adds %.3g "
                "of these "
                "in a step\n",
                r.speed, r.speed_digit, r.gain / r.speed_digit);
    }
    return OZ_OK;
}

/* What float makes of a scene, in words; false where it has digits enough. */
static bool describe(char *text, size_t size, const OzResolution *r, double least, double gain)
{
    if (r->overlap < least * r->digit) {
        snprintf(text, size,
                 "the overlap of %s is %.3g m, %.3g times what float tells apart (%.3g m)",
                 overlap_name(r), r->overlap, r->overlap / r->digit, r->digit);
        return true;
    }
    if (r->gain < gain * r->speed_digit) {
        snprintf(
            text, size,
            "gravity adds %.3g m/s in a step to speeds of up to %.3g m/s, %.3g times what float "
            "tells apart",
            r->gain, r->speed, r->gain / r->speed_digit);
        return true;
    }
    return false;
}

OzStatus oz_resolution_judge(const OzScene *scene, const OzGrains *grains, bool force)
{
    OzResolution r;
    char text[256];
    if (scene->precision != OZ_PRECISION_FLOAT || grains->count == 0) {
        return OZ_OK;
    }
    OZ_PASS(find_finest(&r, scene, grains));
    if (describe(text, sizeof text, &r, OZ_RESOLUTION_LEAST, OZ_RESOLUTION_GAIN_LEAST) && !force) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: precision: float cannot hold this scene: %s; expected "
                              "precision: double, softer contacts, or --force",
                              scene->path, text);
    } else if (describe(text, sizeof text, &r, OZ_RESOLUTION_ENOUGH, OZ_RESOLUTION_GAIN_ENOUGH)) {
        oz_log_line("warning: precision: float is coarse here: %s; precision: double is not", text);
    }
    return OZ_OK;
}
