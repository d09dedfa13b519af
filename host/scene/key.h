/* A row of THE list of scene keys (scene/keys.h). */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* What is stored at the row's offset. */
typedef enum OzKeyType {
    OZ_KEY_NUMBER,  /* double                                                      */
    OZ_KEY_INTEGER, /* int64_t or, never negative, uint64_t                        */
    OZ_KEY_BOOL,    /* bool                                                        */
    OZ_KEY_TEXT,    /* char *, owned                                               */
    OZ_KEY_FILE,    /* char *, owned: relative to the file that names it, stored absolute */
    OZ_KEY_NAMES,   /* char *[width], owned                                        */
    OZ_KEY_CHOICE,  /* an enum                                                     */
    OZ_KEY_CHOICES, /* up to `width` enums, and their int count                    */
    OZ_KEY_VECTOR,  /* double[width]                                               */
    OZ_KEY_COUNTS,  /* int64_t[width]                                              */
    OZ_KEY_SIZE,    /* int[2]                                                      */
    OZ_KEY_RANGE,   /* OzRange: a number or [low, high]                            */
    OZ_KEY_NUMBERS, /* double *, owned, and its int count                          */
    OZ_KEY_SECTION, /* bool: an optional group of keys is present                  */
    OZ_KEY_ITEMS,   /* array of structs, owned, and its int count: a list of groups */
    OZ_KEY_SWEEP,   /* OzSweep                                                     */
    OZ_KEY_EXTENDS  /* nothing: used up before keys are read                       */
} OzKeyType;

/* When a row is written back. */
typedef enum OzKeyWrite {
    OZ_WRITE_ALWAYS,
    OZ_WRITE_NONZERO,          /* only when it holds something              */
    OZ_WRITE_UNLESS_RIVAL,     /* only when its rival row holds nothing     */
    OZ_WRITE_UNLESS_INHERITED, /* only when it differs from what it inherits */
    OZ_WRITE_MARKED            /* only when written: the bool at count_offset says so */
} OzKeyWrite;

typedef struct OzKey {
    const char *path; /* "time.step"; "grains[].diameter" lives in an item of the list grains */
    OzKeyType type;
    const char *unit;          /* "" for pure numbers and the like                        */
    double low, high;          /* both allowed; of every number in the value              */
    const char *fallback;      /* the default as YAML, or NULL                            */
    const char *fallback_help; /* the default in words, where no constant says it         */
    const char *help;
    const char *const *choices;    /* names in the enum's order, "" where the model has none,
                                      ending with NULL                                        */
    const char *truth;             /* CHOICE: the name that `true` means; NULL: none        */
    size_t offset, count_offset;   /* in OzScene or in the list's item; the latter of a list's int
                                      count, or of an OZ_WRITE_MARKED row's bool              */
    size_t item_size, line_offset; /* OZ_KEY_ITEMS: of one item, and of its int line        */
    int width;
    double scale;         /* NUMBER: what is stored over what is written; 0: 1       */
    const char *infinite; /* NUMBER: the word for INFINITY; NULL: there is none      */
    unsigned models;      /* bit i: belongs to the model i; 0: to all                */
    bool required;        /* this or its rival; where kind, law and section ask      */
    unsigned kinds;       /* bit i: belongs to items whose kind is i; 0: to all      */
    unsigned shapes;      /* bit i: to grains whose shape is i; 0: to all             */
    unsigned laws;        /* bit i: belongs to the contact law i; 0: to all          */
    const char *fixed;    /* why it cannot change while a scene runs; NULL: it can   */
    const char *rival;    /* the neighbouring key that says the same otherwise       */
    const char *inherits; /* the key whose value it takes when not written           */
    bool shared;          /* it always takes that: refused where written             */
    OzKeyWrite write;
} OzKey;
