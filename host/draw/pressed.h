/* What the contacts of a snapshot make of its grains in pictures: how hard each is pressed, how
 * many it touches, and the lines along which forces go. Knows no GL. */
#pragma once

#include "draw/look.h"

/* From a grain's centre to that of another, or to where it touches a wall. */
typedef struct OzChain {
    double from[3], to[3]; /* m                                   */
    double push;           /* N (flat: N a metre deep), of both's contacts together */
} OzChain;

/* Zeroed is empty; memory is kept from one snapshot to the next. */
typedef struct OzPressed {
    double *share; /* of each grain, 0 to 1 of the look's scale: what its colour shows */
    OzChain *chains;
    int64_t chain_count;
    int64_t capacity, chain_capacity;
} OzPressed;

/* The scale of a contact number, 0 to this. */
#define OZ_PRESSED_CONTACTS 12

/* N: what presses a grain on the floor of such a bed from all its sides together, rounded up: its
 * weight a floor's area times a grain's surface (flat: width, and circumference); 1 where nothing
 * weighs. */
double oz_pressed_scale(const OzSnapshot *snapshot, const OzLook *look);

/* Of a look that is coloured by OZ_COLOUR_FORCE or OZ_COLOUR_COORDINATION, or has chains; of others
 * it does nothing. Without contacts in the snapshot all is 0. Fails with OZ_ERR_MEMORY. */
OzStatus oz_pressed_find(OzPressed *pressed, const OzSnapshot *snapshot, const OzLook *look);

/* How wide a chain is drawn, as a share of a grain's diameter. */
double oz_pressed_width(const OzChain *chain, const OzLook *look);

void oz_pressed_free(OzPressed *pressed); /* zeroed is fine */
