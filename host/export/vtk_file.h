/* One VTK file of polygonal data (.vtp) or of equal cells (.vti): XML, with the arrays behind it as
 * raw bytes of this machine's order, which every reader of VTK takes. */
#pragma once

#include <stdint.h>
#include <stdio.h>

typedef struct OzVtkArray {
    const char *name;
    int width;         /* numbers of a point or cell */
    const float *data; /* borrowed                   */
} OzVtkArray;

typedef enum OzVtkCells { OZ_VTK_VERTICES, OZ_VTK_LINES, OZ_VTK_POLYGONS } OzVtkCells;

/* All borrowed. Cell i has the points corner[end[i - 1]] to corner[end[i] - 1]. */
typedef struct OzVtkFile {
    double time; /* s */
    const float *points;
    int64_t point_count;
    OzVtkCells cells;
    const int64_t *corners, *ends;
    int64_t cell_count;
    const OzVtkArray *point_arrays, *cell_arrays;
    int point_array_count, cell_array_count;
} OzVtkFile;

/* The caller looks whether file took it all. */
void oz_vtk_file_write(const OzVtkFile *vtk, FILE *file);

/* Cells along x, y and z, the first beginning at `low` (m), each of `edge` (m); arrays are of
 * cells, x fastest. All borrowed. */
typedef struct OzVtkImage {
    double time; /* s */
    const int64_t *cells;
    const double *low, *edge;
    const OzVtkArray *arrays;
    int array_count;
} OzVtkImage;

void oz_vtk_file_write_image(const OzVtkImage *image, FILE *file);
