/* The timed part: forces, motion and the neighbour list. A good C programmer's single-core program:
 * a list with skin over a grid, in which pairs found apart sleep for as long as their gap allows;
 * then three loops without unpredictable branches (who is awake, who touches, what the force is),
 * block by block, so that what one loop leaves is still in the first-level cache for the next. */
#include "yardstick_contact.h"

#include <stdlib.h>

#define PI      3.14159265358979
#define GRAVITY 9.81
#define ACROSS  (MASS * DIAMETER * DIAMETER * 1.8892857F)  /* moments of inertia for a shaft of */
#define AXIAL   (MASS * DIAMETER * DIAMETER * 0.12142857F) /* four diameters (P eq. 10)         */

#define PAIRS 64 /* room in the list for each rod: enough for a skin of 1.5 diameters */
#define BLOCK 64 /* rods whose touches fit into the first-level cache */

/* Rods that may touch. They sleep until their paths add up to wake: no sooner can the gap close. */
typedef struct Pair {
    int other, touches;
    float wake;
    OzVec stretch; /* of the tangential spring */
} Pair;

typedef struct Touch {
    OzRod *first, *second;
    Pair *pair;
    float s, t, distance2; /* at first->place + s first->shaft, second->place + t second->shaft */
    OzVec gap;             /* from the second to the first */
} Touch;

static int count, wide, high;  /* rods; cells across and upwards */
static int *first, *old_first; /* pairs first[i] .. first[i + 1] - 1 are with rods above i */
static int *head, *next;       /* the rods of a cell, numbered from 1, 0 ends */
static float inside, skin, reach, floor_height, floor_velocity, farthest;
static OzVec mean; /* velocity of all rods */
static OzRod *rods;
static Pair *pairs, *old_pairs;
static Touch touches[BLOCK * PAIRS];
static OzVec (*wall_stretch)[4]; /* floor and cylinder at one end, then at the other */

static int find_awake(int from, int to)
{
    int n = 0;
    for (int i = from; i < to; i++) {
        for (Pair *pair = pairs + first[i]; pair < pairs + first[i + 1]; pair++) {
            touches[n].first = &rods[i];
            touches[n].pair = pair;
            n += rods[i].path + rods[pair->other].path >= pair->wake;
        }
    }
    return n;
}

static int find_touches(int awake)
{
    int n = 0;
    for (int k = 0; k < awake; k++) {
        Touch c = touches[k];
        c.second = &rods[c.pair->other];
        OzVec apart = minus(c.first->place, c.second->place);
        c.gap = closest(apart, c.first->shaft, c.second->shaft, &c.s, &c.t);
        c.distance2 = dot(c.gap, c.gap);
        c.pair->wake = c.first->path + c.second->path + sqrtf(c.distance2) - DIAMETER;
        int touching = c.distance2 < DIAMETER * DIAMETER;
        if (c.pair->touches > touching) {
            c.pair->stretch = (OzVec){0, 0, 0};
        }
        c.pair->touches = touching;
        touches[n] = c;
        n += touching;
    }
    return n;
}

static void push_touches(int n)
{
    for (const Touch *c = touches; c < touches + n; c++) {
        OzRod *a = c->first, *b = c->second;
        float inverse = 1 / sqrtf(c->distance2 + FLT_MIN);
        float overlap = DIAMETER - c->distance2 * inverse;
        OzVec normal = scale(c->gap, -inverse), stretch = c->pair->stretch;
        OzVec arm_a = along(scale(a->shaft, c->s), RADIUS, normal);
        OzVec arm_b = along(scale(b->shaft, c->t), -RADIUS, normal);
        OzVec velocity = minus(along(b->velocity, 1, cross(b->spin, arm_b)),
                               along(a->velocity, 1, cross(a->spin, arm_a)));
        OzVec force = contact(MASS / 2, normal, overlap, velocity, &stretch);
        c->pair->stretch = stretch;
        a->force = minus(a->force, force);
        a->torque = minus(a->torque, cross(arm_a, force));
        b->force = along(b->force, 1, force);
        b->torque = along(b->torque, 1, cross(arm_b, force));
    }
}

