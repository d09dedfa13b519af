/* What a run begins from instead of grains that are placed: the state that another run left
 * (`orzo run SCENE --from DIR`). */
#pragma once

#include "model/grains.h"
#include "run/checkpoint.h"
#include "run/inputs.h"
#include "run/worker.h"

/* Zeroed is valid: none. */
typedef struct OzFrom {
    char *path; /* of the state's file; NULL: none; owned */
    OzState state;
    OzCheckpointHead head;
    OzScene scene;   /* of that run               */
    OzGrains grains; /* its grains as they were placed; their geometry holds */
} OzFrom;

/* asked: "DIR", its newest state, or "DIR@tap=N", "DIR@time=T", one that was kept
 * (checkpoint.taps). Its files are added to inputs. Refuses by name what is not there; says which
 * moments are. The caller frees, also on failure. */
OzStatus oz_from_open(OzFrom *from, const char *asked, OzInputs *inputs);
void oz_from_free(OzFrom *from);

/* Refuses a scene and its grains that cannot begin there: other grains, another step, a wall that
 * would jump, or one of trigrains that is another. */
OzStatus oz_from_check(const OzFrom *from, const OzScene *scene, const OzGrains *grains);

/* Opened workers' members begin there; without a state they are left alone. */
OzStatus oz_from_begin(const OzFrom *from, OzWorker *workers, int count);
