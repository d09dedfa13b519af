/* Reading reloads.csv. */
#include "run/replay.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/memory.h"

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
        *last = (OzReplayChange){.step = step};
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

/* Members are of seeds, which the folder's scene does not tell. */
static OzStatus refuse_members(const char *folder)
{
    OzStatus status = OZ_OK;
    char *members = NULL;
    OZ_TRY(oz_file_join(&members, folder, "members.csv"));
    if (oz_file_exists(members)) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s: members of seeds that no state there tells; expected --seeds "
                                "as that run was given them, or a member's folder",
                                folder);
    }
done:
    free(members);
    return status;
}

/* Of a copy, seen from the folder that has it. */
static OzStatus name_copy(char **name, const char *member)
{
    if (asprintf(name, "replay/%s.csv", member[0] ? member : "run") < 0) {
        *name = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a file's name");
    }
    return OZ_OK;
}

/* The file of a member's changes. */
static OzStatus choose_path(char **path, const char *folder, const char *member, bool is_kept)
{
    OzStatus status = OZ_OK;
    char *below = NULL;
    if (is_kept) {
        OZ_TRY(name_copy(&below, member));
        OZ_TRY(oz_file_join(path, folder, below));
    } else {
        OZ_TRY(oz_file_join(&below, folder, member));
        OZ_TRY(oz_file_join(path, below, "reloads.csv"));
    }
done:
    free(below);
    return status;
}

OzStatus oz_replay_read(OzReplay *replay, const char *folder, const char *member, bool is_kept)
{
    OzStatus status = OZ_OK;
    char *path = NULL, *text = NULL;
    *replay = (OzReplay){0};
    OZ_TRY(choose_path(&path, folder, member, is_kept));
    if (oz_file_exists(path)) {
        OZ_TRY(oz_file_read(&text, NULL, path));
        OZ_TRY(oz_replay_parse(replay, path, text));
    } else if (!member[0] && !is_kept) {
        OZ_TRY(refuse_members(folder));
    }
done:
    free(path);
    free(text);
    return status;
}

bool oz_replay_has(const char *folder, const char *member, bool is_kept)
{
    char *place = NULL;
    OzStatus status =
        is_kept ? choose_path(&place, folder, member, true) : oz_file_join(&place, folder, member);
    bool has = !member[0] || (status == OZ_OK && oz_file_exists(place));
    free(place);
    return has;
}

OzStatus oz_replay_keep(const char *folder, const char *member, const char *own)
{
    OzStatus status = OZ_OK;
    FILE *file = NULL;
    char *below = NULL, *path = NULL, *text = NULL, *name = NULL;
    if (!oz_replay_has(folder, member, false)) {
        return OZ_OK;
    }
    OZ_TRY(oz_file_join(&below, own, "replay"));
    OZ_TRY(oz_file_make_folder(below));
    OZ_TRY(choose_path(&path, folder, member, false));
    if (oz_file_exists(path)) {
        OZ_TRY(oz_file_read(&text, NULL, path));
    }
    OZ_TRY(name_copy(&name, member));
    OZ_TRY(oz_folder_create_file(&file, own, name));
    fputs(text ? text : "", file);
done:
    OZ_AFTER(status, oz_folder_finish_file(file, name));
    free(below);
    free(path);
    free(text);
    free(name);
    return status;
}

OzStatus oz_replay_choose_folder(char **out, const char *asked, const char *folder)
{
    size_t length = strlen(folder);
    if (asked) {
        return oz_memory_text(out, asked);
    }
    while (length > 1 && folder[length - 1] == '/') {
        length--;
    }
    if (asprintf(out, "%.*s_again", (int)length, folder) < 0) {
        *out = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a folder's name");
    }
    return OZ_OK;
}

bool oz_replay_is_kept(const char *own)
{
    char *place = NULL;
    bool is_kept = oz_file_join(&place, own, "replay") == OZ_OK && oz_file_exists(place);
    free(place);
    return is_kept;
}

bool oz_replay_go_on(OzReplay *replay, int64_t taken, int64_t step)
{
    replay->is_cut = replay->is_cut && (taken < replay->count || step < replay->end);
    return replay->is_cut || taken < replay->count;
}

static bool change_agrees(const OzReplayChange *a, const OzReplayChange *b)
{
    bool agrees = a->step == b->step && a->count == b->count;
    for (int k = 0; agrees && k < a->count; k++) {
        agrees = strcmp(a->settings[k], b->settings[k]) == 0;
    }
    return agrees;
}

bool oz_replay_agrees(const OzReplay *a, const OzReplay *b)
{
    bool agrees = a->count == b->count && a->is_cut == b->is_cut && a->end == b->end;
    for (int i = 0; agrees && i < a->count; i++) {
        agrees = change_agrees(&a->changes[i], &b->changes[i]);
    }
    return agrees;
}

void oz_replay_free(OzReplay *replay)
{
    for (int i = 0; i < replay->count; i++) {
        for (int k = 0; k < replay->changes[i].count; k++) {
            free(replay->changes[i].settings[k]);
        }
        free(replay->changes[i].settings);
        free(replay->changes[i].what);
    }
    free(replay->changes);
    *replay = (OzReplay){0};
}