static void push_walls(OzRod *rod, OzVec *stretches)
{
    unsigned touching = 0;
    OzVec up = along(rod->place, 1, rod->shaft), down = minus(rod->place, rod->shaft);
    float far2 = fmaxf(up.x * up.x + up.y * up.y, down.x * down.x + down.y * down.y);
    if ((fminf(up.z, down.z) > RADIUS + floor_height) & (far2 < inside * inside)) {
        rod->walls = 0;
        return;
    }
    for (int k = 0; k < 4; k++) {
        OzVec end = scale(rod->shaft, k < 2 ? 1 : -1), to = {0, 0, -1};
        OzVec tip = along(rod->place, 1, end);
        float overlap = RADIUS + floor_height - tip.z, off2 = tip.x * tip.x + tip.y * tip.y;
        if (k & 1) {
            float off = sqrtf(off2 + FLT_MIN);
            overlap = off - inside;
            to = (OzVec){tip.x / off, tip.y / off, 0};
        }
        if (overlap > 0) {
            OzVec arm = along(end, RADIUS, to);
            OzVec velocity = along(rod->velocity, 1, cross(rod->spin, arm));
            velocity.z -= k & 1 ? 0 : floor_velocity;
            OzVec stretch = rod->walls & 1U << k ? stretches[k] : (OzVec){0, 0, 0};
            OzVec force = contact(MASS, to, overlap, scale(velocity, -1), &stretch);
            stretches[k] = stretch;
            touching |= 1U << k;
            rod->force = minus(rod->force, force);
            rod->torque = minus(rod->torque, cross(arm, force));
        }
    }
    rod->walls = touching;
}

/* Explicit Euler without the gyroscopic term, as in the paper. */
static inline void move(OzRod *rod, OzVec common, float damping)
{
    OzVec turn = cross(rod->spin, rod->shaft), off = minus(rod->velocity, common);
    OzVec shaft = along(rod->shaft, STEP, turn);
    rod->path += STEP * sqrtf(dot(off, off) + dot(turn, turn) + 2 * fabsf(dot(off, turn)));
    rod->place = along(rod->place, STEP, rod->velocity);
    rod->velocity = along(scale(rod->velocity, damping), STEP / MASS, rod->force);
    rod->velocity.z -= STEP * (float)GRAVITY;
    float twist = STEP * (1 / AXIAL - 1 / ACROSS) / SQUARE * dot(rod->torque, rod->shaft);
    rod->spin = along(scale(rod->spin, damping), STEP / ACROSS, rod->torque);
    rod->spin = along(rod->spin, twist, rod->shaft);
    rod->shaft = scale(shaft, 1.5F - 0.5F * dot(shaft, shaft) / SQUARE);
    rod->force = rod->torque = (OzVec){0, 0, 0};
}

static int slice(float offset, int cells)
{
    int k = (int)(offset / reach);
    return k < 0 ? 0 : k < cells ? k : cells - 1;
}

/* Cells as wide as two rods' reach, counted upwards first. */
static void enter_cells(void)
{
    float top = 0, wall = inside + RADIUS;
    for (int i = 0; i < count; i++) {
        top = fmaxf(top, rods[i].place.z);
    }
    wide = (int)(2 * wall / reach) + 1;
    high = (int)(top / reach) + 1;
    free(head);
    head = calloc((size_t)(wide * wide * high), sizeof *head);
    for (int i = 0; i < count; i++) {
        OzVec at = rods[i].place;
        int row = slice(at.y + wall, wide) * wide + slice(at.x + wall, wide);
        rods[i].cell = row * high + slice(at.z, high);
        rods[i].path = 0;
        next[i] = head[rods[i].cell];
        head[rods[i].cell] = i + 1;
    }
}

/* Neighbours in space shall be neighbours in memory. Rods hardly change places later, and settling
 * keeps the order from below upwards. */
static int by_cell(const void *a, const void *b)
{
    return ((const OzRod *)a)->cell - ((const OzRod *)b)->cell;
}

