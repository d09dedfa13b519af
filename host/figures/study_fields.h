/* Reading a group of a study file into a struct, by a list of its keys. Knows no key by name. */
#pragma once

#include "base/status.h"
#include "scene/tree.h"

#include <stdbool.h>
#include <stddef.h>

/* Texts and numbers of a list. Zeroed is empty; owned. */
typedef struct OzTexts {
    char **items;
    int count;
} OzTexts;

typedef struct OzNumbers {
    double *items;
    int count;
} OzNumbers;

typedef enum OzStudyFieldType {
    OZ_STUDY_FIELD_TEXT,    /* char *, NULL where it is not given */
    OZ_STUDY_FIELD_TEXTS,   /* OzTexts; one text may stand alone  */
    OZ_STUDY_FIELD_NUMBERS, /* OzNumbers, likewise                */
    OZ_STUDY_FIELD_FLAG     /* bool                               */
} OzStudyFieldType;

/* A key: where its value goes. */
typedef struct OzStudyField {
    const char *name;
    OzStudyFieldType type;
    size_t offset;
    const char *of;      /* kinds that know it, with spaces between; NULL: all */
    bool needed;         /* by those kinds                                     */
    int count;           /* of numbers: exactly so many; 0: one or more        */
    const char *choices; /* of a text, with spaces between; NULL: any          */
} OzStudyField;

/* A key's value in base. */
void *oz_study_fields_at(const OzStudyField *field, const void *base);

/* Puts what the map's entries say into a zeroed base. Adds a fault for a key that is unknown to the
 * kind (NULL: to the list), for one that is missing and for a value that is not of its type; `what`
 * names the group in them. The caller frees base also on failure, which is OZ_ERR_MEMORY alone. The
 * list ends with a NULL name. */
OzStatus oz_study_fields_read(const OzStudyField *fields, const char *kind, const OzNode *map,
                              const char *what, void *base, OzFaults *faults);

/* Frees what base owns by the list. */
void oz_study_fields_free(const OzStudyField *fields, void *base);

/* Whether a word stands in a text of words with spaces between. */
bool oz_study_fields_has(const char *words, const char *word);
