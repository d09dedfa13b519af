/* Reading the command line. */
#include "cli.h"

#include "base/spelling.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What options a command takes, as letters of option_rows. */
static const OzCliCommand command_rows[] = {
    {"run", "SCENE", "oOseKrdtpgunmlVfSwRP",
     "simulate; leaves movie, pictures, series.csv, final.csv", 1, 1,
     "orzo run scenes/an6.yaml -o an6 --set time.taps=30 --set contact.friction=0.2"},
    {"resume", "DIR", "sdtgumlVS",
     "goes on with a run that was interrupted or killed, or to a later end, from its last state", 1,
     1, "orzo resume runs/an6 --set time.taps=600"},
    {"gather", "DIR...", "o",
     "tables of a whole ensemble whose parts ran apart (run --part), into the folder of parts or -o",
     1, OZ_CLI_PATHS_MAX, "orzo gather runs/an6"},
    {"check", "SCENE", "vsdtpgfS",
     "validate; restitution, stability and cost to expect, what follows from the scene", 1, 1,
     "orzo check scenes/an6.yaml --set time.step=2e-5 --verbose"},
    {"draw", "DIR", "osgS", "movie and pictures again from a run's frames.bin, into DIR/draw or -o",
     1, 1, "orzo draw runs/an6 -o pictures --set movie.colour=speed"},
    {"export", "DIR", "oak",
     "a run's frames as VTK, extended XYZ, H5MD or CSV, into DIR/export or -o", 1, 1,
     "orzo export runs/an6 --to vtk,xyz"},
    {"plot", "DIR [COLUMN]...", "oj",
     "columns of series.csv as plot.png and plot.svg; of an ensemble mean, interval and members", 1,
     OZ_CLI_PATHS_MAX, "orzo plot runs/an6 density_tap_mean angle --against tap"},
    {"figures", "STUDY", "oNQdtgS",
     "a paper's figures from its runs: runs what a study has not yet, then draws it", 1, 1,
     "orzo figures scenes/pournin2005/study.yaml --quick"},
    {"keys", "[PART]", "c",
     "every scene key (that holds PART, or speaks of it): type, unit, range, default, meaning", 0, 1,
     "orzo keys contact."},
    {"bench", "[SCENE]...", "oQFzCbysdtS",
     "speed on this machine: an6 and a ladder of beds, or scenes", 0, OZ_CLI_PATHS_MAX,
     "orzo bench --quick --threads 2"},
    {"report", "[SCENE]...", "oQTXMBEHxAefsdtS", "what accuracy costs: error against run time", 0,
     OZ_CLI_PATHS_MAX, "orzo report scenes/report/normal_hit.yaml --tolerance 0.01"},
    {"devices", "", "", "OpenCL devices, GL back-ends and encoders found", 0, 0, "orzo devices"},
};

static OzStatus wrong(const char *argument, const char *expected)
{
    return oz_status_fail(OZ_ERR_INPUT, "orzo: '%s' is wrong; expected %s", argument, expected);
}

static OzStatus parse_gl(OzOptions *options, const char *value)
{
    if (strcmp(value, "egl") == 0) {
        options->gl = OZ_GL_EGL;
    } else if (strcmp(value, "osmesa") == 0) {
        options->gl = OZ_GL_OSMESA;
    } else if (strcmp(value, "host") == 0) {
        options->gl = OZ_GL_HOST;
    } else {
        return wrong(value, "--gl egl, --gl osmesa or --gl host");
    }
    return OZ_OK;
}

static OzStatus parse_threads(OzOptions *options, const char *value)
{
    char *end = NULL;
    long number = strtol(value, &end, 10);
    if (*value == '\0' || *end || number < 1 || number > 4096) {
        return wrong(value, "--threads with a number from 1 to 4096");
    }
    options->threads = (int)number;
    return OZ_OK;
}

