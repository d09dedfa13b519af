/* A state (base/state.h) as a file: HDF5, readable with any tool for it, behind a head of our own.
 *
 *   head     512 bytes: char[8] "ozstate\n"; u32 0x01020304; u32 version 1; u64 bytes of the whole
 *            file; zeros; u64 checksum (FNV-1a, 64 bits) of all other bytes
 *   HDF5     a dataset for each entry, under its name, of the entry's kind (bytes are uint8), with
 *            the attribute "unit"; and the dataset "entries", their names in order, a line each
 *
 * Nothing that the head does not vouch for is given to libhdf5, which is opened by dlopen by the
 * first call here and by nothing else. */
#pragma once

#include "base/state.h"

/* Written beside path, synced and renamed; a file that stood there is path.previous afterwards.
 * Fails with OZ_ERR_FILE, path and its previous one untouched. */
OzStatus oz_state_file_write(const OzState *state, const char *path);

/* The caller frees the state, which is empty after a failure. A file that is damaged, cut short, of
 * another kind or of a newer version is refused with OZ_ERR_INPUT and its reason. */
OzStatus oz_state_file_read(OzState *state, const char *path);
