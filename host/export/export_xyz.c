/* Extended XYZ, all frames in one file, with the columns by which OVITO draws spherocylinders:
 * a rod's orientation (x y z w) turns z into its shaft, its aspherical shape is radius, radius and
 * length of the shaft. Grains of trigrains are discs of their area, turned about z. */
#include "base/folder.h"
#include "base/memory.h"
#include "export/format.h"

#include <math.h>
#include <stdlib.h>

static const char NAME[] = "grains.xyz";
static const double PI = 3.14159265358979323846;

typedef struct Writer {
    FILE *file;
} Writer;

static OzStatus finish_xyz(void *data)
{
    Writer *writer = (Writer *)data;
    OzStatus status = writer ? oz_folder_finish_file(writer->file, NAME) : OZ_OK;
    free(writer);
    return status;
}

static OzStatus open_xyz(void **data, const OzExport *target)
{
    Writer *writer = NULL;
    OZ_PASS(OZ_NEW(&writer, 1));
    *data = writer;
    return oz_folder_create_file(&writer->file, target->folder, NAME);
}

/* The box that grains' centres lie in, widened by the largest grain. */
static void find_box(const OzSnapshot *now, double low[3], double size[3])
{
    for (int k = 0; k < 3; k++) {
        double least = INFINITY, most = -INFINITY, reach = 0;
        for (int64_t i = 0; i < now->count; i++) {
            least = fmin(least, now->position[3 * i + k]);
            most = fmax(most, now->position[3 * i + k]);
            reach = fmax(reach, 0.5 * (now->grains->diameter[i] + now->grains->length[i]));
        }
        low[k] = now->count ? least - reach : 0;
        size[k] = now->count ? most - least + 2 * reach : 1;
    }
}

static void write_comment(FILE *file, const OzSnapshot *now)
{
    double low[3], size[3];
    find_box(now, low, size);
    fprintf(file, "Lattice=\"%.9g 0 0 0 %.9g 0 0 0 %.9g\" Origin=\"%.9g %.9g %.9g\" pbc=\"F F F\" ",
            size[0], size[1], size[2], low[0], low[1], low[2]);
    fputs("Properties=id:I:1:type:I:1:pos:R:3:velo:R:3:angular_velocity:R:3:orientation:R:4:"
          "aspherical_shape:R:3:radius:R:1:mass:R:1 ",
          file);
    fprintf(file, "Timestep=%lld Time=%.9g\n", (long long)now->step, now->time);
}

static void write_numbers(FILE *file, const double *values, int count)
{
    for (int k = 0; k < count; k++) {
        fprintf(file, " %.9g", values[k] + 0.0);
    }
}

static void write_grain(FILE *file, const OzSnapshot *now, int64_t i)
{
    const OzGrains *grains = now->grains;
    const double *q = &now->quaternion[4 * i];
    const OzElements *flat = grains->elements;
    double radius = flat ? sqrt(oz_elements_body_area(flat, i) / PI) : 0.5 * grains->diameter[i];
    fprintf(file, "%lld %d", (long long)i, grains->population[i] + 1);
    write_numbers(file, &now->position[3 * i], 3);
    write_numbers(file, &now->velocity[3 * i], 3);
    write_numbers(file, &now->angular_velocity[3 * i], 3);
    write_numbers(file, (double[4]){q[1], q[2], q[3], q[0]}, 4);
    write_numbers(file, (double[3]){radius, radius, grains->length[i]}, 3);
    write_numbers(file, (double[2]){radius, grains->mass[i]}, 2);
    fputc('\n', file);
}

static OzStatus add_xyz(void *data, const OzSnapshot *now)
{
    const Writer *writer = (const Writer *)data;
    fprintf(writer->file, "%lld\n", (long long)now->count);
    write_comment(writer->file, now);
    for (int64_t i = 0; i < now->count; i++) {
        write_grain(writer->file, now, i);
    }
    fflush(writer->file); /* what failed shows at its end */
    return OZ_OK;
}

const OzExportFormat oz_export_xyz_format = {"xyz", {NAME}, open_xyz, add_xyz, finish_xyz};
