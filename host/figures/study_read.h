/* Reading a study's file. */
#pragma once

#include "figures/study.h"

/* Reads it. Fails with OZ_ERR_INPUT and every error as `file:line: what is wrong; what was
 * expected`. The caller frees with oz_study_read_free, also on failure. */
OzStatus oz_study_read_file(OzStudy *study, const char *path);
void oz_study_read_free(OzStudy *study);
