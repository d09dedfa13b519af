/* liborzo: simulations of grains inside other programs, from C or C++.
 *
 *     OrzoSim *sim = NULL;
 *     if (orzo_open(&sim, "bed.yaml") != ORZO_OK || orzo_run_to(sim, 0.5) != ORZO_OK) {
 *         fprintf(stderr, "%s\n", orzo_error());
 *     }
 *     double *place = malloc(3 * sizeof *place * (size_t)orzo_count(sim));
 *     orzo_read(sim, ORZO_POSITION, place, 3 * orzo_count(sim));
 *     orzo_close(sim);
 *
 * A scene is what `orzo run` takes; grains at a time are the same to the bit as in that program.
 * Everything is in SI units. Arrays are the caller's, one value after the other, by the number of
 * the grain, which is the scene's order.
 *
 * Every call that can fail returns a status; orzo_error says in words what happened and what was
 * expected. No call ends the process, handles a signal or prints. Simulations of one process are
 * independent of each other: each may be in a thread of its own, one thread at a time. */
#ifndef ORZO_H
#define ORZO_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of this header; orzo_version tells the library's. While MAJOR is 0, another MINOR may change what
 * calls mean. */
#define ORZO_VERSION_MAJOR 0
#define ORZO_VERSION_MINOR 1
#define ORZO_VERSION_PATCH 0

#define ORZO_API __attribute__((visibility("default")))

/* Nothing but ORZO_OK, which is 0, means success. */
typedef enum OrzoStatus {
    ORZO_OK = 0,
    ORZO_ERR_INPUT,      /* a scene, a key, a name, a size is wrong                        */
    ORZO_ERR_MEMORY,     /* the host's memory ran out                                      */
    ORZO_ERR_FILE,       /* a file could not be read or written                            */
    ORZO_ERR_DEVICE,     /* OpenCL: no device, it refused, a build failed                  */
    ORZO_ERR_BLOWUP,     /* a guard stopped it: not a number, escaped, too deep an overlap */
    ORZO_ERR_GRAPHICS,   /* nothing to draw with                                           */
    ORZO_ERR_MOVIE,      /* of the program alone                                           */
    ORZO_ERR_INTERRUPTED /* of the program alone                                           */
} OrzoStatus;

typedef struct OrzoSim OrzoSim;

/* "0.1.0". */
ORZO_API const char *orzo_version(void);

/* Why this thread's last call failed. Valid until its next failure; "" before the first. */
ORZO_API const char *orzo_error(void);

/* Reads the scene file; nothing is placed or built yet. The caller closes it with orzo_close. On
 * failure *sim is NULL and orzo_error has a line for each error: file:line: what is wrong; what was
 * expected. */
ORZO_API OrzoStatus orzo_open(OrzoSim **sim, const char *path);

/* The same of a text; files that it names are relative to the working folder. */
ORZO_API OrzoStatus orzo_open_text(OrzoSim **sim, const char *text);

/* Ends it; NULL is fine. */
ORZO_API void orzo_close(OrzoSim *sim);

/* Sets a key of the scene to a value as in a scene file: ("contact.friction", "0.3"); NULL takes
 * the key out. Before orzo_start it is a setting like --set; after it the running simulation
 * changes, as by `orzo run --watch`: a shaken wall at its next zero crossing, some keys after new
 * kernels were built (seconds). What is refused changes nothing. */
ORZO_API OrzoStatus orzo_set(OrzoSim *sim, const char *key, const char *value);

/* Before orzo_start: the device as `--device` takes it (NULL: chosen), and if threads > 0 how many
 * a CPU device has: it holds for the process and must come before its first start. */
ORZO_API OrzoStatus orzo_set_device(OrzoSim *sim, const char *device, int threads);

/* Before orzo_start: what the program would say goes to this file as lines; without, nowhere. */
ORZO_API OrzoStatus orzo_set_log(OrzoSim *sim, const char *path);

/* Places the grains, opens the device, builds kernels (seconds, the first time on a machine), and
 * lets grains come to rest as scene.settle says: time is 0 afterwards. Called by whatever needs it;
 * a second time it does nothing. */
ORZO_API OrzoStatus orzo_start(OrzoSim *sim);

/* On to the step that is nearest to this time, s; times that have passed are no failure and make no
 * steps. Refuses times beyond the scene's end. After ORZO_ERR_BLOWUP the state can still be read.
 */
ORZO_API OrzoStatus orzo_run_to(OrzoSim *sim, double time);

/* So many steps further. */
ORZO_API OrzoStatus orzo_run_steps(OrzoSim *sim, int64_t steps);

/* Time (s) and steps since time 0; 0 before orzo_start. */
ORZO_API double orzo_time(const OrzoSim *sim);
ORZO_API int64_t orzo_step(const OrzoSim *sim);

/* The scene's step and end, s (INFINITY: none), and a period of its first moving wall, s; 0 without
 * one. */
ORZO_API double orzo_step_length(const OrzoSim *sim);
ORZO_API double orzo_end(const OrzoSim *sim);
ORZO_API double orzo_period(const OrzoSim *sim);

/* Grains; 0 before orzo_start. With beams.strength it grows when grains break. */
ORZO_API int64_t orzo_count(const OrzoSim *sim);

