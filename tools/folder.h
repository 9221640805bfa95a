/// Several files in one folder, all or none: they are written into a folder for the time being,
/// beside their places, and moved there when all is well.
#ifndef FOLDER_H
#define FOLDER_H

#include "sightline/support.h"

typedef struct sl_folder {
    char *path, *temporary;
    const char *const *names; ///< of the files, NULL behind the last
    bool exists;              ///< `path` was there before
} sl_folder;

/// `path` is the folder, which is made if missing (in a folder that is there). SL_BAD_ARGUMENT
/// where it, or a file's place in it, is taken by something else.
sl_status sl_folder_open(sl_context *context, const char *path, const char *const *names,
                         sl_folder *out);

/// Where a file is to be written; sl_free is the caller's. NULL where there is no memory.
char *sl_folder_file(sl_context *context, const sl_folder *folder, const char *name);

/// Where `status` is SL_OK, moves the files, all of which must be there, to their places; else
/// removes them. Returns what came of it.
sl_status sl_folder_close(sl_context *context, sl_folder *folder, sl_status status);

#endif
