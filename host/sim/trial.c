/* One grain against one large triangle. */
#include "sim/trial.h"

#include "model/motion.h"
#include "sim/element_reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum {
    ORIENTATIONS = 8,
    STEPS_MOST = 6000, /* of one hit */
    LOOK = 4,       /* steps from one look to the next: thirty or more in the fastest vibration */
    DOUBLINGS = 10, /* of the speed at which a grain may break, */
    HALVINGS = 20,  /* and of the interval in which it does     */
    SLOWER_MOST = 4 /* times that a speed is divided by four */
};

/* A grain of its own with a floor, and the scene in which it is thrown. */
typedef struct Throw {
    OzScene scene;
    OzWall floor;
    OzGrains grains;
} Throw;

static int64_t beams_of(const OzElements *p, int64_t grain, int64_t *first)
{
    int64_t count = 0;
    *first = -1;
    for (int64_t k = 0; k < p->beam_count; k++) {
        if (p->body[p->beam_a[k]] == grain) {
            *first = *first < 0 ? k : *first;
            count++;
        }
    }
    return count;
}

static void copy_elements(OzElements *to, const OzElements *from, int64_t first, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        memcpy(&to->corner[6 * i], &from->corner[6 * (first + i)], 6 * sizeof(double));
        to->radius[i] = from->radius[first + i];
        to->reach[i] = from->reach[first + i];
        to->area[i] = from->area[first + i];
        to->mass[i] = from->mass[first + i];
        to->inertia[i] = from->inertia[first + i];
    }
}

/* The outlines of elements from first on, before end. */
static int64_t outlines_of(const OzElements *p, int64_t first, int64_t end, int64_t *first_outline)
{
    int64_t count = 0;
    for (int64_t k = p->outline_count - 1; k >= 0; k--) {
        if (p->outline_element[k] >= first && p->outline_element[k] < end) {
            *first_outline = k;
            count++;
        }
    }
    return count;
}

static void copy_outlines(OzElements *to, const OzElements *from, int64_t first_outline, int first)
{
    for (int64_t k = 0; k < to->outline_count; k++) {
        to->outline_element[k] = from->outline_element[first_outline + k] - first;
        to->outline_edge[k] = from->outline_edge[first_outline + k];
    }
}

static void copy_beams(OzElements *to, const OzElements *from, int64_t first_beam,
                       int first_element)
{
    for (int64_t k = 0; k < to->beam_count; k++) {
        to->beam_a[k] = from->beam_a[first_beam + k] - first_element;
        to->beam_b[k] = from->beam_b[first_beam + k] - first_element;
        to->beam_length[k] = from->beam_length[first_beam + k];
        to->beam_rest_a[k] = from->beam_rest_a[first_beam + k];
        to->beam_rest_b[k] = from->beam_rest_b[first_beam + k];
    }
}

/* Without gravity, the floor's free side being y > 0. */
static OzStatus make_throw(Throw *t, const OzScene *scene, const OzGrains *grains, int64_t grain)
{
    const OzElements *from = grains->elements;
    int64_t first = from->first[grain], count = from->first[grain + 1] - first, first_beam;
    int64_t first_outline = 0;
    OzElementCounts counts = {.grains = 1, .walls = 1, .free_elements = count, .wall_elements = 1};
    double size = grains->diameter[grain];
    *t = (Throw){.scene = *scene, .floor = {.kind = OZ_WALL_SEGMENT, .contact = scene->contact}};
    memset(t->scene.gravity, 0, sizeof t->scene.gravity);
    t->scene.walls = &t->floor;
    t->scene.wall_count = 1;
    t->scene.observe.ledger = false;
    t->scene.beams.strength.present = false; /* it looks how far they would go */
    t->scene.beams.yield.present = false;
    counts.beams = beams_of(from, grain, &first_beam);
    counts.outlines = outlines_of(from, first, first + count, &first_outline);
    OZ_PASS(oz_grains_create(&t->grains, 1));
    OZ_PASS(oz_elements_create(&t->grains.elements, &counts));
    t->grains.diameter[0] = size;
    t->grains.mass[0] = grains->mass[grain];
    t->grains.inertia[0] = t->grains.inertia_axis[0] = grains->inertia[grain];
    OzElements *to = t->grains.elements;
    to->first[1] = count;
    to->first[2] = count + 1;
    to->body[count] = 1;
    copy_elements(to, from, first, count);
    copy_beams(to, from, first_beam, (int)first);
    copy_outlines(to, from, first_outline, (int)first);
    double corners[6] = {-20 * size, 0, 0, -4 * size, 20 * size, 0};
    return oz_elements_set_triangle(to, count, corners, 0);
}

/* Turns the grain as it starts in its scene by an angle and puts it just above the floor, falling.
 */