static OzStatus parse_seeds(OzOptions *options, const char *value)
{
    unsigned long long first = 0, last = 0;
    int used = 0;
    bool good = isdigit((unsigned char)value[0]) && strlen(value) < 40 &&
                sscanf(value, "%llu..%n", &first, &used) == 1 && used > 0 &&
                isdigit((unsigned char)value[used]);
    int rest = used;
    good = good && sscanf(value + rest, "%llu%n", &last, &used) == 1 && !value[rest + used];
    if (!good || last < first || last - first >= OZ_CLI_SEEDS_MAX || last > INT64_MAX) {
        return wrong(value, "--seeds A..B, as in 1..20, at most 100000 of them");
    }
    options->has_seeds = true;
    options->seed_first = first;
    options->seed_last = last;
    return OZ_OK;
}

static OzStatus parse_part(OzOptions *options, const char *value)
{
    int used = 0;
    bool good = isdigit((unsigned char)value[0]) && strlen(value) < 20 &&
                sscanf(value, "%d/%d%n", &options->part, &options->parts, &used) == 2 &&
                !value[used];
    return good && options->part >= 1 && options->part <= options->parts
               ? OZ_OK
               : wrong(value, "--part K/M, as in 3/20: the K-th of M parts");
}

static bool read_number(const char *value, double *number)
{
    char *end = NULL;
    *number = strtod(value, &end);
    return *value && !*end && isfinite(*number);
}

static OzStatus parse_until(OzOptions *options, const char *value)
{
    bool good = read_number(value, &options->until) && options->until >= 0;
    return good ? OZ_OK : wrong(value, "--until with a time in s, 0 or later");
}

static OzStatus parse_pace(OzOptions *options, const char *value)
{
    options->has_pace = true;
    bool good = !value || (read_number(value, &options->pace) && options->pace >= 0);
    return good ? OZ_OK
                : wrong(value, "--realtime with simulated seconds a second, as in 0.1, or none: as "
                               "the movie shows");
}

static OzStatus parse_budget(OzOptions *options, const char *value)
{
    bool good = read_number(value, &options->budget) && options->budget > 0;
    return good ? OZ_OK : wrong(value, "--budget with seconds above 0");
}

static OzStatus parse_tolerance(OzOptions *options, const char *value)
{
    bool good = read_number(value, &options->tolerance) && options->tolerance > 0;
    return good ? OZ_OK : wrong(value, "--tolerance with an error above 0, as in 0.01");
}

/* Below a hundredth more spans of touching could count than are kept. */
static OzStatus parse_share(OzOptions *options, const char *value)
{
    bool good = read_number(value, &options->share) && options->share >= 0.01;
    return good && options->share <= 1 ? OZ_OK
                                       : wrong(value, "--share with a number from 0.01 to 1, as "
                                                      "in 0.05");
}

static OzStatus parse_every(OzOptions *options, const char *value)
{
    char *end = NULL;
    options->every = strtoll(value, &end, 10);
    if (*value == '\0' || *end || options->every < 1) {
        return wrong(value, "--every with a whole number above 0");
    }
    return OZ_OK;
}

static OzStatus add_setting(OzOptions *options, const char *value)
{
    if (options->setting_count == OZ_CLI_SETTINGS_MAX) {
        return wrong(value, "at most 128 settings");
    }
    if (!strchr(value, '=')) {
        return wrong(value, "--set key=value");
    }
    options->settings[options->setting_count++] = (char *)(size_t)value;
    return OZ_OK;
}

/* --precision is a setting by another name. */
static OzStatus parse_precision(OzOptions *options, const char *value)
{
    if (strcmp(value, "float") == 0) {
        return add_setting(options, "precision=float");
    }
    if (strcmp(value, "double") == 0) {
        return add_setting(options, "precision=double");
    }
    return wrong(value, "--precision float or --precision double");
}

static OzStatus parse_serve(OzOptions *options, const char *value)
{
    options->serve = true;
    options->serve_port = value ? (int)strtol(value, NULL, 10) : 0;
    return value && (strlen(value) > 5 || options->serve_port > 65535)
               ? wrong(value, "--serve with a port from 1 to 65535, or none")
               : OZ_OK;
}

