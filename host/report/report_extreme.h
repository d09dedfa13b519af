/* `orzo report --extreme`: stiff and extreme cases, each with what must come out. Nothing may be
 * silently wrong: a case is right, or it is refused with a message. */
#pragma once

#include "cli.h"
#include "compute/device.h"
#include "report/report_extreme_cases.h"

typedef enum OzVerdict {
    OZ_VERDICT_RIGHT,   /* the value is in its range                                       */
    OZ_VERDICT_REFUSED, /* it was not computed, or stopped, with a message, as it should be */
    OZ_VERDICT_STOPPED, /* it was, though it should have been computed, or for another reason */
    OZ_VERDICT_WRONG    /* a result out of its range and no message                        */
} OzVerdict;

typedef struct OzExtremeOutcome {
    OzVerdict verdict;
    double value;      /* NAN when there is none */
    char message[240]; /* of a refusal           */
} OzExtremeOutcome;

/* Whether the row is for numbers of this precision. */
bool oz_report_extreme_serves(const OzExtremeCase *row, OzPrecision precision);

/* Runs one case. brief takes the row's short duration. A refusal or a blow-up is an outcome; fails
 * only when the device does. */
OzStatus oz_report_extreme_try(OzExtremeOutcome *outcome, const OzExtremeCase *row,
                               const OzDevice *device, OzPrecision precision, bool brief,
                               const char *source_dir);

/* Runs every case in float and double (--quick: the short durations) and prints the table. Fails
 * with OZ_ERR_BLOWUP when a row is not as it should be. */
OzStatus oz_report_extreme_run(const OzOptions *options);
