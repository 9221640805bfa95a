/// Whole files in, whole files out: a file is written beside its target and renamed, so that a
/// failure leaves the old one as it was and nothing half-written.
#ifndef SL_FILE_H
#define SL_FILE_H

#include "base/base.h"

typedef struct sl_bytes {
    char *data; ///< `size` bytes and a 0 behind them
    size_t size;
} sl_bytes;

/// Reads all of a file, or of stdin where path is "-"; sl_free(data) is the caller's. SL_IO with
/// the system's reason on failure, SL_BAD_INPUT where it is too large: of more
/// bytes than a quarter of the machine's memory or, of a pipe or a device, than 1 GiB.
sl_status sl_file_read(sl_context *context, const char *path, sl_bytes *out);

typedef struct sl_output {
    FILE *stream;
    char *path, *temporary;
} sl_output;

/// Opens a file beside `path` (or what a link there leads to) for writing; stdout where path is
/// "-"; a device or a pipe itself.
sl_status sl_output_open(sl_context *context, const char *path, sl_output *out);
/// Fails as sl_output_open() would, and leaves nothing: asked before work that takes long. A device
/// or a pipe is not touched.
sl_status sl_output_try(sl_context *context, const char *path);
/// Flushes to the disk and takes the target's place; on failure the target is left as it was.
sl_status sl_output_commit(sl_context *context, sl_output *output);
/// Commits where `status` is SL_OK, else gives up and removes what was written; returns what came
/// of it.
sl_status sl_output_close(sl_context *context, sl_output *output, sl_status status);

#endif
