/* What a scene says of the tables that a run writes at moments of their own. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* contacts.csv */
typedef struct OzContactTable {
    bool present;
    double interval;      /* s between its moments; or:               */
    double interval_taps; /* periods; both 0: the rows of series.csv  */
} OzContactTable;

/* fields.csv */
typedef struct OzFieldTable {
    bool present;
    double interval, interval_taps; /* as of contacts                                            */
    int64_t cells[3];               /* along x, y, z; of an axis with one: the mean along it     */
    double width;                   /* m, half of what a grain is spread over along each axis    */
    double range[3][2];             /* m, from where to where cells are, of each axis            */
    bool has_range[3];              /* written; else orzo chooses                                */
    double mean_from;               /* s: moments from here on are in the mean over the run      */
    bool vtk;                       /* files for ParaView, too                                   */
} OzFieldTable;
