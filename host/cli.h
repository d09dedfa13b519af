/* The command line: sub-commands and options as values. */
#pragma once

#include "base/status.h"
#include "draw/renderer.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { OZ_CLI_SETTINGS_MAX = 128, OZ_CLI_PATHS_MAX = 64, OZ_CLI_SEEDS_MAX = 100000 };

typedef struct OzOptions {
    const char *command;
    const char *paths[OZ_CLI_PATHS_MAX]; /* scenes, or the folder of `draw` */
    int path_count;
    const char *out;                     /* -o                               */
    char *settings[OZ_CLI_SETTINGS_MAX]; /* --set, in order; not owned        */
    int setting_count;
    const char *device; /* --device                         */
    int threads;        /* --threads; 0: the driver's choice */
    OzGlBackend gl;     /* --gl                             */
    double until;       /* --until, s; negative: not given   */
    bool has_seeds;     /* --seeds                          */
    uint64_t seed_first, seed_last;
    int part, parts; /* --part, which --seeds are those of; parts 0: not given */
    const char *against; /* --against of plot; NULL: not given */
    const char *only; /* --only of figures; NULL: all */
    const char *to;   /* --to of export, as written; NULL: not given */
    int64_t every;    /* --every; 0: not given           */
    const char *from; /* --from: "DIR", "DIR@tap=N", "DIR@time=T"; NULL: not given */
    bool resumes;     /* the command goes on with a run   */
    int own_settings; /* which began with so many settings */
    const char *stream;                   /* --stream: a path, "-", or NULL    */
    bool latest;                          /* --latest                         */
    bool serve;                           /* --serve                          */
    int serve_port;                       /* of it; 0: a free one             */
    bool overwrite, no_video, force, columns, help, verbose;
    const char *source_dir;                       /* --source-dir                     */
    bool features, quick;                         /* bench; quick of figures too      */
    double budget;                                /* --budget, s; 0: not given        */
    double tolerance;                             /* --tolerance of report; 0: not given */
    double share;                                 /* --share of report --hits; 0: not given */
    bool extreme, map, stability, ensemble, hits, validate; /* report         */
    const char *sizes;                            /* --sizes, as written              */
    const char *compare;                          /* --compare: a bench.json, or NULL */
    bool watch, replay;                   /* of run                           */
    const char *replay_folder;            /* of the run that is repeated, set by run */
    bool has_pace;                        /* --realtime                       */
    double pace;                          /* simulated seconds a second; 0: the movie's */
    const char *yardstick;                        /* --yardstick                      */
} OzOptions;

/* A command, a row of the list that parsing, help and the manual page share. */
typedef struct OzCliCommand {
    const char *name, *arguments, *takes, *help; /* takes: its options' letters */
    int least_paths, most_paths;
    const char *example;
} OzCliCommand;

/* An option: its names, its value (NULL: none; in brackets: may be left out) and help; how it is
 * taken: a flag, a text as it is, one that is not empty (what is wanted instead), or by a function
 * of its own. */
typedef struct OzCliOption {
    char letter;
    const char *name, *value, *help;
    enum { OZ_CLI_FLAG, OZ_CLI_TEXT, OZ_CLI_OWN } kind;
    size_t offset; /* in OzOptions: of a bool or a text */
    const char *wanted;
    OzStatus (*parse)(OzOptions *options, const char *value);
} OzCliOption;

/* The rows, static; returns how many. */
int oz_cli_commands(const OzCliCommand **rows);
int oz_cli_options(const OzCliOption **rows);

/* What orzo is, and what its exit statuses say; each a line or more, without its end. */
const char *oz_cli_summary(void);
const char *oz_cli_statuses(void);

/* Reads argv. Fails with OZ_ERR_INPUT, naming the argument and what was expected. */
OzStatus oz_cli_parse(OzOptions *options, int argc, char **argv);

/* The text of --help: of one command, or of all, with the exit statuses, when it is NULL. */
void oz_cli_help(const char *command);
