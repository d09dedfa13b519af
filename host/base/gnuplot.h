/* Pictures drawn by gnuplot, where it is installed. */
#pragma once

#include "base/status.h"

#include <stdio.h>

/* Starts it for a picture of a folder, whose commands then go to *gnuplot. NULL where it is not
 * installed, which the log is told. */
OzStatus oz_gnuplot_open(FILE **gnuplot, const char *folder, const char *picture);

/* Waits until it has drawn. Fails with OZ_ERR_FILE where it could not. Nothing for NULL. */
OzStatus oz_gnuplot_close(FILE *gnuplot, const char *folder, const char *picture);