static void add_pair(int i, int j)
{
    const OzRod *a = &rods[i], *b = &rods[j];
    OzVec apart = minus(a->place, b->place);
    float apart2 = dot(apart, apart), cut = DIAMETER + skin, s, t;
    float clear = apart2 - fabsf(dot(a->shaft, apart)) - fabsf(dot(b->shaft, apart));
    if (apart2 > reach * reach || (clear > 0 && clear * clear > cut * cut * apart2)) {
        return; /* a plane across the line between the centres parts them */
    }
    OzVec gap = closest(apart, a->shaft, b->shaft, &s, &t);
    if (dot(gap, gap) < cut * cut) {
        int k = old_first[i];
        while (k < old_first[i + 1] && old_pairs[k].other != j) {
            k++;
        }
        Pair *pair = &pairs[first[i + 1]++];
        *pair = k < old_first[i + 1] ? old_pairs[k] : (Pair){.other = j};
        pair->wake = sqrtf(dot(gap, gap)) - DIAMETER;
    }
}

static void find_pairs(int i)
{
    int x = rods[i].cell / high % wide, y = rods[i].cell / high / wide, z = rods[i].cell % high;
    first[i + 1] = first[i];
    for (int k = 0; k < 27; k++) {
        int cx = x + k % 3 - 1, cy = y + k / 9 - 1, cz = z + k / 3 % 3 - 1;
        if (cx >= 0 && cx < wide && cy >= 0 && cy < wide && cz >= 0 && cz < high) {
            for (int j = head[(cy * wide + cx) * high + cz] - 1; j > i; j = next[j] - 1) {
                add_pair(i, j);
            }
        }
    }
}

static void rebuild(void)
{
    int *last_first = first;
    Pair *last_pairs = pairs;
    first = old_first;
    old_first = last_first;
    pairs = old_pairs;
    old_pairs = last_pairs;
    enter_cells();
    for (int i = 0; i < count; i++) {
        find_pairs(i);
    }
}

static void push(OzYardstickWork *work)
{
    for (int i = 0; i < count; i += BLOCK) {
        int n = find_touches(find_awake(i, i + BLOCK < count ? i + BLOCK : count));
        push_touches(n);
        work->contacts += n;
    }
    for (int i = 0; i < count; i++) {
        push_walls(&rods[i], wall_stretch[i]);
    }
}

static void move_all(float damping)
{
    OzVec sum = {0, 0, 0}, common = mean;
    float most = 0, second = 0;
    for (int i = 0; i < count; i++) {
        move(&rods[i], common, damping);
        second = fmaxf(second, fminf(most, rods[i].path));
        most = fmaxf(most, rods[i].path);
        sum = along(sum, 1, rods[i].velocity);
    }
    mean = scale(sum, 1 / (float)count);
    farthest = most + second;
}

void oz_yardstick_step(OzYardstickWork *work, double phase, double acceleration_ratio,
                       float damping)
{
    double rate = 2 * PI * 30, amplitude = acceleration_ratio * GRAVITY / (rate * rate);
    floor_height = (float)(amplitude * sin(phase));
    floor_velocity = (float)(amplitude * rate * cos(phase));
    if (!head) {
        enter_cells();
        qsort(rods, (size_t)count, sizeof *rods, by_cell);
    }
    if (farthest >= skin) {
        rebuild();
        work->rebuilds++;
    }
    push(work);
    move_all(damping);
    work->steps++;
}

OzRod *oz_yardstick_start(int rod_count, double container, double list_skin)
{
    size_t n = (size_t)rod_count;
    count = rod_count;
    inside = (float)container / 2 - RADIUS;
    skin = (float)list_skin;
    reach = 2 * HALF + DIAMETER + skin;
    farthest = FLT_MAX;
    rods = calloc(n, sizeof *rods);
    wall_stretch = calloc(n, sizeof *wall_stretch);
    next = calloc(n, sizeof *next);
    first = calloc(n + 1, sizeof *first);
    old_first = calloc(n + 1, sizeof *first);
    pairs = calloc(n * PAIRS, sizeof *pairs);
    old_pairs = calloc(n * PAIRS, sizeof *pairs);
    return wall_stretch && next && first && old_first && pairs && old_pairs ? rods : NULL;
}
