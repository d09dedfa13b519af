/* What the program holds: memory, files and objects of libraries that it was given and has not
 * given back, with the place in it that asked. For tests/faults.c, which says of each call what it
 * gives.
 */
#pragma once

#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { HELD_MOST = 1 << 18 }; /* a power of two; some thousand are held at a time */

typedef struct Held {
    const void *what; /* NULL: free; `gone`: was used, others may follow */
    uintptr_t caller; /* relative to the program                         */
} Held;

static Held held[HELD_MOST];
static const char gone[1];
static atomic_flag held_lock = ATOMIC_FLAG_INIT;

static inline void lock_held(void)
{
    while (atomic_flag_test_and_set_explicit(&held_lock, memory_order_acquire)) {
    }
}

static inline void unlock_held(void)
{
    atomic_flag_clear_explicit(&held_lock, memory_order_release);
}

static inline size_t place_of(const void *what)
{
    return (size_t)(((uintptr_t)what >> 4) * UINT64_C(0x9e3779b97f4a7c15) >> 40) % HELD_MOST;
}

static inline void hold(const void *what, uintptr_t caller)
{
    lock_held();
    size_t i = place_of(what);
    while (held[i].what && held[i].what != gone) {
        i = (i + 1) % HELD_MOST;
    }
    held[i] = (Held){what, caller};
    unlock_held();
}

/* What nobody holds is passed over. */
static inline void let_go(const void *what)
{
    lock_held();
    size_t i = place_of(what);
    while (held[i].what && held[i].what != what) {
        i = (i + 1) % HELD_MOST;
    }
    if (what && held[i].what == what) {
        held[i].what = gone;
    }
    unlock_held();
}

/* All whose upper sixteen bits are above 0, which memory's are not. */
static inline void let_go_numbered(void)
{
    lock_held();
    for (size_t i = 0; i < HELD_MOST; i++) {
        if ((uintptr_t)held[i].what >> 48) {
            held[i].what = gone;
        }
    }
    unlock_held();
}

/* A line for each, the caller's place in the program. */
static inline void tell_held(const char *path)
{
    FILE *file = path ? fopen(path, "w") : NULL;
    for (size_t i = 0; file && i < HELD_MOST; i++) {
        if (held[i].what && held[i].what != gone) {
            fprintf(file, "0x%lx\n", (unsigned long)held[i].caller);
        }
    }
    if (file) {
        fclose(file);
    }
}
