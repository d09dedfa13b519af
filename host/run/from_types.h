/* What a run begins from (run/from.h). */
#pragma once

#include "model/grains.h"
#include "run/checkpoint.h"

/* A file of states: of a plain run, or of some members of an ensemble. */
typedef struct OzFromFile {
    char *path; /* owned */
    OzState state;
    OzCheckpointHead head;
} OzFromFile;

/* A member of that run. Zeroed is none. */
typedef struct OzFromMember {
    OzFromFile *file;
    int index;       /* in the file                                          */
    char *name;      /* "seed_00003"; of a plain run "" or NULL; owned       */
    OzScene scene;   /* as it ran, its walls' phases included                */
    OzGrains grains; /* as they were placed; their geometry holds            */
} OzFromMember;

/* Zeroed is valid: none. */
typedef struct OzFrom {
    char *asked; /* NULL: none; owned                                       */
    OzFromFile *files;
    int count;
    char *only;        /* the member that was named; NULL: whichever fits; owned */
    OzFromMember last; /* that was looked at                                */
} OzFrom;
