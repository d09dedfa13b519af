/* Which scenes a command asks for: the one that was written, or a member for each combination of
 * its sweep's values and each seed of --seeds. Combinations come in the order of the sweep, each
 * with all its seeds. */
#pragma once

#include "cli.h"
#include "model/grains.h"
#include "run/from.h"
#include "run/inputs.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

enum { OZ_MEMBERS_MAX = 100000 }; /* each has a folder of its own */

typedef struct OzMembers {
    const OzOptions *options; /* borrowed                                        */
    OzScene scene;            /* as written, sweep included                      */
    int64_t seed_count;       /* members of each combination                     */
    int64_t count;            /* members                                         */
    bool is_ensemble;         /* --seeds or a sweep: members have folders and names */
    OzFrom from;              /* --from: what members begin with; zeroed: grains are placed */
    OzInputs inputs;          /* files that its scenes were read from and read   */
} OzMembers;

/* Reads the scene of options->paths[0] and whether each combination of its sweep can be loaded.
 * The caller frees with oz_members_free (zeroed is fine). */
OzStatus oz_members_create(OzMembers *plan, const OzOptions *options);
void oz_members_free(OzMembers *plan);

/* The grains of a scene at its start: placed, and moved apart where settle.overlaps says so. The
 * caller frees them, also on failure. */
OzStatus oz_members_place(OzGrains *grains, const OzScene *scene);

/* Refuses a step at which a contact of the scene grows by itself, or warns in the log with force.
 */
OzStatus oz_members_judge_step(const OzScene *scene, const OzGrains *grains, bool force);

/* Refuses a step at which a contact of the scene grows by itself and a start that is not sound
 * (sim/start.h), or warns in the log with force. */
OzStatus oz_members_judge(const OzScene *scene, const OzGrains *grains, bool force);

/* Member i's scene, without a sweep, and its grains at the start. Refuses as oz_members_judge
 * does, unless --force. The caller frees both, also on failure. */
OzStatus oz_members_load(const OzMembers *plan, int64_t i, OzScene *scene, OzGrains *grains);

/* The values that member i has of the swept keys, as written, with commas between where there are
 * several (scene.sweep.key is their head in a table); NULL without a sweep. */
const char *oz_members_value(const OzMembers *plan, int64_t i);

uint64_t oz_members_seed(const OzMembers *plan, int64_t i);

/* Its folder's name: every swept key and its value, and the seed, as in friction_0.2_seed_00003;
 * empty for a plain run. The caller frees. */
OzStatus oz_members_name(const OzMembers *plan, int64_t i, char **name);
