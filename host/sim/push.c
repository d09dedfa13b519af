/* Handing on what acts from outside. */
#include "sim/push.h"

#include "model/motion.h"
#include "sim/models.h"
#include "sim/sim_private.h"

OzStatus oz_push_check(const OzScene *scene)
{
    return oz_models_of(scene)->push
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INPUT,
                                "%s: forces from outside on grains of model %s; expected model: "
                                "rods (spheres, too)",
                                scene->path, oz_models_of(scene)->name);
}

OzStatus oz_push_grains(OzSim *sim, int member, const double *force, const double *torque)
{
    return sim->model->push(sim, member, force, torque);
}

void oz_push_wall(OzSim *sim, int member, int wall, double speed)
{
    oz_motion_drive(&sim->batch.scenes[member].walls[wall].motion, oz_sim_time(sim), speed);
}
