/* The command's options, handed to those who plot. */
#include "command/plot_folder.h"

#include "base/log.h"
#include "plot/plot.h"

OzStatus oz_plot_folder_run(const OzOptions *options)
{
    const char *columns[OZ_CLI_PATHS_MAX];
    int count = options->path_count - 1;
    for (int i = 0; i < count; i++) {
        columns[i] = options->paths[i + 1];
    }
    OzStatus status = oz_plot_draw(&(OzPlot){.folder = options->paths[0],
                                             .out = options->out,
                                             .columns = count ? columns : NULL,
                                             .count = count,
                                             .against = options->against});
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
