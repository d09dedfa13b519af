/* The program: one sub-command, its exit status. */
#include "base/interrupt.h"
#include "base/log.h"
#include "base/streams.h"
#include "bench/bench.h"
#include "cli.h"
#include "command/export_folder.h"
#include "command/gather.h"
#include "command/inspect.h"
#include "command/manual.h"
#include "command/plot_folder.h"
#include "command/ranks.h"
#include "command/redraw.h"
#include "compute/device.h"
#include "draw/movie.h"
#include "draw/renderer.h"
#include "figures/figures.h"
#include "observe/series.h"
#include "report/report.h"
#include "run/run.h"
#include "scene/describe.h"

#include <stdio.h>
#include <string.h>

static OzStatus run_command(const OzOptions *options)
{
    oz_interrupt_watch();
    return oz_ranks_run(options);
}

static OzStatus resume_command(const OzOptions *options)
{
    oz_interrupt_watch();
    return oz_run_resume(options);
}

static OzStatus gather_command(const OzOptions *options)
{
    return oz_gather_run(options);
}

static OzStatus check_command(const OzOptions *options)
{
    return oz_inspect_scene(options, stdout);
}

static OzStatus draw_command(const OzOptions *options)
{
    return oz_redraw_folder(options);
}

static OzStatus export_command(const OzOptions *options)
{
    oz_interrupt_watch();
    return oz_export_folder_run(options);
}

static OzStatus plot_command(const OzOptions *options)
{
    return oz_plot_folder_run(options);
}

static OzStatus figures_command(const OzOptions *options)
{
    oz_interrupt_watch();
    return oz_figures_run(options);
}

static OzStatus list_keys(const char *part)
{
    OzStatus status = OZ_OK;
    if (!oz_describe_keys(part, stdout)) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "no key holds %s; expected a part of one that "
                                "orzo keys lists",
                                part);
        oz_log_line("%s", oz_status_text());
    }
    return status;
}

static OzStatus keys_command(const OzOptions *options)
{
    static const char *const models[] = {
        [OZ_COLUMN_RODS] = "rods", [OZ_COLUMN_TRIGRAINS] = "trigrains", [OZ_COLUMN_ALL] = "all"};
    if (!options->columns) {
        return list_keys(options->path_count ? options->paths[0] : NULL);
    }
    for (const OzColumn *column = oz_series_columns(); column->name; column++) {
        printf("%-21s %-8s %-10s %s\n", column->name, column->unit, models[column->models],
               column->meaning);
    }
    return OZ_OK;
}

static OzStatus bench_command(const OzOptions *options)
{
    return oz_bench_run(options);
}

static OzStatus report_command(const OzOptions *options)
{
    return oz_report_run(options);
}

static OzStatus devices_command(const OzOptions *options)
{
    const char *encoder = NULL;
    (void)options;
    oz_renderer_describe(stdout); /* forks: before OpenCL starts its threads */
    if (oz_movie_encoder(&encoder) == OZ_OK) {
        printf("encoder: %s\n", encoder);
    } else {
        printf("encoder: none: %s\n", oz_status_text());
    }
    return oz_device_list(stdout);
}

static const struct {
    const char *name;
    OzStatus (*run)(const OzOptions *options);
} commands[] = {
    {"run", run_command},       {"resume", resume_command},   {"check", check_command},
    {"gather", gather_command}, {"draw", draw_command},       {"export", export_command},
    {"keys", keys_command},     {"plot", plot_command},       {"bench", bench_command},
    {"report", report_command}, {"figures", figures_command}, {"devices", devices_command},
};

static OzStatus help_or_run(const OzOptions *options)
{
    if (options->help) {
        oz_cli_help(options->command);
        return OZ_OK;
    }
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        if (strcmp(commands[i].name, options->command) == 0) {
            return commands[i].run(options);
        }
    }
    return OZ_ERR_INPUT;
}

static OzStatus obey(int argc, char **argv)
{
    OzOptions options;
    if (argc > 1 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)) {
        oz_cli_help(NULL);
        return OZ_OK;
    }
    if (argc > 1 && strcmp(argv[1], "--version") == 0) {
        printf("orzo %s\n", ORZO_VERSION);
        return OZ_OK;
    }
    if (argc > 1 && strcmp(argv[1], "--man") == 0) {
        return oz_manual_print(stdout);
    }
    OzStatus status = oz_cli_parse(&options, argc, argv);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
        return status;
    }
    return help_or_run(&options);
}

int main(int argc, char **argv)
{
    OzLog *log = NULL;
    oz_streams_open();
    OzStatus status = oz_log_create(&log, stderr, false);
    oz_log_use(log);
    if (status == OZ_OK) {
        status = obey(argc, argv);
    } else {
        oz_log_line("%s", oz_status_text());
    }
    OzStatus printed = oz_streams_flush();
    if (printed != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    oz_log_use(NULL);
    oz_log_free(log);
    return oz_status_exit_code(status == OZ_OK ? printed : status);
}
