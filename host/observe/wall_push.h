/* The force of all grains on each wall and its torque about the wall's point, as a row of
 * series.csv has them: at its moment, or as means over the time since the row before, which follow
 * from the impulses of both (model/snapshot.h). */
#pragma once

#include "base/state.h"
#include "model/snapshot.h"

/* Zeroed is empty. */
typedef struct OzWallPush {
    OzObserveWalls kind;
    int count;
    bool is_known;        /* false where the row has no such cells: without contacts, or of means
                             in the first row                                                   */
    double (*force)[3];   /* N, of each wall of the scene                                       */
    double (*torque)[3];  /* N m, about the point, which moves with the wall                    */
    double (*point)[3];   /* m                                                                  */
    double (*impulse)[6]; /* of the row before                                                  */
    double since;         /* s, its time; NAN: there is none                                    */
} OzWallPush;

/* As the scene asks now; what it asked for before goes on. Frees with oz_wall_push_free. */
OzStatus oz_wall_push_take(OzWallPush *push, const OzScene *scene);
void oz_wall_push_free(OzWallPush *push);

/* Finds force and torque for a row at this state; means count on from here. */
void oz_wall_push_see(OzWallPush *push, const OzSnapshot *now);

/* Saves or loads (base/state.h) what the next means count from. */
OzStatus oz_wall_push_state(OzWallPush *push, OzStateVisit *visit);
