/* The names of choices, for the rows of the list of scene keys alone. FLAT_ ones are those of
 * trigrains where they differ from those of rods. */
#pragma once

#include "scene/scene_types.h"

/* Named choices, in the order of their enums; "": not for this model. */
static const char *const MODELS[] = {
    [OZ_MODEL_RODS] = "rods", [OZ_MODEL_TRIGRAINS] = "trigrains", NULL};
#define OZ_CHOICES_SOLID(NAME, name, choice, flat_choice, share, first) choice,
#define OZ_CHOICES_BOTH(NAME, name, choice, flat_choice, share, first)  flat_choice,
#define OZ_CHOICES_FLAT(NAME, choice)                                   choice,
static const char *const INTEGRATORS[] = {OZ_INTEGRATORS(OZ_CHOICES_SOLID) NULL};
static const char *const FLAT_INTEGRATORS[] = {OZ_INTEGRATORS(OZ_CHOICES_BOTH)
                                                   OZ_TRIGRAINS_INTEGRATORS(OZ_CHOICES_FLAT) NULL};
static const char *const PRECISIONS[] = {
    [OZ_PRECISION_FLOAT] = "float", [OZ_PRECISION_DOUBLE] = "double", NULL};
static const char *const BROADPHASES[] = {[OZ_BROADPHASE_HASH] = "hash",
                                          [OZ_BROADPHASE_ALL_PAIRS] = "all_pairs",
                                          [OZ_BROADPHASE_SORT_AXIS] = "sort_axis",
                                          NULL};
static const char *const FLAT_BROADPHASES[] = {
    [OZ_BROADPHASE_HASH] = "hash", [OZ_BROADPHASE_ALL_PAIRS] = "all_pairs", NULL};
#define OZ_CHOICES_LAW(NAME, name, choice, linear, stiffness, damping) choice,
static const char *const LAWS[] = {OZ_LAWS(OZ_CHOICES_LAW) NULL};
/* Of discs: kernels/disc.h knows these two. */
static const char *const FLAT_LAWS[] = {[OZ_LAW_HOOKE] = "hooke", [OZ_LAW_HERTZ] = "hertz", NULL};
static const char *const OVERLAPS[] = {
    [OZ_OVERLAPS_KEEP] = "keep", [OZ_OVERLAPS_REMOVE] = "remove", NULL};
static const char *const ROLLINGS[] = {
    [OZ_ROLLING_RESISTS_BY_SPRING] = "spring", [OZ_ROLLING_RESISTS_CONSTANTLY] = "constant", NULL};
static const char *const SLIPS[] = {[OZ_SLIP_CUT] = "cut", [OZ_SLIP_SCALE] = "scale", NULL};
static const char *const ATTRACTIONS[] = {
    [OZ_ATTRACTION_ALLOW] = "allow", [OZ_ATTRACTION_CLAMP] = "clamp", NULL};
static const char *const DAMPINGS[] = {
    [OZ_DAMPING_CONSTANT] = "constant", [OZ_DAMPING_SMOOTH] = "smooth", NULL};
static const char *const PARALLELS[] = {
    [OZ_PARALLEL_SINGLE] = "single", [OZ_PARALLEL_LINE] = "line", NULL};
static const char *const CONTACT_POINTS[] = {
    [OZ_POINT_MIDPOINT] = "midpoint", [OZ_POINT_SURFACES] = "surfaces", NULL};
static const char *const RESTITUTIONS_AT[] = {
    [OZ_RESTITUTION_CENTRE] = "centre", [OZ_RESTITUTION_CONTACT] = "contact", NULL};
static const char *const CALIBRATIONS[] = {
    [OZ_CALIBRATION_NONE] = "none", [OZ_CALIBRATION_DISCRETE] = "discrete", NULL};
#define OZ_CHOICES_WALL(NAME, name, choice, fine, edged)    choice,
#define OZ_CHOICES_NO_WALL(NAME, name, choice, fine, edged) "",
#define OZ_CHOICES_COMPOUND(NAME, name, choice)             choice,
#define OZ_CHOICES_NO_COMPOUND(NAME, name, choice)          "",
#define OZ_CHOICES_FLAT_WALL(NAME, name, choice, rank)      choice,
static const char *const WALL_KINDS[] = {OZ_WALLS(OZ_CHOICES_WALL)
                                             OZ_COMPOUND_WALLS(OZ_CHOICES_COMPOUND) NULL};
static const char *const ENDS[] = {[OZ_ENDS_OPEN] = "open", [OZ_ENDS_CLOSED] = "closed", NULL};
static const char *const WALL_SIDES[] = {
    [OZ_SIDE_INSIDE] = "inside", [OZ_SIDE_OUTSIDE] = "outside", NULL};
