/* A model as a value: all that the driver (sim/sim.h and what it is made of) asks of one, be it
 * rods or trigrains. THE list of models is in sim/models.c. Switches, sizes, parameters and
 * control words are structs of the model's own, handed about as void pointers; they begin with the
 * words of kernels/head.h, which are all that the driver looks at. */
#pragma once

#define OZ_HOST
#include "base/state.h"
#include "compute/device.h"
#include "kernels/head.h"
#include "model/grains.h"
#include "model/snapshot.h"
#include "sim/sim.h"

#include <stdbool.h>

typedef struct OzArrays OzArrays;

/* A switch of the kernels, -D OZ_<name>=<value>. */
typedef struct OzSwitch {
    const char *name;
    const char *left_out; /* what is saved without it; NULL: not a feature that can be missing */
} OzSwitch;

/* What every model's switches begin with: is_double becomes -D OZ_DOUBLE=1, the others are the
 * first rows of its list. */
typedef struct __attribute__((may_alias)) OzSwitchesHead {
    int is_double;
    int lanes, group, ledger, resort, host_lists;
} OzSwitchesHead;

/* What a field's words are to the next step. STATE: it depends on them; SPRING: it does too, they
 * are the tangential memory of contacts, where it outlives the neighbour lists; LIST: part of the
 * lists, or springs on their way in them, made anew from the others; ROWS: the same, a row of each
 * region, which outlives larger capacities (those of SPRING do too); SCRATCH: written before they
 * are read, by the host for each launch or by the kernels in each step. */
typedef enum OzFieldClass {
    OZ_FIELD_STATE,
    OZ_FIELD_SPRING,
    OZ_FIELD_LIST,
    OZ_FIELD_ROWS,
    OZ_FIELD_SCRATCH
} OzFieldClass;

/* Words of one of a field's elements. */
typedef enum OzFieldWidth {
    OZ_WIDTH_ONE,
    OZ_WIDTH_LANES,
    OZ_WIDTH_PARAMETERS, /* all of a member's */
    OZ_WIDTH_CONTROL
} OzFieldWidth;

/* kind: of its words in single precision; widens: they are doubles in double precision. */
typedef struct OzField {
    const char *name;
    OzFieldClass class;
    OzStateKind kind;
    bool widens;
    OzFieldWidth width;
} OzField;

/* Each kind of element of the kernels' list. */
#define OZ_FIELD_KIND_parameters     OZ_STATE_FLOAT, true, OZ_WIDTH_PARAMETERS
#define OZ_FIELD_KIND_control        OZ_STATE_INT32, false, OZ_WIDTH_CONTROL
#define OZ_FIELD_KIND_scalar         OZ_STATE_FLOAT, true, OZ_WIDTH_ONE
#define OZ_FIELD_KIND_real           OZ_STATE_FLOAT, true, OZ_WIDTH_LANES
#define OZ_FIELD_KIND_fixed_position OZ_STATE_INT32, true, OZ_WIDTH_ONE
#define OZ_FIELD_KIND_integer        OZ_STATE_INT32, false, OZ_WIDTH_ONE
#define OZ_FIELD_KIND_ledger         OZ_STATE_DOUBLE, false, OZ_WIDTH_ONE
#define OZ_FIELD_KIND_wide           OZ_STATE_DOUBLE, true, OZ_WIDTH_ONE

/* A guard's bit and what it says. */
typedef struct OzStop {
    int bit;
    const char *words;
} OzStop;

/* How often a part is done: in every step, or when the inner or the outer list is made anew. */
typedef enum OzTimedRate { OZ_TIMED_STEP, OZ_TIMED_REFRESH, OZ_TIMED_REBUILD } OzTimedRate;

/* A part of a model's step. kernel: does it as often as its last argument says; less: the stage
 * whose kernel's time is taken off, OZ_TIMED_NONE without one; bare: in a program without walls. */
typedef struct OzTimedStage {
    const char *name, *kernel;
    OzTimedRate rate;
    int less;
    bool bare;
    const char *how; /* in words, for the table */
} OzTimedStage;

enum { OZ_TIMED_NONE = -1, OZ_TIMED_MOST = 8 };

