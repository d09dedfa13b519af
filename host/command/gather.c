/* Parts' members in the order of one run: combinations of the sweep, each with its seeds. */
#include "command/gather.h"

#include "base/cells.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "run/ensemble_tables.h"

#include <glob.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A part, and its table. */
typedef struct Part {
    char *folder; /* owned */
    OzCells table;
    OzFolder read; /* nobody may change it meanwhile */
} Part;

typedef struct Member {
    const Part *part;
    int64_t row; /* of its table */
    uint64_t seed;
    char *value;         /* of the swept keys, with commas between; owned; NULL: no sweep */
    int64_t combination; /* counted as they come */
} Member;

typedef struct Gather {
    Part *parts;
    Member *members;
    int64_t part_count, part_capacity, member_count, member_capacity;
    char *key; /* swept keys, with commas between; owned; NULL: no sweep */
    char *out;
    OzFolder owned;
} Gather;

enum { NAME, SEED, KEYS }; /* columns of members.csv; "status" comes after the keys */

static OzStatus open_part(Gather *g, const char *folder)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_PASS(OZ_ROOM(&g->parts, &g->part_capacity, g->part_count + 1, "parts"));
    Part *part = &g->parts[g->part_count++];
    OZ_TRY(oz_memory_text(&part->folder, folder));
    OZ_TRY(oz_file_join(&path, folder, "members.csv"));
    if (!oz_file_exists(path)) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s: there is no members.csv; expected a part of an ensemble that "
                                "has ended (orzo run --part), or a folder of parts",
                                folder);
        goto done;
    }
    OZ_TRY(oz_folder_read(&part->read, folder));
    OZ_TRY(oz_cells_read(&part->table, path));
    if (oz_cells_find(&part->table, "status") < KEYS) {
        status = oz_status_fail(OZ_ERR_INPUT, "%s: no table of an ensemble's members", path);
    }
done:
    free(path);
    return status;
}

/* The parts in a folder, or the one that it is. *holds: parts were found in it. */
static OzStatus open_parts(Gather *g, const char *folder, bool *holds)
{
    OzStatus status = OZ_OK;
    glob_t found = {0};
    char *pattern = NULL;
    OZ_TRY(oz_file_join(&pattern, folder, "part_[0-9]*"));
    *holds = glob(pattern, 0, NULL, &found) == 0;
    if (!*holds) {
        OZ_TRY(open_part(g, folder));
    }
    for (size_t i = 0; *holds && i < found.gl_pathc; i++) {
        OZ_TRY(open_part(g, found.gl_pathv[i]));
    }
done:
    globfree(&found);
    free(pattern);
    return status;
}

/* Cells of the columns of the swept keys with commas between (row -1: their names); NULL without a
 * sweep. The caller frees. */
static OzStatus join_keys(char **text, const Part *part, int64_t row)
{
    int last = oz_cells_find(&part->table, "status");
    size_t length = 0;
    *text = NULL;
    FILE *file = last > KEYS ? open_memstream(text, &length) : NULL;
    for (int c = KEYS; file && c < last; c++) {
        fprintf(file, "%s%s", c > KEYS ? "," : "", oz_cells_text(&part->table, row, c));
    }
    if (last > KEYS && (!file || fclose(file) != 0 || !*text)) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for swept keys");
    }
    return OZ_OK;
}

static bool is_same(const char *a, const char *b)
{
    return strcmp(a ? a : "", b ? b : "") == 0;
}

static OzStatus check_key(Gather *g, const Part *part)
{
    char *key = NULL;
    OZ_PASS(join_keys(&key, part, -1));
    bool same = part == g->parts || is_same(key, g->key);
    if (part == g->parts) {
        g->key = key;
        key = NULL;
    }
    free(key);
    return same ? OZ_OK
                : oz_status_fail(OZ_ERR_INPUT, "%s: sweeps other keys than %s", part->folder,
                                 g->parts->folder);
}

static OzStatus add_members(Gather *g, const Part *part)
{
    OZ_PASS(check_key(g, part));
    for (int64_t row = 0; row < part->table.row_count; row++) {
        OZ_PASS(OZ_ROOM(&g->members, &g->member_capacity, g->member_count + 1, "members"));
        Member *member = &g->members[g->member_count];
        *member = (Member){.part = part, .row = row, .combination = g->member_count};
        member->seed = strtoull(oz_cells_text(&part->table, row, SEED), NULL, 10);
        g->member_count++;
        OZ_PASS(join_keys(&member->value, part, row));
        for (int64_t k = g->member_count - 2; k >= 0; k--) { /* mostly the last one's */
            if (is_same(g->members[k].value, member->value)) {
                member->combination = g->members[k].combination;
                break;
            }
        }
    }
    return OZ_OK;
}

