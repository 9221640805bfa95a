/// Files that a file names: tilesets, levels, pictures.
#ifndef SL_IMPORT_BESIDE_H
#define SL_IMPORT_BESIDE_H

#include "sightline/support.h"

/// The path of the file `relative`, as the file `name` calls it: from where that one lies, unless
/// it is a whole path; `\` is as good as `/`. sl_free is the caller's; NULL for lack of memory.
char *sl_beside_path(sl_context *context, const char *name, const char *relative);

/// Whether there is a plain file: a device may never end.
bool sl_beside_is_there(const char *path);

/// Reads such a file. `path` gets the path it was read from, bytes->data the bytes; sl_free is the
/// caller's for both. SL_BAD_INPUT, naming both files, where it cannot be read or is no plain file
/// of at most 2^30 bytes.
sl_status sl_beside_read(sl_context *context, const char *name, const char *relative, char **path,
                         sl_bytes *bytes);

#endif
