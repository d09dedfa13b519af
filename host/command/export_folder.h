/* `orzo export`: the stored frames of a run's folder in files that other programs read. */
#pragma once

#include "cli.h"

OzStatus oz_export_folder_run(const OzOptions *options);
