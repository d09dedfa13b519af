/* Formats by name, folders, and what is said at the end. */
#include "command/export_folder.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "export/export.h"
#include "run/inputs.h"

#include <stdlib.h>
#include <string.h>

typedef struct Work {
    OzScene scene;
    OzInputs inputs;
    OzFolder read;  /* the run's, which nobody may change meanwhile */
    OzFolder owned; /* out, in use                                  */
    char *scene_path, *frames_path, *out;
    OzExportKind kinds[OZ_EXPORTS_END];
    int kind_count;
} Work;

#define CHOICE(NAME, name, choice) choice,
static const char *const choices[] = {OZ_EXPORTS(CHOICE)};
#undef CHOICE

/* One name of length characters. */
static OzStatus add_kind(Work *work, const char *name, size_t length)
{
    for (int k = 0; k < OZ_EXPORTS_END; k++) {
        bool is_new = true;
        for (int i = 0; i < work->kind_count; i++) {
            is_new &= work->kinds[i] != (OzExportKind)k;
        }
        if (is_new && strlen(choices[k]) == length && strncmp(choices[k], name, length) == 0) {
            work->kinds[work->kind_count++] = (OzExportKind)k;
            return OZ_OK;
        }
    }
    return oz_status_fail(OZ_ERR_INPUT,
                          "orzo: '--to %.*s' is wrong; expected vtk, xyz, h5md or csv, or several "
                          "with commas between, each once",
                          (int)length, name);
}

static OzStatus read_kinds(Work *work, const char *list)
{
    if (!list) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "orzo: --to is missing; expected --to vtk, xyz, h5md or csv");
    }
    for (const char *at = list;; at++) {
        size_t length = strcspn(at, ",");
        OZ_PASS(add_kind(work, at, length));
        at += length;
        if (*at == '\0') {
            return OZ_OK;
        }
    }
}

static OzStatus open_folder(Work *work)
{
    const char *replaces[OZ_EXPORT_REPLACES];
    OzFolderUse use = oz_export_use(work->kinds, work->kind_count, replaces);
    OZ_PASS(oz_inputs_add(&work->inputs, work->frames_path));
    OZ_PASS(oz_inputs_add_scene(&work->inputs, &work->scene));
    OZ_PASS(oz_inputs_check(&work->inputs, work->out, &use));
    return oz_folder_open(&work->owned, work->out, &use);
}

static OzStatus export_all(Work *work, const OzOptions *options)
{
    const char *folder = options->paths[0];
    int64_t count = 0;
    OZ_PASS(read_kinds(work, options->to));
    OZ_PASS(oz_folder_read(&work->read, folder));
    OZ_PASS(oz_file_join(&work->scene_path, folder, "scene.yaml"));
    OZ_PASS(oz_file_join(&work->frames_path, folder, "frames.bin"));
    OZ_PASS(options->out ? oz_file_join(&work->out, NULL, options->out)
                         : oz_file_join(&work->out, folder, "export"));
    OZ_PASS(oz_scene_load(&work->scene, work->scene_path, NULL, 0));
    OZ_PASS(open_folder(work));
    OzExportJob job = {.frames = work->frames_path,
                       .scene = &work->scene,
                       .folder = work->out,
                       .kinds = work->kinds,
                       .kind_count = work->kind_count,
                       .every = options->every > 0 ? options->every : 1};
    OZ_PASS(oz_export_frames(&job, &count));
    oz_log_line("%lld frames exported into %s", (long long)count, work->out);
    return OZ_OK;
}

OzStatus oz_export_folder_run(const OzOptions *options)
{
    Work work = {0};
    OzStatus status = export_all(&work, options);
    oz_folder_close(&work.owned);
    oz_folder_close(&work.read);
    oz_inputs_free(&work.inputs);
    oz_scene_free(&work.scene);
    free(work.scene_path);
    free(work.frames_path);
    free(work.out);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
