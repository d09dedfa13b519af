/* Files of equal cells. */
#include "export/coarse_images.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/memory.h"
#include "export/part_file.h"
#include "export/vtk_file.h"
#include "export/vtk_index.h"

#include <stdio.h>
#include <stdlib.h>

static const char INDEX[] = "fields/fields.pvd", PART[] = "fields/fields.part";

struct OzCoarseImages {
    char *folder;   /* owned                                    */
    FILE *index;    /* NULL: not begun yet                      */
    int64_t number; /* of the next moment                       */
    int64_t whole;  /* bytes of the index up to the last moment */
};

OzStatus oz_coarse_images_create(OzCoarseImages **images, const char *folder)
{
    OzStatus status = OZ_OK;
    char *own = NULL;
    OZ_TRY(OZ_NEW(images, 1));
    OZ_TRY(oz_memory_text(&(*images)->folder, folder));
    OZ_TRY(oz_file_join(&own, folder, "fields"));
    OZ_TRY(oz_file_make_folder(own));
done:
    free(own);
    return status;
}

OzStatus oz_coarse_images_state(OzCoarseImages *images, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_state_enter(visit, "field_images", 1));
    OZ_TRY(oz_state_index(visit, "number", &images->number, 0, INT64_MAX));
    OZ_TRY(oz_state_index(visit, "index_bytes", &images->whole, 0, INT64_MAX));
    oz_state_leave(visit);
    if (visit->is_loading && images->number > 0) {
        OZ_TRY(oz_file_join(&path, images->folder, INDEX));
        OZ_TRY(oz_vtk_index_go_on(&images->index, path, images->whole));
    }
done:
    free(path);
    return status;
}

/* The arrays of an image, one behind the other in *numbers, which the caller frees. */
static OzStatus fill_arrays(OzVtkArray *arrays, int *count, float **numbers,
                            const OzCoarseRows *rows, bool mean)
{
    double factor = 1, found[OZ_COARSE_NUMBERS];
    const double *sums = oz_coarse_rows_last(rows, mean, &factor);
    int64_t cells = oz_coarse_grid_count(oz_coarse_rows_grid(rows));
    OZ_PASS(OZ_NEW(numbers, OZ_COARSE_NUMBERS * cells));
    float *next = *numbers;
    *count = 0;
    for (const OzCoarseColumn *c = oz_coarse_columns_all(); c->name; c++) {
        arrays[(*count)++] = (OzVtkArray){c->name, c->width, next};
        next += c->width * cells;
    }
    for (int64_t i = 0; i < cells; i++) {
        int number = 0;
        oz_coarse_columns_find(&sums[i * OZ_COARSE_COUNT], factor, found);
        next = *numbers;
        for (int a = 0; a < *count; a++) {
            for (int k = 0; k < arrays[a].width; k++) {
                next[i * arrays[a].width + k] = (float)found[number++];
            }
            next += arrays[a].width * cells;
        }
    }
    return OZ_OK;
}

static OzStatus write_image(OzCoarseImages *images, const OzCoarseRows *rows, double time,
                            bool mean, const char *name)
{
    OzStatus status = OZ_OK;
    OzVtkArray arrays[OZ_COARSE_NUMBERS];
    const OzCoarseGrid *grid = oz_coarse_rows_grid(rows);
    float *numbers = NULL;
    FILE *file = NULL;
    double edge[3];
    OzVtkImage image = {
        .time = time, .cells = grid->cells, .low = grid->low, .edge = edge, .arrays = arrays};
    for (int axis = 0; axis < 3; axis++) {
        edge[axis] = (grid->high[axis] - grid->low[axis]) / (double)grid->cells[axis];
    }
    OZ_TRY(fill_arrays(arrays, &image.array_count, &numbers, rows, mean));
    OZ_TRY(oz_part_file_create(&file, images->folder, PART));
    oz_vtk_file_write_image(&image, file);
    OZ_TRY(oz_part_file_place(file, images->folder, PART, name));
done:
    free(numbers);
    return status;
}

OzStatus oz_coarse_images_add(OzCoarseImages *images, const OzCoarseRows *rows, double time)
{
    char name[64], *beside = name + sizeof "fields/" - 1;
    snprintf(name, sizeof name, "fields/fields_%05lld.vti", (long long)images->number);
    if (!images->index) {
        OZ_PASS(oz_vtk_index_create(&images->index, images->folder, INDEX));
    }
    OZ_PASS(write_image(images, rows, time, false, name));
    OZ_PASS(oz_vtk_index_add(images->index, time, beside));
    images->whole = oz_vtk_index_whole(images->index);
    images->number++;
    return OZ_OK;
}

OzStatus oz_coarse_images_add_mean(OzCoarseImages *images, const OzCoarseRows *rows, double time)
{
    return write_image(images, rows, time, true, "fields/fields_mean.vti");
}

OzStatus oz_coarse_images_free(OzCoarseImages *images)
{
    OzStatus status = OZ_OK;
    if (!images) {
        return OZ_OK;
    }
    if (images->index) {
        status = oz_folder_finish_file(images->index, INDEX);
    }
    free(images->folder);
    free(images);
    return status;
}
