/* THE list of observables: the columns of series.csv, `orzo keys --columns` and the README's table
 * are this list. A new observable is one function and one row. */
#pragma once

#include "observe/column.h"

OzTapSample oz_observables_sample(OzMeasure *measure, const OzSnapshot *snapshot);

/* The rows in the order of series.csv, ending with a NULL name. */
const OzColumn *oz_observables_list(void);

/* How many cells of a row are the column's: 0 in scenes that have not got it. */
int oz_observables_cells(const OzColumn *column, const OzScene *scene);

/* How many they are in a scene that has got it, alike in all else. */
int oz_observables_width(const OzColumn *column, const OzScene *scene);

/* The name of one of them, counted from 0. */
void oz_observables_name(const OzColumn *column, const OzScene *scene, int cell,
                         char name[OZ_COLUMN_NAME]);

/* Kinetic + rotational + potential + stored + dissipated (friction too) - work of the walls, J:
 * constant but for the error of integration. */
double oz_observables_energy(const OzSnapshot *snapshot);

/* What of it is dissipated, friction too, J; 0 without a ledger. */
double oz_observables_lost(const OzSnapshot *snapshot);