static int compare(const void *a, const void *b)
{
    const Member *one = a, *other = b;
    if (one->combination != other->combination) {
        return one->combination < other->combination ? -1 : 1;
    }
    return (one->seed > other->seed) - (one->seed < other->seed);
}

/* Members once each; seeds that no part has are said. */
static OzStatus check_members(const Gather *g)
{
    for (int64_t k = 1; k < g->member_count; k++) {
        const Member *before = &g->members[k - 1], *member = &g->members[k];
        if (compare(before, member) == 0) {
            return oz_status_fail(OZ_ERR_INPUT, "%s and %s both have %s; expected each member once",
                                  before->part->folder, member->part->folder,
                                  oz_cells_text(&member->part->table, member->row, NAME));
        }
        if (before->combination == member->combination && member->seed > before->seed + 1) {
            oz_log_line("warning: no part has seeds %" PRIu64 " to %" PRIu64, before->seed + 1,
                        member->seed - 1);
        }
    }
    return OZ_OK;
}

static OzStatus open_out(Gather *g)
{
    static const char *const writes[] = {"members.csv",       "members.csv.part",    "ensemble.csv",
                                         "ensemble.csv.part", "inclination_fit.csv", NULL};
    const OzFolderUse use = {.writes = writes};
    bool is_part = false;
    char *real = realpath(g->out, NULL);
    for (int64_t k = 0; real && k < g->part_count; k++) {
        char *part = realpath(g->parts[k].folder, NULL);
        is_part = is_part || (part && strcmp(part, real) == 0);
        free(part);
    }
    free(real);
    return is_part ? oz_status_fail(OZ_ERR_INPUT,
                                    "%s is one of the parts; expected another folder (-o)", g->out)
                   : oz_folder_open(&g->owned, g->out, &use);
}

static OzStatus write_tables(const Gather *g)
{
    OzStatus status = OZ_OK;
    OzEnsemble *ensemble = NULL;
    OZ_TRY(oz_ensemble_tables_create(&ensemble, g->out, g->key));
    for (int64_t k = 0; k < g->member_count; k++) {
        const Member *member = &g->members[k];
        const OzCells *table = &member->part->table;
        const char *said = oz_cells_text(table, member->row, oz_cells_find(table, "status"));
        OzEnsembleRow row = {.name = oz_cells_text(table, member->row, NAME),
                             .place = member->part->folder,
                             .seed = member->seed,
                             .value = member->value,
                             .status = said,
                             .has_series = strcmp(said, "not started") != 0};
        OZ_TRY(oz_ensemble_tables_add(ensemble, &row));
    }
done:
    OZ_AFTER(status, oz_ensemble_tables_finish(ensemble));
    return status;
}

static OzStatus gather(Gather *g, const OzOptions *options)
{
    bool holds = false;
    for (int i = 0; i < options->path_count; i++) {
        OZ_PASS(open_parts(g, options->paths[i], &holds));
    }
    if (!options->out && !(holds && options->path_count == 1)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "orzo: -o is missing; expected -o DIR for the tables of "
                              "parts that are not all in one folder");
    }
    OZ_PASS(oz_memory_text(&g->out, options->out ? options->out : options->paths[0]));
    for (int64_t k = 0; k < g->part_count; k++) {
        OZ_PASS(add_members(g, &g->parts[k]));
    }
    qsort(g->members, (size_t)g->member_count, sizeof *g->members, compare);
    OZ_PASS(check_members(g));
    OZ_PASS(open_out(g));
    OZ_PASS(write_tables(g));
    oz_log_line("%lld members of %lld parts in %s: members.csv, ensemble.csv",
                (long long)g->member_count, (long long)g->part_count, g->out);
    return OZ_OK;
}

OzStatus oz_gather_run(const OzOptions *options)
{
    Gather g = {0};
    OzStatus status = gather(&g, options);
    for (int64_t k = 0; k < g.member_count; k++) {
        free(g.members[k].value);
    }
    for (int64_t k = 0; k < g.part_count; k++) {
        oz_folder_close(&g.parts[k].read);
        oz_cells_free(&g.parts[k].table);
        free(g.parts[k].folder);
    }
    oz_folder_close(&g.owned);
    free(g.members);
    free(g.parts);
    free(g.key);
    free(g.out);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