static const char *const FLAT_WALL_KINDS[] = {OZ_WALLS(OZ_CHOICES_NO_WALL) OZ_COMPOUND_WALLS(
    OZ_CHOICES_NO_COMPOUND) OZ_TRIGRAINS_WALLS(OZ_CHOICES_FLAT_WALL) NULL};
static const char *const BOUNDARIES[] = {
    [OZ_BOUNDARY_OPEN] = "open", [OZ_BOUNDARY_PERIODIC] = "periodic", NULL};
static const char *const GRAIN_KINDS[] = {[OZ_GRAINS_RANDOM] = "random",
                                          [OZ_GRAINS_LATTICE] = "lattice",
                                          [OZ_GRAINS_SINGLE] = "single",
                                          [OZ_GRAINS_FILE] = "file",
                                          NULL};
static const char *const FLAT_GRAIN_KINDS[] = {[OZ_GRAINS_RANDOM] = "random",
                                               [OZ_GRAINS_LATTICE] = "lattice",
                                               [OZ_GRAINS_SINGLE] = "single",
                                               NULL};
#define OZ_CHOICES_SHAPE(NAME, name, choice) choice,
static const char *const SHAPES[] = {OZ_SHAPES(OZ_CHOICES_SHAPE) NULL};
#define OZ_CHOICES_EXPORT(NAME, name, choice) choice,
static const char *const EXPORTS[] = {OZ_EXPORTS(OZ_CHOICES_EXPORT) NULL};
static const char *const FORCE_POINTS[] = {
    [OZ_FORCE_CENTROID] = "centroid", [OZ_FORCE_MIDPOINT] = "midpoint", NULL};
static const char *const OVERLAP_FORCES[] = {
    [OZ_OVERLAP_KINDS] = "kinds", [OZ_OVERLAP_FIELD] = "field", NULL};
static const char *const DAMPING_SHEARS[] = {
    [OZ_SHEAR_NONE] = "none", [OZ_SHEAR_BALANCED] = "balanced", NULL};
static const char *const STRENGTH_CRITERIA[] = {[OZ_STRENGTH_SEPARATE] = "separate",
                                                [OZ_STRENGTH_LINEAR] = "linear",
                                                [OZ_STRENGTH_QUADRATIC] = "quadratic",
                                                NULL};
static const char *const OBSERVE_AT[] = {
    [OZ_OBSERVE_MEAN] = "mean", [OZ_OBSERVE_TOP] = "top", [OZ_OBSERVE_BOTTOM] = "bottom", NULL};
static const char *const OBSERVE_WALLS[] = {[OZ_OBSERVE_WALLS_NONE] = "false",
                                            [OZ_OBSERVE_WALLS_MEAN] = "mean",
                                            [OZ_OBSERVE_WALLS_INSTANT] = "instant",
                                            NULL};
static const char *const MEASURED[] = {
    [OZ_MEASURED_OFFSET] = "offset", [OZ_MEASURED_ACCELERATION] = "acceleration", NULL};
static const char *const FLAT_VIEWS[] = {[OZ_VIEW_LATERAL] = "lateral", NULL};
static const char *const VIEWS[] = {[OZ_VIEW_LATERAL] = "lateral",
                                    [OZ_VIEW_CUT] = "cut",
                                    [OZ_VIEW_TOP] = "top",
                                    [OZ_VIEW_FREE] = "free",
                                    NULL};
static const char *const STYLES[] = {
    [OZ_STYLE_SCREEN] = "screen", [OZ_STYLE_PAPER] = "paper", NULL};
static const char *const COLOURS[] = {[OZ_COLOUR_ANGLE] = "angle",
                                      [OZ_COLOUR_AZIMUTH] = "azimuth",
                                      [OZ_COLOUR_SPEED] = "speed",
                                      [OZ_COLOUR_TYPE] = "type",
                                      "",
                                      "",
                                      [OZ_COLOUR_ORDER] = "order",
                                      [OZ_COLOUR_FORCE] = "force",
                                      [OZ_COLOUR_COORDINATION] = "coordination",
                                      [OZ_COLOUR_MATERIAL] = "material",
                                      NULL};
static const char *const FLAT_COLOURS[] = {[OZ_COLOUR_ANGLE] = "angle",
                                           "",
                                           [OZ_COLOUR_SPEED] = "speed",
                                           [OZ_COLOUR_TYPE] = "type",
                                           [OZ_COLOUR_GREY] = "grey",
                                           [OZ_COLOUR_TURNED] = "turned",
                                           "",
                                           [OZ_COLOUR_FORCE] = "force",
                                           [OZ_COLOUR_COORDINATION] = "coordination",
                                           "",
                                           NULL};
