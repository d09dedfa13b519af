/* Writes contacts.csv. */
#include "observe/contact_rows.h"

#include "base/file.h"
#include "base/memory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct OzContactRows {
    FILE *file;
    char *path;
    int64_t whole; /* bytes of whole moments */
};

/* mode: of fopen. */
static OzStatus open_rows(OzContactRows **rows, const char *path, const char *mode)
{
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(rows, 1));
    OZ_TRY(oz_memory_text(&(*rows)->path, path));
    (*rows)->file = fopen(path, mode);
    if (!(*rows)->file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
done:
    if (status != OZ_OK) {
        oz_contact_rows_free(*rows);
        *rows = NULL;
    }
    return status;
}

OzStatus oz_contact_rows_create(OzContactRows **rows, const char *path)
{
    OZ_PASS(open_rows(rows, path, "w"));
    fputs(OZ_CONTACT_ROWS_HEADER "\n", (*rows)->file);
    return oz_file_commit((*rows)->file, &(*rows)->whole, path);
}

OzStatus oz_contact_rows_go_on(OzContactRows **rows, const char *path)
{
    return open_rows(rows, path, "r+");
}

OzStatus oz_contact_rows_state(OzContactRows *rows, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "contacts", 1));
    OZ_PASS(oz_state_index(visit, "file_bytes", &rows->whole, 0, INT64_MAX));
    oz_state_leave(visit);
    return visit->is_loading ? oz_file_go_on(rows->file, rows->whole, rows->path) : OZ_OK;
}

static void write_row(FILE *file, const OzSnapshot *now, const OzContactEntry *e)
{
    const double *x = e->point, *n = e->normal, *t = e->tangential;
    const double values[] = {x[0],       x[1],    x[2], n[0], n[1], n[2],
                             e->overlap, e->push, t[0], t[1], t[2]};
    fprintf(file, "%lld,%.9g,%d,%d", (long long)now->step, now->time, e->a, e->b);
    for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
        fprintf(file, ",%.9g", values[k] + 0.0); /* -0 becomes 0 */
    }
    fprintf(file, ",%d\n", e->slips);
}

void oz_contact_rows_print(FILE *file, const OzSnapshot *snapshot)
{
    for (int64_t i = 0; snapshot->has_contacts && i < snapshot->contacts.count; i++) {
        write_row(file, snapshot, &snapshot->contacts.entry[i]);
    }
}

OzStatus oz_contact_rows_write(OzContactRows *rows, const OzSnapshot *snapshot)
{
    oz_contact_rows_print(rows->file, snapshot);
    return oz_file_commit(rows->file, &rows->whole, rows->path);
}

OzStatus oz_contact_rows_free(OzContactRows *rows)
{
    OzStatus status = OZ_OK;
    if (!rows) {
        return OZ_OK;
    }
    if (rows->file && fclose(rows->file) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", rows->path, strerror(errno));
    }
    free(rows->path);
    free(rows);
    return status;
}