static const OzCliOption option_rows[] = {
#define FLAG(member)           .kind = OZ_CLI_FLAG, .offset = offsetof(OzOptions, member)
#define TEXT(member)           .kind = OZ_CLI_TEXT, .offset = offsetof(OzOptions, member)
#define NAME(member, expected) TEXT(member), .wanted = expected
#define OWN(function)          .kind = OZ_CLI_OWN, .parse = function
    {'o', "-o", "DIR",
     "folder to write (default runs/<scene name>; of figures runs/<study name>, of draw DIR/draw, of "
     "export DIR/export, of bench and report their names)",
     NAME(out, "-o with the name of a folder")},
    {'O', "--overwrite", NULL, "replace the run that is there", FLAG(overwrite)},
    {'s', "--set", "key=value", "change a scene key, as in contact.friction=0.2", OWN(add_setting)},
    {'e', "--seeds", "A..B", "a run for each seed, side by side, and a table of all",
     OWN(parse_seeds)},
    {'K', "--part", "K/M", "only the K-th of M parts of --seeds, into its own folder below (orzo gather)",
     OWN(parse_part)},
    {'r', "--from", "DIR[@tap=N]",
     "begin with the grains of a run's last state, springs included, or of a kept one (@time=T)",
     TEXT(from)},
    {'d', "--device", "ID|cpu|gpu", "OpenCL device (default: a GPU, else the CPU)", TEXT(device)},
    {'t', "--threads", "N", "threads of a CPU device", OWN(parse_threads)},
    {'p', "--precision", "float|double", "the same as --set precision=...", OWN(parse_precision)},
    {'g', "--gl", "egl|osmesa|host", "how to draw off-screen", OWN(parse_gl)},
    {'u', "--until", "T", "stop at time T, s", OWN(parse_until)},
    {'w', "--watch", NULL, "take what is changed in the scene file while it runs", FLAG(watch)},
    {'R', "--replay", NULL, "SCENE is a run's folder: that run again, with its changes",
     FLAG(replay)},
    {'P', "--realtime", "[F]",
     "no faster than F simulated seconds a second (default: as the movie shows; no movie: 1)",
     OWN(parse_pace)},
    {'n', "--no-video", NULL, "neither movie nor pictures; `orzo draw` can make them later",
     FLAG(no_video)},
    {'m', "--stream", "FILE|-",
     "pictures as they are drawn, as Matroska: into a new file, a named pipe or a pipe",
     NAME(stream, "--stream with the name of a file, or -")},
    {'l', "--latest", NULL, "keep latest.png, the newest picture, in the folder", FLAG(latest)},
    {'V', "--serve", "[PORT]",
     "show the run on a page of this machine alone, whose address is printed (default: a free "
     "port)",
     OWN(parse_serve)},
    {'f', "--force", NULL, "only warn of a step at which a contact is unstable", FLAG(force)},
    {'S', "--source-dir", "DIR", "read kernels and shaders from a source folder", TEXT(source_dir)},
    {'Q', "--quick", NULL, "in minutes: a short ladder; of figures few taps and seeds", FLAG(quick)},
    {'N', "--only", "FIGURE", "of figures: this one alone", NAME(only, "--only with a figure's name")},
    {'F', "--features", NULL, "what each feature of an6 costs, too", FLAG(features)},
    {'z', "--sizes", "N,N,...", "the ladder's numbers of grains", TEXT(sizes)},
    {'C', "--compare", "OLD.json", "another run's bench.json: rows of both side by side", TEXT(compare)},
    {'b', "--budget", "S", "seconds that all timed pieces together shall take", OWN(parse_budget)},
    {'y', "--yardstick", "PROGRAM", "the scalar yardstick (default: found beside orzo)",
     TEXT(yardstick)},
    {'T', "--tolerance", "X", "error to be met; prints the cheapest setting, ready to paste",
     OWN(parse_tolerance)},
    {'X', "--extreme", NULL, "stiff and extreme cases instead: expected, got, verdict",
     FLAG(extreme)},
    {'M', "--map", NULL, "stability map over steps per contact and restitution instead", FLAG(map)},
    {'B', "--stability", NULL, "the largest stable step of each scene's settled bed instead",
     FLAG(stability)},
    {'E', "--ensemble", NULL, "a shaken bed at every step and integrator, for many seeds, instead",
     FLAG(ensemble)},
    {'H', "--hits", NULL,
     "how often two grains hit and how they spin then, for each value, instead", FLAG(hits)},
    {'A', "--validate", NULL,
     "results that are known beside ours instead, of all experiments or of those named",
     FLAG(validate)},
    {'a', "--to", "FORMAT", "vtk, xyz, h5md or csv, or several with commas between",
     NAME(to, "--to with vtk, xyz, h5md or csv")},
    {'j', "--against", "COLUMN", "along x: step, time or tap (default: tap where there is one)",
     TEXT(against)},
    {'k', "--every", "N", "only each N-th frame", OWN(parse_every)},
    {'v', "--verbose", NULL, "kernel switches, what is left out, device memory, too",
     FLAG(verbose)},
    {'x', "--share", "X", "of --hits: from which share of the impulse a hit counts (default 0.05)",
     OWN(parse_share)},
    {'c', "--columns", NULL, "the columns of series.csv instead", FLAG(columns)},
};

