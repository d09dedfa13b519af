/* What a run begins from instead of grains that are placed: states that another run left (`orzo run
 * SCENE --from DIR`), of which its folder keeps a copy. */
#pragma once

#include "run/from_types.h"
#include "run/inputs.h"
#include "run/worker_types.h"

/* asked: "DIR", its newest states, or "DIR@tap=N", "DIR@time=T", those that were kept
 * (checkpoint.taps). DIR is a run's folder, or a member's in an ensemble's. Files are added to
 * inputs. Refuses by name what is not there; says which moments are. The caller frees, also on
 * failure. */
OzStatus oz_from_open(OzFrom *from, const char *asked, OzInputs *inputs);
void oz_from_free(OzFrom *from);

/* The member with which one of this name and seed begins: the only one, or that of the same name,
 * or that of an ensemble's member of the same seed. Refuses with OZ_ERR_INPUT when there is none.
 * Borrowed until the next call. */
OzStatus oz_from_find(OzFrom *from, const char *name, uint64_t seed, const OzFromMember **found);

/* Whether all members begin with the same one. */
bool oz_from_is_single(const OzFrom *from);

/* Refuses a scene and its grains, of this name, that cannot begin there (run/from_check.h). */
OzStatus oz_from_check(OzFrom *from, const char *name, const OzScene *scene,
                       const OzGrains *grains);

/* Opened workers' members begin there, and their folders say so (run/from_keep.h). Without a state
 * they are left alone. */
OzStatus oz_from_begin(OzFrom *from, OzWorker *workers, int count);