static void aim(Throw *t, const OzGrains *grains, int64_t grain, double turn, double speed)
{
    const OzElements *from = grains->elements;
    OzElements *to = t->grains.elements;
    double lowest = INFINITY, c = cos(turn), s = sin(turn), corners[6];
    int64_t first = from->first[grain];
    for (int64_t i = 0; i < to->free_count; i++) {
        double x = from->position[2 * (first + i)] - grains->position[3 * grain];
        double y = from->position[2 * (first + i) + 1] - grains->position[3 * grain + 1];
        to->position[2 * i] = c * x - s * y;
        to->position[2 * i + 1] = s * x + c * y;
        to->angle[i] = from->angle[first + i] + turn;
        to->velocity[2 * i] = 0;
        to->velocity[2 * i + 1] = -speed;
        oz_elements_corners(to, i, &to->position[2 * i], to->angle[i], corners);
        for (int k = 0; k < 3; k++) {
            lowest = fmin(lowest, corners[2 * k + 1]);
        }
    }
    for (int64_t i = 0; i < to->free_count; i++) {
        to->position[2 * i + 1] -= lowest - 1e-3 * t->grains.diameter[0];
    }
}

/* Until the beams would have swung back: half a period of the slowest bending, of two halves of the
 * grain on its longest beam. */
static int64_t steps_of(const Throw *t)
{
    const OzElements *p = t->grains.elements;
    double length = 0;
    for (int64_t k = 0; k < p->beam_count; k++) {
        length = fmax(length, p->beam_length[k]);
    }
    double bending = t->scene.beams.stiffness * t->scene.beams.second_moment / length;
    double time = PI * sqrt(t->grains.inertia[0] / (16 * bending));
    return (int64_t)fmin(time / t->scene.step, STEPS_MOST);
}

/* Raises the trial's figures to those of one hit. Fails with OZ_ERR_BLOWUP where a guard stops it.
 */
static OzStatus throw_once(OzTrial *trial, const Throw *t)
{
    OzStatus status = OZ_OK;
    OzElementReference *reference = NULL;
    OzSnapshot now = {0};
    int64_t last = steps_of(t);
    double before = t->grains.elements->velocity[1];
    OZ_TRY(oz_element_reference_create(&reference, &t->scene, &t->grains));
    OZ_TRY(oz_snapshot_create(&now, &t->scene, &t->grains));
    for (int64_t step = LOOK; step <= last; step += LOOK) {
        OZ_TRY(oz_element_reference_advance(reference, step));
        OZ_TRY(oz_element_reference_snapshot(reference, &now));
        double push = (now.velocity[1] - before) / (LOOK * t->scene.step) * t->grains.mass[0];
        before = now.velocity[1];
        trial->force = fmax(trial->force, push);
        trial->bend = fmax(trial->bend, now.beams.bend_max);
        trial->stretch =
            fmax(trial->stretch, fmax(now.beams.stretch_max - 1, 1 - now.beams.stretch_min));
    }
done:
    oz_snapshot_free(&now);
    oz_element_reference_free(reference);
    return status;
}

OzStatus oz_trial_hit(OzTrial *trial, const OzScene *scene, const OzGrains *grains, int64_t grain,
                      double speed)
{
    OzStatus status = OZ_OK;
    Throw t = {0};
    int64_t first_beam;
    *trial = (OzTrial){.grain = grain, .speed = speed};
    if (beams_of(grains->elements, grain, &first_beam) == 0 || !(speed > 0) ||
        !(scene->beams.second_moment > 0 && scene->beams.stiffness > 0)) {
        return OZ_OK;
    }
    OZ_TRY(make_throw(&t, scene, grains, grain));
    double times = 1;
    for (int slower = 0; slower <= SLOWER_MOST; slower++, times *= 4) {
        *trial = (OzTrial){.grain = grain, .speed = speed};
        status = OZ_OK;
        for (int k = 0; k < ORIENTATIONS && status == OZ_OK; k++) {
            aim(&t, grains, grain, 2 * PI * k / ORIENTATIONS, speed / times);
            status = throw_once(trial, &t);
        }
        if (status != OZ_ERR_BLOWUP) {
            break;
        }
    }
    trial->deep = status == OZ_ERR_BLOWUP;
    status = status == OZ_ERR_BLOWUP ? OZ_OK : status;
    trial->bend *= times;
    trial->stretch *= times;
    trial->force *= times;
done:
    oz_grains_free(&t.grains);
    return status;
}

/* Whether a hit breaks a beam. Fails with OZ_ERR_BLOWUP where a guard stops it. */
static OzStatus throw_to_break(bool *breaks, Throw *t, const OzGrains *grains, int64_t grain,
                               double speed)
{
    OzStatus status = OZ_OK;
    OzElementReference *reference = NULL;
    OzSnapshot now = {0};
    *breaks = false;
    for (int k = 0; k < ORIENTATIONS && !*breaks; k++) {
        aim(t, grains, grain, 2 * PI * k / ORIENTATIONS, speed);
        OZ_TRY(oz_element_reference_create(&reference, &t->scene, &t->grains));
        OZ_TRY(oz_snapshot_create(&now, &t->scene, &t->grains));
        OZ_TRY(oz_element_reference_advance(reference, steps_of(t)));
        OZ_TRY(oz_element_reference_snapshot(reference, &now));
        *breaks = oz_wear_broken(&now.wear) > 0;
        oz_snapshot_free(&now);
        oz_element_reference_free(reference);
        reference = NULL;
    }
done:
    oz_snapshot_free(&now);
    oz_element_reference_free(reference);
    return status;
}