typedef struct OzModel {
    const char *name;

    /* The device's arrays in the order of the kernels' arguments; elements of one member's stretch,
     * 0 where the scene does not need it. */
    int field_count, control_field;
    const OzField *fields;
    size_t (*field_items)(int field, const void *switches, const void *sizes);

    /* What memory is told for each of (`orzo check`): "grain", and how many there are. */
    const char *body;
    int64_t (*body_count)(const OzGrains *grains);

    size_t switches_bytes, sizes_bytes, parameters_bytes, control_bytes;

    /* What a scene needs of the kernels. more_left_out (may be NULL) prints what else its switches
     * leave out, after the separator. */
    int switch_count;
    const OzSwitch *switches;
    void (*derive)(void *switches, const OzScene *scene, const OzGrains *grains,
                   const OzDevice *device);
    void (*more_left_out)(const void *switches, const char *separator, FILE *file);
    const char *program;

    /* Constants of a scene, in double and SI, in the units of running parameters where there are
     * such (else NULL): it can be called again at any time; sizes that a member needs, and what
     * follows from them in the parameters; sizes that serve another member too. */
    OzStatus (*fill)(void *parameters, const OzScene *scene, const OzGrains *grains,
                     const void *running);
    OzStatus (*choose)(void *sizes, void *parameters, const OzScene *scene, const OzGrains *grains,
                       const void *switches);
    void (*join)(void *sizes, const void *other);

    /* Whether scenes of the same switches, step and settling can share launches; what all members
     * must have alike, in words. */
    bool (*fits)(const OzMember *a, const OzMember *b, const void *switches);
    const char *alike;

    /* The model's own part of a simulation, sim->own: makes it, with what kernels of sim->program
     * the driver has not; uploads every member's start and makes the kernels' first records; frees
     * it, half-made too. */
    OzStatus (*open)(OzSim *sim);
    OzStatus (*start)(OzSim *sim);
    void (*close)(OzSim *sim);

    /* A launch. prime (may be NULL): what must come before the first. steps_alike (may be NULL):
     * how many of these steps a member can make before what is written for a launch changes.
     * prepare: writes walls' motion and what else a member's next steps need. supply (may be NULL):
     * what members that are not through wait for. mend (may be NULL): a member that has stopped
     * for something after which it can go on is made to. */
    OzStatus (*write_parameters)(OzSim *sim, int member);
    OzStatus (*prime)(OzSim *sim);
    int64_t (*steps_alike)(const OzSim *sim, int member, int64_t steps);
    OzStatus (*prepare)(OzSim *sim, int member, int steps);
    OzStatus (*supply)(OzSim *sim);
    OzStatus (*mend)(OzSim *sim, int member);

    /* What the model's own part holds of the state, saved or loaded (may be NULL). */
    OzStatus (*state)(OzSim *sim, OzStateVisit *visit);

    /* For a simulation that goes on from another one, or from itself, with other parameters: puts
     * into the arrays what they hold otherwise under these (NULL: nothing is). `from` made steps of
     * this length, s. */
    OzStatus (*adopt)(OzSim *sim, const OzSim *from, int member, double step);

    /* A member's state now, walls included; its contacts and, with the ledger on, its energies,
     * unless a guard has stopped it. */
    OzStatus (*unpack)(OzSim *sim, int member, OzSnapshot *snapshot);
    OzStatus (*contacts)(OzSim *sim, int member, OzSnapshot *snapshot);

    /* Between launches: what pushes and turns every grain from outside from now on, N and N m in
     * the frame of the scene, 3 a grain each. NULL: the model has no place for it. */
    OzStatus (*push)(OzSim *sim, int member, const double *force, const double *torque);

    /* Settling: kinetic energy, of motion and of rotation, J; steps between looks at it, often
     * enough to stop in time, rarely enough to cost nothing. */
    double (*energy)(const OzSnapshot *now);
    int judge_steps;

    /* The parts of a step (sim/stage_timing.h) and the program of their kernels; how often what is
     * repeated may be before it has gone too far. stand_still (may be NULL): a step of no length;
     * leave_out_walls (NULL: no stage is bare) of these switches. */
    int stage_count, contact_stage; /* contacts of all kinds */
    const OzTimedStage *stages;
    const char *stage_program;
    int repeats_most;
    OzStatus (*stand_still)(OzSim *sim);
    void (*leave_out_walls)(void *switches);

    /* The ledger (kernels/ledger_entries.h): its field, rows of so many doubles; what else a member
     * must note when it starts empty (may be NULL). */
    int ledger_field, ledger_words;
    OzStatus (*start_ledger)(OzSim *sim, int member);

    /* Guards, in the order in which they are told; the grain of an index in the control words, -1
     * if there is none; what would help. */
    int stop_count;
    const OzStop *stops;
    int (*grain_of)(const OzGrains *grains, int index);
    void (*advise)(char *text, size_t size, const OzControlHead *control, const OzSnapshot *now);
} OzModel;

/* Whether a field adds up what has happened. Such a one, and what pushes grains from outside, and a
 * piston that stands where it was built, begins empty where no state has it. */
bool oz_model_field_sums(const OzField *field);
bool oz_model_field_begins_empty(const OzField *field);

/* What a field's words are in this precision; bytes of one member's stretch. */
OzStateKind oz_model_field_kind(const OzField *field, bool is_double);
size_t oz_model_field_bytes(const OzModel *model, int field, const void *switches,
                            const void *sizes);

/* "-DOZ_LANES=16 -DOZ_GROUP=1 ..." */
void oz_model_options(const OzModel *model, const void *switches, char *text, size_t size);

/* Prints the switches, and the features left out. */
void oz_model_print_switches(const OzModel *model, const void *switches, FILE *file);

/* Derives switches and fills parameters (as fill does) and sizes for one scene; the caller frees
 * all three with oz_model_layout_free, after a failure too. */
typedef struct OzModelLayout {
    void *switches, *parameters, *sizes;
} OzModelLayout;

OzStatus oz_model_layout(OzModelLayout *layout, const OzModel *model, const OzMember *member,
                         const OzDevice *device, const void *running);
void oz_model_layout_free(OzModelLayout *layout);
