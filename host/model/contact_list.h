/* The contacts of a snapshot, one entry each, in double and SI whatever the device counts in; and
 * sums over them. Whoever fills a list knows the physics; this file knows none. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

/* Rods and spheres; of trigrains the kinds of Poeschel and Buchholtz 1995, section 3, numbered as
 * in kernels/triangle.h, with physics' sixth, and discs apart. */
typedef enum OzContactKind {
    OZ_CONTACT_ROD,
    OZ_CONTACT_I,    /* two crossings on one edge of one triangle                     */
    OZ_CONTACT_II,   /* two crossings on different edges of both                      */
    OZ_CONTACT_III,  /* four crossings, two on each of two edges of both              */
    OZ_CONTACT_IV,   /* four crossings, one triangle cut on all three edges           */
    OZ_CONTACT_V,    /* six crossings                                                 */
    OZ_CONTACT_VI,   /* four crossings, both triangles cut on all three edges         */
    OZ_CONTACT_DISC, /* one or two discs                                              */
    OZ_CONTACT_KINDS
} OzContactKind;

/* One contact. Forces are of the state in which it was looked at: what the next step starts with.
 */
typedef struct OzContactEntry {
    int32_t a, b; /* grains, a < b; b = -1 - i at wall i of the scene                  */
    int32_t part_a,
        part_b; /* trigrains: the elements; rods: 0, at walls part_a tells side and end      */
    OzContactKind kind;
    bool slips;           /* the tangential force is all that friction lets it be              */
    double point[3];      /* m, where the force acts; triangles: near the overlap's centroid   */
    double normal[3];     /* unit vector from a to b                                           */
    double push;          /* N, the force's part along the normal, > 0 pushes apart            */
    double tangential[3]; /* N, the rest of the force, on b; a feels the opposite of both      */
    double couple[3];     /* N m, on b, against rolling and twisting; rods only                */
    double overlap;       /* m; m^2 of triangles                                               */
    double rate, mass;    /* m/s, d(overlap)/dt; kg, effective; rods only, else 0              */
    double energy;        /* J, stored in the overlap                                          */
    double spring[3];     /* m, tangential spring as stored between steps, which pulls b       */
    double spring_energy; /* J, stored in it                                                   */
} OzContactEntry;

/* Zeroed is empty. Frees with oz_contact_list_free. */
typedef struct OzContactList {
    OzContactEntry *entry; /* by a, then b (grains, then walls), then parts, once sorted */
    int64_t count, capacity;
} OzContactList;

/* Adds a copy. Fails with OZ_ERR_MEMORY, the list as it was. */
OzStatus oz_contact_list_add(OzContactList *list, const OzContactEntry *entry);

/* Puts entries into the order of ids, in which sums are the same however they were found. */
void oz_contact_list_sort(OzContactList *list);

void oz_contact_list_free(OzContactList *list);

typedef struct OzContactSums {
    int64_t kinds[OZ_CONTACT_KINDS]; /* contacts of each kind, walls included             */
    int64_t pairs;                   /* pairs of grains that touch                        */
    int64_t walls;                   /* contacts with walls                               */
    double overlap_sum, overlap_max; /* m; of trigrains m^2, of triangles alone           */
    double energy;                   /* J, stored in overlaps and springs                 */
    double spring_energy;            /* J, the springs' part of it                        */
} OzContactSums;

/* Of a sorted list. */
OzContactSums oz_contact_list_sum(const OzContactList *list);

/* The force of all grains on each of the first `count` walls, N. */
void oz_contact_list_push_walls(const OzContactList *list, double (*force)[3], int count);

/* The torque of these forces, and couples, on each of them about a point of its own (m), N m. */
void oz_contact_list_turn_walls(const OzContactList *list, const double (*about)[3],
                                double (*torque)[3], int count);
