/* The pixels of a picture whose middles lie within a radius of a line: what a rod's outline holds.
 */
#pragma once

/* Pixels; the first one's middle is at 0.5, 0.5. */
typedef struct OzStadium {
    double ends[2][2], radius, length;
    double along[2], inverse[2]; /* a unit vector; inverse of its parts */
} OzStadium;

/* From the first to before the end; none where the end is not after it. */
typedef struct OzStadiumSpan {
    int first, end;
} OzStadiumSpan;

OzStadium oz_stadium_make(const double a[2], const double b[2], double radius);

/* Rows, of so many, that hold any. */
OzStadiumSpan oz_stadium_rows(const OzStadium *stadium, int row_count);

/* A row's columns, of so many. */
OzStadiumSpan oz_stadium_row(const OzStadium *stadium, int row, int column_count);

/* The pixel that holds a place along a row or column, not below 0, and the one after it, of so
 * many. */
int oz_stadium_first(double place);
int oz_stadium_end(double place, int count);
