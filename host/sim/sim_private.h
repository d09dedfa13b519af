/* What the files of the simulation share among themselves. */
#pragma once

#include "sim/arrays.h"
#include "sim/batch.h"
#include "sim/large.h"
#include "sim/model.h"

struct OzSim {
    const OzDevice *device; /* borrowed */
    const OzModel *model;
    OzBatch batch;
    void *parameters; /* one a member, the model's struct, in double                          */
    void *control;    /* one a member, the model's struct, as last read or to be written next */
    cl_program program;
    cl_kernel advance; /* many steps, one work-group a member; NULL: a large scene */
    OzLarge *large;    /* of a large scene                                         */
    OzArrays arrays;
    bool is_empty; /* there is nothing that moves */
    void *own;     /* the model's own part        */
};

/* What all models' parameters and control words of a member begin with. */
static inline OzParametersHead *oz_sim_parameters(const OzSim *sim, int member)
{
    return (void *)((char *)sim->parameters + (size_t)member * sim->model->parameters_bytes);
}

static inline OzControlHead *oz_sim_control(const OzSim *sim, int member)
{
    return (void *)((char *)sim->control + (size_t)member * sim->model->control_bytes);
}

/* As oz_sim_create, for scenes of the same grains that shall go on from those of a running
 * simulation (NULL: none), in whose units it counts; its state has still to be moved. */
OzStatus oz_sim_create_after(OzSim **sim, const OzDevice *device, const OzMember *members,
                             int member_count, const char *source_dir, const OzSim *running);

/* Uploads all members' parameters. */
OzStatus oz_sim_write_parameters(OzSim *sim);

/* What the driver keeps for a model, as what it is: its own part, switches and sizes of a
 * simulation, control words and parameters of a member. */
#define OZ_SIM_VIEWS(prefix, Own, Switches, Sizes, Control, Parameters)                            \
    static inline Own *prefix##_own(const OzSim *sim)                                              \
    {                                                                                              \
        return sim->own;                                                                           \
    }                                                                                              \
    static inline const Switches *prefix##_switches(const OzSim *sim)                              \
    {                                                                                              \
        return sim->arrays.switches;                                                               \
    }                                                                                              \
    static inline const Sizes *prefix##_sizes(const OzSim *sim)                                    \
    {                                                                                              \
        return sim->arrays.sizes;                                                                  \
    }                                                                                              \
    static inline Control *prefix##_control(const OzSim *sim, int member)                          \
    {                                                                                              \
        return (Control *)sim->control + member;                                                   \
    }                                                                                              \
    static inline Parameters *prefix##_parameters(const OzSim *sim, int member)                    \
    {                                                                                              \
        return (Parameters *)sim->parameters + member;                                             \
    }