enum {
    COMMANDS = sizeof command_rows / sizeof command_rows[0],
    OPTIONS = sizeof option_rows / sizeof option_rows[0]
};

int oz_cli_commands(const OzCliCommand **rows)
{
    *rows = command_rows;
    return COMMANDS;
}

int oz_cli_options(const OzCliOption **rows)
{
    *rows = option_rows;
    return OPTIONS;
}

const char *oz_cli_summary(void)
{
    return "granular matter computed with OpenCL, shown as a movie, with its error stated";
}

const char *oz_cli_statuses(void)
{
    return "0 done; 1 something failed or a guard stopped a run; 2 a scene, key or\n"
           "option refused, of `check` also a step that `run` would refuse; 130 interrupted";
}

static int find_command(const char *name)
{
    for (int c = 0; c < COMMANDS; c++) {
        if (strcmp(command_rows[c].name, name) == 0) {
            return c;
        }
    }
    return -1;
}

static int find_option(const char *name)
{
    for (int o = 0; o < OPTIONS; o++) {
        if (strcmp(option_rows[o].name, name) == 0) {
            return o;
        }
    }
    return -1;
}

static void print_command(int c)
{
    printf("orzo %s%s%s\n    %s\n", command_rows[c].name, command_rows[c].most_paths ? " " : "",
           command_rows[c].arguments, command_rows[c].help);
    for (int o = 0; o < OPTIONS; o++) {
        if (strchr(command_rows[c].takes, option_rows[o].letter)) {
            printf("    %-13s %-12s %s\n", option_rows[o].name,
                   option_rows[o].value ? option_rows[o].value : "", option_rows[o].help);
        }
    }
}

void oz_cli_help(const char *command)
{
    int only = command ? find_command(command) : -1;
    if (only < 0) {
        printf("orzo: %s\n\n", oz_cli_summary());
    }
    for (int c = 0; c < COMMANDS; c++) {
        if (only < 0 || c == only) {
            print_command(c);
        }
    }
    if (only >= 0) {
        printf("example: %s\n", command_rows[only].example);
    }
    if (only < 0) {
        printf("orzo --help | --version | --man\n\nexit status: %s\n", oz_cli_statuses());
    }
}

