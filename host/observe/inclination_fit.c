/* Gathering the points, and the fit in words and numbers. */
#include "observe/inclination_fit.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "observe/power_fit.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const file_name = "inclination_fit.csv";

bool oz_inclination_fit_applies(const char *key)
{
    const char *end = ".motion.angular_velocity";
    size_t length = key ? strlen(key) : 0;
    return length > strlen(end) && !strchr(key, ',') &&
           strcmp(key + length - strlen(end), end) == 0;
}

OzStatus oz_inclination_fit_add(OzInclinationFit *fit, double speed, double inclination)
{
    if (fit->count == fit->capacity) {
        size_t old = (size_t)fit->capacity, wanted = 2 * old + 16;
        OZ_PASS(oz_memory_grow((void **)&fit->speed, old, wanted, sizeof *fit->speed, "speeds"));
        OZ_PASS(oz_memory_grow((void **)&fit->inclination, old, wanted, sizeof *fit->inclination,
                               "inclinations"));
        fit->capacity = (int)wanted;
    }
    fit->speed[fit->count] = fabs(speed);
    fit->inclination[fit->count++] = inclination;
    return OZ_OK;
}

static OzStatus write_row(const OzPowerFit *f, int count, const char *folder)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, folder, file_name));
    OZ_TRY(oz_folder_note(folder, file_name));
    FILE *file = fopen(path, "w");
    bool bad = !file || fprintf(file,
                                "theta_c,b,p,p_low,p_high,residual_rms,speeds\n"
                                "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%d\n",
                                f->constant, f->factor, f->exponent, f->exponent_low,
                                f->exponent_high, f->residual, count) < 0;
    if (file) {
        bad |= fclose(file) != 0;
    }
    if (bad) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
done:
    free(path);
    return status;
}

OzStatus oz_inclination_fit_write(const OzInclinationFit *fit, const char *folder)
{
    OzPowerFit f;
    if (fit->count == 0) {
        return OZ_OK;
    }
    if (!oz_power_fit_find(&f, fit->speed, fit->inclination, fit->count)) {
        oz_log_line("inclination: no fit of Theta_c + b Omega^p, which needs %d different speeds "
                    "or more with an inclination; there are %d values",
                    OZ_POWER_FIT_POINTS, fit->count);
        return OZ_OK;
    }
    oz_log_line("inclination: Theta_c + b Omega^p with Theta_c %.4g degrees, b %.4g, p %.3g "
                "(95 %%: %.3g to %.3g%s); root mean square of the residuals %.2g degrees, %d "
                "speeds; %s",
                f.constant, f.factor, f.exponent, f.exponent_low, f.exponent_high,
                f.open ? ", an end of the search: these speeds do not say p" : "", f.residual,
                fit->count, file_name);
    return write_row(&f, fit->count, folder);
}

void oz_inclination_fit_free(OzInclinationFit *fit)
{
    free(fit->speed);
    free(fit->inclination);
    *fit = (OzInclinationFit){0};
}
