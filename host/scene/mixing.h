/* What bodies of materials do to each other: what `pairs` says of them, and the rest mixed, by one
 * set of rules for grains among themselves and at walls.
 *   Two bodies that touch are springs in series: each bears the whole force and holds a share of
 * the energy, as its compliance is a share of both. With hertz-mindlin 1/E* is the sum of (1 -
 * nu^2)/E, 1/G* that of (2 - nu)/G (Johnson 1985, sec. 4.2 and 7.2). With hooke, k_n goes with
 * 1/contact_time^2: the square of a pair's contact time is the mean of both squares; with hertz the
 * inverse of its stiffness is the mean of both inverses. Restitution: each body gives back e^2 of
 * the energy it held, so the square of a pair's is the mean of both squares, weighted by compliance
 * (after Coaplen, Stronge & Ravani 2004, Int. J. Impact Eng. 30, 581): the softer body decides.
 *   Work of adhesion: the geometric mean (Girifalco & Good 1957, J. Phys. Chem. 61, 904). Friction,
 * of rolling and twisting too, has no law of nature; it goes by the geometric mean as well: what is
 * slippery is so on anything. Ratios and rates of damping: the arithmetic mean. */
#pragma once

#include "scene/scene_types.h"

/* How many materials grains are of: 1 where none is named. */
int oz_mixing_count(const OzScene *scene);

/* Which of these a population is of. */
int oz_mixing_kind(const OzScene *scene, int population);

/* The place of a population's material in the scene's list, from 0; -1: it names none. */
int oz_mixing_material(const OzScene *scene, int population);

/* The name of one, and of a wall's; "" where none is named. */
const char *oz_mixing_name(const OzScene *scene, int kind);
const char *oz_mixing_wall_name(const OzScene *scene, int wall);

/* Contact values of grains of two kinds, the same either way round, and of grains of a kind at a
 * wall. */
void oz_mixing_grains(OzContactValues *values, const OzScene *scene, int one, int other);
void oz_mixing_wall(OzContactValues *values, const OzScene *scene, int wall, int kind);

/* One kind of contact of a scene. */
typedef struct OzMixed {
    int wall;       /* -1: of two grains                       */
    int one, other; /* kinds of these; at a wall of the grain  */
    OzContactValues values;
} OzMixed;

/* How many there are, and the i-th: grains of each two kinds, then each wall with each kind. */
int oz_mixing_contacts(const OzScene *scene);
void oz_mixing_contact(OzMixed *mixed, const OzScene *scene, int i);

/* Whether an entry of pairs is of two materials, either way round; the entry that is of two
 * (numbers from 1), or NULL. */
bool oz_mixing_joins(const OzMaterialPair *pair, const char *one, const char *other);
const OzMaterialPair *oz_mixing_pair(const OzScene *scene, int one, int other);

/* Fills in scene->contact and those of walls from what was written, once materials have kinds. */
void oz_mixing_resolve(OzScene *scene);

/* A warning in the log for each material that nothing is of. */
void oz_mixing_say(const OzScene *scene);
