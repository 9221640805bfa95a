/// Files that a file names: tilesets, levels.
#ifndef SL_IMPORT_BESIDE_H
#define SL_IMPORT_BESIDE_H

#include "base/file.h"

/// Reads the file `relative`, as the file `name` calls it: a path from where that one lies, `\` as
/// good as `/`. `path` gets the path it was read from, bytes->data the bytes; sl_free is the
/// caller's for both. SL_BAD_INPUT, naming both files, where it cannot be read or is no plain file
/// of at most 2^30 bytes.
sl_status sl_beside_read(sl_context *context, const char *name, const char *relative, char **path,
                         sl_bytes *bytes);

#endif