OzStatus oz_trial_break(double *slowest, const OzScene *scene, const OzGrains *grains,
                        int64_t grain, double speed)
{
    OzStatus status = OZ_OK;
    Throw t = {0};
    int64_t first_beam;
    bool breaks = false;
    double low = 0, high = speed;
    *slowest = 0;
    if (!scene->beams.strength.present || !(speed > 0) ||
        beams_of(grains->elements, grain, &first_beam) == 0) {
        return OZ_OK;
    }
    OZ_TRY(make_throw(&t, scene, grains, grain));
    t.scene.beams.strength = scene->beams.strength;
    t.scene.beams.yield = scene->beams.yield;
    for (int k = 0; k < DOUBLINGS && !breaks; k++, high *= breaks ? 1 : 2) {
        OZ_TRY(throw_to_break(&breaks, &t, grains, grain, high));
        low = breaks ? low : high;
    }
    for (int k = 0; k < HALVINGS && breaks && high - low > 0.1 * high; k++) {
        bool sooner;
        double middle = 0.5 * (low + high);
        OZ_TRY(throw_to_break(&sooner, &t, grains, grain, middle));
        *(sooner ? &high : &low) = middle;
    }
    *slowest = breaks ? high : 0;
done:
    oz_grains_free(&t.grains);
    return status == OZ_ERR_BLOWUP ? OZ_OK : status;
}

double oz_trial_speed(const OzScene *scene, const OzGrains *grains)
{
    const OzElements *p = grains->elements;
    double gravity = hypot(scene->gravity[0], scene->gravity[1]), low = INFINITY, fall = 0;
    double speed = 0;
    for (int64_t i = p->free_count; i < p->count; i++) {
        low = fmin(low, p->position[2 * i + 1]);
    }
    for (int64_t i = 0; i < grains->count; i++) {
        bool random = scene->populations[grains->population[i]].kind == OZ_GRAINS_RANDOM;
        const double *v = &grains->velocity[3 * i];
        fall = fmax(fall, (grains->position[3 * i + 1] - low) * (random ? 0.5 : 1));
        speed = fmax(speed, hypot(v[0], v[1]));
    }
    for (int w = 0; w < scene->wall_count; w++) {
        speed = fmax(speed, oz_motion_speed(&scene->walls[w].motion));
    }
    return p->count > p->free_count ? fmax(speed, sqrt(2 * gravity * fall)) : speed;
}

OzStatus oz_trial_worst(OzTrial *worst, const OzScene *scene, const OzGrains *grains)
{
    double speed = oz_trial_speed(scene, grains);
    *worst = (OzTrial){.grain = -1, .speed = speed};
    for (int p = 0; p < scene->population_count; p++) {
        OzTrial trial;
        int64_t heavy = -1;
        for (int64_t i = 0; i < grains->count; i++) {
            if (grains->population[i] == p &&
                (heavy < 0 || grains->mass[i] > grains->mass[heavy])) {
                heavy = i;
            }
        }
        if (heavy >= 0) {
            OZ_PASS(oz_trial_hit(&trial, scene, grains, heavy, speed));
            bool worse = trial.deep > worst->deep || fmax(trial.bend, 2 * trial.stretch) >
                                                         fmax(worst->bend, 2 * worst->stretch);
            *worst = worse ? trial : *worst;
        }
    }
    return OZ_OK;
}

void oz_trial_advise(char *text, size_t size, const OzTrial *trial, const OzScene *scene)
{
    bool bends = trial->bend > OZ_TRIAL_BEND_MOST,
         stretches = trial->stretch > OZ_TRIAL_STRETCH_MOST;
    double bend = trial->bend / OZ_TRIAL_BEND_ADVISED;
    double stretch = trial->stretch / OZ_TRIAL_STRETCH_ADVISED;
    text[0] = 0;
    if (trial->deep) {
        snprintf(text, size,
                 "contacts are too soft for hits at %.3g m/s; try a larger "
                 "triangles.stiffness",
                 trial->speed);
    } else if (bends && (bend >= stretch || !stretches)) {
        snprintf(text, size,
                 "beams are too soft for hits at %.3g m/s, which bend them by %.2g rad; "
                 "beams.second_moment %.2g would do",
                 trial->speed, trial->bend, 1.05 * scene->beams.second_moment * bend * bend);
    } else if (stretches) {
        snprintf(text, size,
                 "beams are too soft for hits at %.3g m/s, which stretch them by %.2g; "
                 "beams.stiffness %.2g would do",
                 trial->speed, trial->stretch, 1.05 * scene->beams.stiffness * stretch * stretch);
    }
}