static OzStatus take_option(OzOptions *options, int o, const char *value)
{
    void *member = (char *)options + option_rows[o].offset;
    if (option_rows[o].kind == OZ_CLI_OWN) {
        return option_rows[o].parse(options, value);
    }
    if (option_rows[o].kind == OZ_CLI_FLAG) {
        *(bool *)member = true;
        return OZ_OK;
    }
    *(const char **)member = value;
    return option_rows[o].wanted && !value[0] ? wrong(value, option_rows[o].wanted) : OZ_OK;
}

/* Whether an argument is the number that an option may have, or the next option, a name or none. */
static bool is_number(const char *argument)
{
    bool begins = argument && (isdigit((unsigned char)*argument) || *argument == '.');
    return begins && !argument[strspn(argument, "0123456789.e+-")];
}

/* Says which of the command's options may have been meant. */
static OzStatus refuse_option(const char *argument, int command)
{
    char expected[128];
    const char *near = NULL, *name = command_rows[command].name, *takes = command_rows[command].takes;
    int best = oz_spelling_slips(strlen(argument)) + 1;
    for (int o = 0; o < OPTIONS; o++) {
        const char *other = option_rows[o].name;
        bool nearer = strchr(takes, option_rows[o].letter) && oz_spelling_nears(argument, other, &best);
        near = nearer ? other : near;
    }
    snprintf(expected, sizeof expected, near ? "did you mean %s?" : "expected an option of `orzo %s`",
             near ? near : name);
    return oz_status_fail(OZ_ERR_INPUT, "orzo: '%s' is wrong; %s (see orzo %s --help)", argument,
                          expected, name);
}

static OzStatus take_argument(OzOptions *options, int command, int argc, char **argv, int *i)
{
    const char *argument = argv[*i];
    if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0) {
        options->help = true;
        return OZ_OK;
    }
    if (argument[0] != '-' || argument[1] == '\0') {
        if (options->path_count == OZ_CLI_PATHS_MAX) {
            return wrong(argument, "fewer arguments");
        }
        options->paths[options->path_count++] = argument;
        return OZ_OK;
    }
    int o = find_option(argument);
    if (o < 0 || !strchr(command_rows[command].takes, option_rows[o].letter)) {
        return refuse_option(argument, command);
    }
    const char *wanted = option_rows[o].value, *next = *i + 1 < argc ? argv[*i + 1] : NULL;
    if (wanted && wanted[0] == '[' && !is_number(next)) {
        return take_option(options, o, NULL); /* its value may be left out */
    }
    if (wanted && !next) {
        return oz_status_fail(OZ_ERR_INPUT, "orzo: %s is missing; expected %s %s", wanted, argument,
                              wanted);
    }
    return take_option(options, o, wanted ? argv[++*i] : NULL);
}

static OzStatus check_count(const OzOptions *options, int command)
{
    const char *name = command_rows[command].name, *arguments = command_rows[command].arguments;
    int most = command_rows[command].most_paths;
    if (options->path_count < command_rows[command].least_paths) {
        return oz_status_fail(OZ_ERR_INPUT, "orzo: %s is missing; expected orzo %s %s", arguments,
                              name, arguments);
    }
    if (options->path_count > most) {
        return oz_status_fail(OZ_ERR_INPUT, "orzo: '%s' is one too many; expected orzo %s%s%s",
                              options->paths[most], name, most ? " " : "", arguments);
    }
    return OZ_OK;
}

static const char command_names[] =
    "run, resume, gather, check, draw, export, plot, figures, keys, "
    "bench, report or devices (see orzo --help)";

OzStatus oz_cli_parse(OzOptions *options, int argc, char **argv)
{
    memset(options, 0, sizeof *options);
    options->until = -1;
    if (argc < 2) {
        return oz_status_fail(OZ_ERR_INPUT, "orzo: no command; expected %s", command_names);
    }
    options->command = argv[1];
    int command = find_command(argv[1]);
    if (command < 0) {
        return wrong(argv[1], command_names);
    }
    for (int i = 2; i < argc; i++) {
        OZ_PASS(take_argument(options, command, argc, argv, &i));
    }
    return options->help ? OZ_OK : check_count(options, command);
}
