/* Processes learn of each other from what their launcher tells them alone: they share nothing but
 * the folder. */
#include "command/ranks.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "command/gather.h"
#include "run/outputs.h"
#include "run/run.h"
#include "run/seed_part.h"
#include "scene/scene.h"

#include <sched.h>
#include <stdlib.h>

/* One of count processes, counted from 0. */
typedef struct Rank {
    int rank, count;
} Rank;

/* What launchers tell: Open MPI; MPICH, Intel MPI and others; srun, of its step, since the whole
 * job's variables are there in batch scripts too. */
static const struct {
    const char *rank, *count;
} launchers[] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                 {"PMI_RANK", "PMI_SIZE"},
                 {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};

static Rank find_rank(void)
{
    Rank found = {0, 1};
    for (size_t i = 0; i < sizeof launchers / sizeof *launchers && found.count < 2; i++) {
        const char *rank = getenv(launchers[i].rank), *count = getenv(launchers[i].count);
        found = rank && count ? (Rank){atoi(rank), atoi(count)} : found;
    }
    return found.rank >= 0 && found.rank < found.count ? found : (Rank){0, 1};
}

/* Those that the process may use, which launchers bind to some. */
static int count_processors(void)
{
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
}

static OzStatus run_part(const OzOptions *options)
{
    OzOptions part = *options;
    OzStatus status = oz_seed_part_take(&part);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status == OZ_OK ? oz_run_scene(&part) : status;
}

/* The folder of the whole ensemble; the caller frees. */
static OzStatus choose_whole(char **folder, const OzOptions *options)
{
    OzOptions whole = *options;
    char *name = NULL;
    whole.parts = 0;
    OZ_PASS(oz_scene_name(&name, options->paths[0]));
    OzStatus status = oz_outputs_choose_folder(folder, &whole, name);
    free(name);
    return status;
}

/* Whether a part has its table, and nobody works in it. */
static bool has_ended(const char *whole, int part)
{
    char name[64], *folder = NULL, *table = NULL;
    OzFolder read = {0};
    snprintf(name, sizeof name, "part_%05d", part);
    bool ended = oz_file_join(&folder, whole, name) == OZ_OK &&
                 oz_file_join(&table, folder, "members.csv") == OZ_OK && oz_file_exists(table) &&
                 oz_folder_read(&read, folder) == OZ_OK;
    oz_folder_close(&read);
    free(folder);
    free(table);
    return ended;
}

/* By the process that finds all parts ended: each looks once its own has. */
static OzStatus gather_all(const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OzOptions gather = {.path_count = 1};
    char *whole = NULL;
    int ended = 0;
    OZ_TRY(choose_whole(&whole, options));
    for (int part = 1; part <= options->parts; part++) {
        ended += has_ended(whole, part);
    }
    if (ended < options->parts) {
        oz_log_line("%d of %d parts have ended", ended, options->parts);
        goto done;
    }
    gather.paths[0] = whole;
    status = oz_gather_run(&gather);
done:
    free(whole);
    return status;
}

static OzStatus run_of_several(const OzOptions *options, Rank rank)
{
    OzOptions part = *options;
    uint64_t seeds = options->seed_last - options->seed_first + 1;
    if (!options->has_seeds) {
        OzStatus status = oz_status_fail(
            OZ_ERR_INPUT,
            "orzo: process %d of %d without --seeds; expected --seeds A..B, whose members are "
            "spread over the processes: one scene is not cut up",
            rank.rank + 1, rank.count);
        oz_log_line("%s", oz_status_text());
        return status;
    }
    part.part = rank.rank + 1;
    part.parts = seeds < (uint64_t)rank.count ? (int)seeds : rank.count;
    part.threads = options->threads > 0 ? options->threads : count_processors();
    if (part.part > part.parts) {
        oz_log_line("process %d of %d has no seed to run", part.part, rank.count);
        return OZ_OK;
    }
    OzStatus ran = run_part(&part);
    if (ran == OZ_ERR_INPUT) {
        return ran;
    }
    OzStatus gathered = gather_all(&part);
    return ran == OZ_OK ? gathered : ran;
}

OzStatus oz_ranks_run(const OzOptions *options)
{
    Rank rank = find_rank();
    return rank.count > 1 && options->parts == 0 ? run_of_several(options, rank)
                                                 : run_part(options);
}
