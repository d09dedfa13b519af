/* `orzo draw`: pictures and movie again from a run's folder. */
#ifndef OZ_STUDY_REDRAW_H
#define OZ_STUDY_REDRAW_H

#include "cli.h"

OzStatus oz_redraw_folder(const OzOptions *options);

#endif
