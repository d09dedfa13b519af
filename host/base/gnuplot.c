/* Starting gnuplot, and its end. */
#include "base/gnuplot.h"

#include "base/log.h"

#include <stdlib.h>

OzStatus oz_gnuplot_open(FILE **gnuplot, const char *folder, const char *picture)
{
    *gnuplot = NULL;
    if (system("command -v gnuplot >/dev/null 2>&1") != 0) {
        oz_log_line("no %s/%s: gnuplot is not installed", folder, picture);
        return OZ_OK;
    }
    *gnuplot = popen("gnuplot", "w");
    return *gnuplot ? OZ_OK : oz_status_fail(OZ_ERR_FILE, "cannot start gnuplot");
}

OzStatus oz_gnuplot_close(FILE *gnuplot, const char *folder, const char *picture)
{
    return !gnuplot || pclose(gnuplot) == 0
               ? OZ_OK
               : oz_status_fail(OZ_ERR_FILE, "gnuplot could not draw %s/%s", folder, picture);
}
