/* Folders that orzo writes into. Nothing in them is ever removed or replaced that their marker
 * (base/marker.h) does not name: a name is noted there before its file is made, so that a crash
 * leaves none out.
 *
 * While a command works in a folder it holds an exclusive lock (flock) on the marker, a reader a
 * shared one; the system frees it when the process dies. On a file system without locks that is
 * said in the log, and there is none. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stdio.h>

/* What a command does in a folder. Lists end with NULL; NULL for none. */
typedef struct OzFolderUse {
    const char *const
        *writes; /* patterns (fnmatch) of what it writes: "log.txt", "snapshots/tap_*.png" */
    const char *const *endings;  /* names of files that only a run that has ended leaves       */
    const char *const *results;  /* names that are worth keeping, also of a run that was killed */
    bool overwrite;              /* endings, results and members' folders there may go          */
    const char *const *replaces; /* with keep: patterns of what goes all the same              */
    bool keep; /* what orzo wrote there stays until it is replaced, file by file */
} OzFolderUse;

/* A folder in use. Zeroed is valid: closed. */
typedef struct OzFolder {
    char *path; /* owned */
    int lock;   /* descriptor of the marker, 0 when closed */
} OzFolder;

/* Whether a command may use the folder, which need not exist: refuses, with OZ_ERR_INPUT and by
 * name, a file that use writes and no marker names; results without overwrite; a folder that
 * another process holds, or that lies in one. Touches nothing. */
OzStatus oz_folder_check(const char *path, const OzFolderUse *use);

/* Checks, makes the folder and its parents, locks it, and removes what the marker names (unless
 * use->keep). The caller closes. */
OzStatus oz_folder_open(OzFolder *folder, const char *path, const OzFolderUse *use);

/* For who only reads what a run has left there: a lock that readers share, and that keeps runs out.
 * Refuses a folder in which another process works. One without a marker is read without a lock, and
 * an OzFolder that stays closed. The caller closes. */
OzStatus oz_folder_read(OzFolder *folder, const char *path);

/* Gives the lock back; zeroed is fine. */
void oz_folder_close(OzFolder *folder);

/* To be called before name is made in the folder; a name that ends with a slash is a folder with a
 * marker of its own. Refuses a file that is there and that no marker names. In a folder without a
 * marker it does nothing. */
OzStatus oz_folder_note(const char *path, const char *name);

/* Notes a file and opens it for writing, empty. Fails with OZ_ERR_FILE, naming it. */
OzStatus oz_folder_create_file(FILE **file, const char *path, const char *name);

/* Closes a file so made; NULL is fine. Fails with OZ_ERR_FILE where not all of it was written. */
OzStatus oz_folder_finish_file(FILE *file, const char *name);

/* Whether the folder's marker names it. */
bool oz_folder_names(const char *path, const char *name);

/* Whether name matches one of the patterns. */
bool oz_folder_writes(const OzFolderUse *use, const char *name);
