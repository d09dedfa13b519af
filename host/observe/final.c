/* Writes final.csv. Reading it back belongs to the model (model/restart_csv.h), which spells its
 * columns.
 */
#include "observe/final.h"

#include "model/restart_csv.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void fill_row(const OzSnapshot *snapshot, int64_t i, double row[OZ_BED_COLUMNS])
{
    row[OZ_BED_ID] = (double)i;
    memcpy(&row[OZ_BED_POSITION], &snapshot->position[3 * i], 3 * sizeof(double));
    memcpy(&row[OZ_BED_QUATERNION], &snapshot->quaternion[4 * i], 4 * sizeof(double));
    memcpy(&row[OZ_BED_AXIS], &snapshot->axis[3 * i], 3 * sizeof(double));
    memcpy(&row[OZ_BED_VELOCITY], &snapshot->velocity[3 * i], 3 * sizeof(double));
    memcpy(&row[OZ_BED_SPIN], &snapshot->angular_velocity[3 * i], 3 * sizeof(double));
    row[OZ_BED_DIAMETER] = snapshot->grains->diameter[i];
    row[OZ_BED_LENGTH] = snapshot->grains->length[i];
    row[OZ_BED_MASS] = snapshot->grains->mass[i];
}

static bool is_rod_sound(const OzSnapshot *snapshot, int64_t i)
{
    double row[OZ_BED_COLUMNS];
    bool sound = true;
    fill_row(snapshot, i, row);
    for (int k = 0; k < OZ_BED_COLUMNS; k++) {
        sound &= isfinite(row[k]) != 0;
    }
    return sound;
}

static bool is_flat_sound(const OzSnapshot *s, int64_t g)
{
    const OzElements *elements = s->grains->elements;
    bool sound = true;
    for (int64_t n = elements->first[g]; n < elements->first[g + 1]; n++) {
        int64_t i = oz_elements_at(elements, n);
        for (int64_t k = 2 * i; k < 2 * i + 2; k++) {
            sound &= isfinite(s->element_position[k]) && isfinite(s->element_velocity[k]);
        }
        sound &= isfinite(s->element_angle[i]) && isfinite(s->element_angular_velocity[i]);
    }
    return sound;
}

/* The first grain whose state is no number; count where all are. */
static int64_t find_unsound(const OzSnapshot *s)
{
    int64_t i = 0;
    while (i < s->count && (s->grains->elements ? is_flat_sound : is_rod_sound)(s, i)) {
        i++;
    }
    return i;
}

static void write_rows(const OzSnapshot *snapshot, FILE *file)
{
    double row[OZ_BED_COLUMNS];
    fputs(OZ_RESTART_CSV_HEADER "\n", file);
    for (int64_t i = 0; i < snapshot->count; i++) {
        fill_row(snapshot, i, row);
        for (int k = 0; k < OZ_BED_COLUMNS; k++) {
            fprintf(file, k == 0 ? "%.17g" : ",%.17g", row[k]); /* 17 digits restore a double */
        }
        fputc('\n', file);
    }
}

static void write_flat_rows(const OzSnapshot *snapshot, FILE *file)
{
    const OzElements *elements = snapshot->grains->elements;
    fputs(OZ_FINAL_FLAT_HEADER "\n", file);
    for (int64_t g = 0; g < snapshot->count; g++) {
        const double *x = &snapshot->position[3 * g], *v = &snapshot->velocity[3 * g];
        double turned = oz_elements_turned(elements, g, snapshot->element_angle), mass = 0;
        for (int64_t k = elements->first[g]; k < elements->first[g + 1]; k++) {
            mass += elements->mass[oz_elements_at(elements, k)];
        }
        fprintf(file, "%lld,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%lld,%.17g,%.17g\n", (long long)g,
                x[0], x[1], turned, v[0], v[1],
                snapshot->angular_velocity[3 * g + 2],
                (long long)(elements->first[g + 1] - elements->first[g]),
                oz_elements_body_area(elements, g), mass);
    }
}

/* The name under which the file stands until it is whole. */
static OzStatus part_of(char **part, const char *path)
{
    if (asprintf(part, "%s.part", path) < 0) {
        *part = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a file name");
    }
    return OZ_OK;
}

OzStatus oz_final_reserve(const OzGrains *grains, const char *path)
{
    /* -1.2345678901234567e-308 and a comma: 25 bytes; a grain has at most OZ_BED_COLUMNS of them.
     */
    int64_t rows = grains->elements ? grains->elements->free_count : grains->count; /* in pieces */
    const int64_t number = 25, bytes = 1024 + number * OZ_BED_COLUMNS * rows;
    OzStatus status = OZ_OK;
    char *part = NULL;
    OZ_TRY(part_of(&part, path));
    int descriptor = open(part, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    bool good = descriptor >= 0;
    good = good && (fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, bytes) == 0 ||
                    errno == EOPNOTSUPP || errno == ENOSYS);
    if (!good) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot reserve %.3g MB for %s: %s",
                                (double)bytes / 1e6, path, strerror(errno));
        remove(part);
    }
    if (descriptor >= 0) {
        close(descriptor);
    }
done:
    free(part);
    return status;
}

void oz_final_give_up(const char *path)
{
    char *part = NULL;
    if (part_of(&part, path) == OZ_OK) {
        remove(part);
    }
    free(part);
}

/* Cuts off what was reserved and not needed. */
static bool finish(FILE *file)
{
    bool good = fflush(file) == 0 && !ferror(file);
    good = good && ftruncate(fileno(file), ftello(file)) == 0;
    return fclose(file) == 0 && good;
}

OzStatus oz_final_write(const OzSnapshot *snapshot, const char *path)
{
    OzStatus status = OZ_OK;
    char *part = NULL;
    int64_t grain = find_unsound(snapshot);
    if (grain < snapshot->count) {
        return oz_status_fail(OZ_ERR_BLOWUP, "%s: grain %lld is no number at time %.9g s",
                              snapshot->scene->path, (long long)grain, snapshot->time);
    }
    OZ_TRY(part_of(&part, path));
    FILE *file = fopen(part, "r+"); /* what is reserved there stays so */
    file = file ? file : fopen(part, "w");
    bool good = file != NULL;
    if (file) {
        (snapshot->grains->elements ? write_flat_rows : write_rows)(snapshot, file);
        good = finish(file);
    }
    if (!good || rename(part, path) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
        remove(part);
    }
done:
    free(part);
    return status;
}
