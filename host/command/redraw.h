/* `orzo draw`: pictures and movie again from a run's folder. */
#pragma once

#include "cli.h"

OzStatus oz_redraw_folder(const OzOptions *options);
