/* `orzo report --validate`: quantities whose values are known from the literature, beside ours. */
#pragma once

#include "cli.h"
#include "report/report_known.h"

/* How ours, a mean and the half-width of its 95 % interval, lies to the literature's interval:
 * AGREES, both have a part in common; UNDECIDED, they have, but ours is wider than the other and
 * reaches beyond it; DIFFERS, they have none, or there is no value. */
typedef enum OzAgreement { OZ_AGREES, OZ_UNDECIDED, OZ_DIFFERS } OzAgreement;

OzAgreement oz_report_validate_judge(const OzKnown *known, double mean, double interval);

/* Makes the experiments named by options->paths (names, or scenes of these names), else all, prints
 * the table and leaves folder/validation.csv. Fails with OZ_ERR_INPUT for a name that is not in the
 * list, with OZ_ERR_BLOWUP where a quantity differs and no cause is known. */
OzStatus oz_report_validate_run(const OzOptions *options, const char *folder);
