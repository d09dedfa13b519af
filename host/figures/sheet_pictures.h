/* The single pictures of a sheet, drawn from a run's stored frames as `orzo draw` does. */
#pragma once

#include "figures/figure_work.h"

/* Pictures of one run in one view, in the order of time. Zeroed is empty. */
typedef struct OzSheetRow {
    const OzStudyRun *run;
    const char *view; /* NULL: the scene's own */
    char *member;     /* owned: the folder of the one that is shown */
    OzTexts files;    /* owned                 */
} OzSheetRow;

/* Draws the pictures of the run's first member that the figure asks for, below folder/pictures;
 * view may be NULL. What is asked for beyond the run's end is left out. The caller frees, also on
 * failure. */
OzStatus oz_sheet_pictures_draw(const OzFigureWork *work, OzSheetRow *row);
void oz_sheet_pictures_free(OzSheetRow *row);

/* What a picture shows by its file's name, as in "tap 300" or "0.25 s"; empty of a strobe's. */
void oz_sheet_pictures_say(const char *file, char *text, size_t size);
