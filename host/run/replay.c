/* Reading reloads.csv. */
#include "run/replay.h"

#include "base/file.h"
#include "base/memory.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 6, STEP = 0, KEY = 2, NOW = 4 };

static OzStatus refuse(const char *path, int line)
{
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s:%d: no row of a run's changes; expected step, time, key, old, new, "
                          "rebuild_seconds",
                          path, line);
}

/* Cuts a row into cells, in place; *row moves behind it. False when they are not CELLS. */
static bool cut(char **row, char *cells[CELLS])
{
    char *from = *row;
    for (int i = 0; i < CELLS; i++) {
        char *to = from;
        bool quoted = *from == '"';
        cells[i] = to;
        from += quoted;
        while (*from && (quoted || (*from != ',' && *from != '\n'))) {
            if (quoted && *from == '"') {
                if (from[1] != '"') {
                    from++;
                    break;
                }
                from++;
            }
            *to++ = *from++;
        }
        char end = *from;
        from += end != '\0';
        *to = '\0';
        if (end != (i < CELLS - 1 ? ',' : '\n')) {
            return false;
        }
    }
    *row = from;
    return true;
}

static OzStatus add_setting(OzReplayChange *change, const char *key, const char *now)
{
    size_t count = (size_t)change->count;
    OZ_PASS(
        oz_memory_grow((void **)&change->settings, count, count + 1, sizeof(char *), "settings"));
    char **setting = &change->settings[change->count];
    int length = now[0] ? asprintf(setting, "%s=%s", key, now) : asprintf(setting, "-%s", key);
    if (length < 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a setting");
    }
    change->count++;
    return OZ_OK;
}

static OzStatus add_row(OzReplay *replay, int64_t step, char *const cells[CELLS])
{
    OzReplayChange *last = replay->count ? &replay->changes[replay->count - 1] : NULL;
    replay->is_cut = strcmp(cells[KEY], "end") == 0;
    if (replay->is_cut) {
        replay->is_cut = strcmp(cells[NOW], "interrupted") == 0;
        replay->end = step;
        return OZ_OK;
    }
    if (!last || last->step != step) {
        size_t count = (size_t)replay->count;
        OZ_PASS(oz_memory_grow((void **)&replay->changes, count, count + 1, sizeof *replay->changes,
                               "changes"));
        last = &replay->changes[replay->count++];
        last->step = step;
    }
    return add_setting(last, cells[KEY], cells[NOW]);
}

OzStatus oz_replay_parse(OzReplay *replay, const char *path, char *text)
{
    *replay = (OzReplay){0};
    char *row = text, *cells[CELLS], *end = NULL;
    int64_t before = 0;
    for (int line = 1; *row; line++) {
        if (!cut(&row, cells)) {
            return refuse(path, line);
        }
        long long step = strtoll(cells[STEP], &end, 10);
        if (line == 1 && strcmp(cells[STEP], "step") == 0) {
            continue;
        }
        if (end == cells[STEP] || *end || step < before || !cells[KEY][0]) {
            return refuse(path, line);
        }
        before = step;
        OZ_PASS(add_row(replay, step, cells));
    }
    return OZ_OK;
}

/* Members of an ensemble keep their changes in their own folders. */
static OzStatus refuse_members(const char *folder)
{
    OzStatus status = OZ_OK;
    glob_t found = {0};
    char *pattern = NULL;
    OZ_TRY(oz_file_join(&pattern, folder, "*/reloads.csv"));
    if (glob(pattern, 0, NULL, &found) == 0) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s: members of this run were changed while they ran (%s), which "
                                "is repeated of one at a time; expected a member's folder",
                                folder, found.gl_pathv[0]);
    }
done:
    globfree(&found);
    free(pattern);
    return status;
}

OzStatus oz_replay_read(OzReplay *replay, const char *folder)
{
    OzStatus status = OZ_OK;
    char *path = NULL, *text = NULL;
    *replay = (OzReplay){0};
    OZ_TRY(oz_file_join(&path, folder, "reloads.csv"));
    if (oz_file_exists(path)) {
        OZ_TRY(oz_file_read(&text, NULL, path));
        OZ_TRY(oz_replay_parse(replay, path, text));
    } else {
        OZ_TRY(refuse_members(folder));
    }
done:
    free(path);
    free(text);
    return status;
}

void oz_replay_free(OzReplay *replay)
{
    for (int i = 0; i < replay->count; i++) {
        for (int k = 0; k < replay->changes[i].count; k++) {
            free(replay->changes[i].settings[k]);
        }
        free(replay->changes[i].settings);
    }
    free(replay->changes);
    *replay = (OzReplay){0};
}