/* THE list of what can be read of each grain: X(NAME, name, values a grain, unit). Axes are unit
 * vectors along shafts; quaternions (w x y z) turn z into them; angular velocities are in the frame
 * of the scene. Flat grains (trigrains) lie in z = 0 and turn about z. */
#define ORZO_FIELDS(X)                                                                             \
    X(POSITION, position, 3, "m")                                                                  \
    X(AXIS, axis, 3, "1")                                                                          \
    X(QUATERNION, quaternion, 4, "1")                                                              \
    X(VELOCITY, velocity, 3, "m/s")                                                                \
    X(ANGULAR_VELOCITY, angular_velocity, 3, "rad/s")                                              \
    X(DIAMETER, diameter, 1, "m")                                                                  \
    X(LENGTH, length, 1, "m")                                                                      \
    X(MASS, mass, 1, "kg")

#define ORZO_FIELD(NAME, name, width, unit) ORZO_##NAME,
typedef enum OrzoField { ORZO_FIELDS(ORZO_FIELD) ORZO_FIELD_COUNT } OrzoField;
#undef ORZO_FIELD

/* Fills values, room for so many doubles, which must be the grains' times the field's. */
ORZO_API OrzoStatus orzo_read(OrzoSim *sim, OrzoField field, double *values, int64_t room);

/* A contact: forces are those of this state. */
typedef struct OrzoContact {
    int64_t a, b;         /* grains, a < b; b = -1 - i at wall i of the scene            */
    double point[3];      /* m, where the force acts                                     */
    double normal[3];     /* unit vector from a to b                                     */
    double push;          /* N, along the normal; > 0 pushes apart                       */
    double tangential[3]; /* N, the rest of the force, on b; a feels the opposite        */
    double overlap;       /* m; of triangles m^2                                         */
} OrzoContact;

/* *count receives how many there are; the first `room` of them, in the order of a, then b, are
 * written to contacts, which may be NULL if room is 0. */
ORZO_API OrzoStatus orzo_contacts(OrzoSim *sim, OrzoContact *contacts, int64_t room,
                                  int64_t *count);

/* The columns of series.csv that the scene has (`orzo keys --columns`): how many, and the name of
 * one, valid until orzo_set or orzo_close; NULL beyond the last. */
ORZO_API int orzo_column_count(OrzoSim *sim);
ORZO_API const char *orzo_column(OrzoSim *sim, int column);

/* The value of a column now; NAN where its cell would be empty. Tap means are over the samples that
 * a run takes. What counts from the row before (a rate of outflow, a drum's avalanches) counts from
 * the last state that was asked for here or is a row of series.csv. */
ORZO_API OrzoStatus orzo_observe(OrzoSim *sim, const char *column, double *value);

/* All columns; room is their count. */
ORZO_API OrzoStatus orzo_observe_all(OrzoSim *sim, double *values, int room);

/* Where wall i of the scene is along its motion: its offset (m) and velocity (m/s) now. */
ORZO_API OrzoStatus orzo_wall(OrzoSim *sim, int wall, double *offset, double *velocity);

/* From now on these forces (N) and torques (N m; NULL: none) act on `count` grains from outside, 3
 * numbers each in the frame of the scene, until they are set again; grains: their numbers; NULL:
 * the first ones. Those of other grains stay as they are. Rods and spheres only. The first call
 * builds kernels with room for them (seconds). Their work is in no column: energy_residual shows
 * it. They are part of what orzo_save writes. */
ORZO_API OrzoStatus orzo_push(OrzoSim *sim, const int64_t *grains, int64_t count,
                              const double *force, const double *torque);

/* From now on wall i of the scene, which must have a motion there, goes on from where it is at this
 * speed, m/s along its motion's direction (upwards), instead of what the scene says; until it is
 * told again. A controller calls it as often as it likes. */
ORZO_API OrzoStatus orzo_drive_wall(OrzoSim *sim, int wall, double speed);

/* The scene as it is now, every key written out, as the text of a scene file; the caller frees it
 * with orzo_free. */
ORZO_API OrzoStatus orzo_scene(const OrzoSim *sim, char **text);
ORZO_API void orzo_free(void *memory);

/* The size of pictures, pixels (movie.size, in a scene with a movie or one set before orzo_start;
 * else 1280 x 720). */
ORZO_API void orzo_picture_size(const OrzoSim *sim, int *width, int *height);

/* Draws the grains as the scene's movie would be: width x height x 4 bytes, RGBA, top row first.
 * The first picture frames those after it, until orzo_set. A simulation is drawn from one thread
 * only. */
ORZO_API OrzoStatus orzo_draw(OrzoSim *sim, uint8_t *pixels, int64_t room);

/* Writes all that later steps depend on into a file (HDF5 behind a head of 512 bytes). */
ORZO_API OrzoStatus orzo_save(OrzoSim *sim, const char *path);

/* Opens a simulation that goes on from there: the same bits follow as without the stop. It needs
 * a device of the same kind. The caller closes it with orzo_close. */
ORZO_API OrzoStatus orzo_load(OrzoSim **sim, const char *path);

#ifdef __cplusplus
}
#endif

#endif
