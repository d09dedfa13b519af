/* `orzo report`: what the error of a setting costs in time, how far the theory of stability holds,
 * and how extreme cases fare. */
#pragma once

#include "cli.h"

/* Work-precision study of the scenes given, each a row of report_cases.h: prints one sentence for
 * each and leaves DIR/report.csv and a picture of each scene (PNG and SVG). A setting that fails is
 * listed with its reason. A scene without a row gets the study of report_own.h, on the first
 * device. --device may be a list, as in cpu,gpu: a curve for each. With --extreme, --map,
 * --stability, --ensemble, --hits or --validate the study of that name instead. */
OzStatus oz_report_run(const OzOptions *options);
