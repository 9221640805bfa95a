/// What files need of the operating system: file_posix.c and memory_posix.c, and file_windows.c in
/// their place there.
/// All paths are UTF-8. What fails sets errno.
#ifndef SLI_FILE_SYSTEM_H
#define SLI_FILE_SYSTEM_H

#include "sightline/support.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// Whether a path is what stdout goes to, as /dev/stdout is.
bool sli_path_is_stdout(const char *path);
/// The file that a path leads to, also where that file is not there yet; the path itself where it
/// is no link. To be freed; NULL for no memory.
char *sli_path_target(sl_context *context, const char *path);

/// fopen.
FILE *sli_file_open(const char *path, const char *mode);
/// Whether a stream reads a whole file, and its size; else it is a device or a pipe.
bool sli_file_is_whole(FILE *stream, uint64_t *size);
/// Makes a file beside `path` with its mode, or the usual one where nothing is at `path`. Its name
/// goes to `temporary`, which has room for 8 characters more than the path; empty on failure.
FILE *sli_file_make_beside(const char *path, char *temporary);
/// Whether what was written is on the disk, as far as a stream has one.
bool sli_file_to_disk(FILE *stream);
/// Puts a file in the place of another one, at once.
bool sli_file_replace(const char *from, const char *to);
/// Removes a file, if it is there.
void sli_file_remove(const char *path);

/// A stream that is written to memory.
typedef struct sli_memory_stream {
    FILE *stream;
    char *text; ///< after sli_memory_close(): what was written, to be freed by free()
    size_t size;
} sli_memory_stream;

bool sli_memory_open(sli_memory_stream *memory);
/// Whether all of it was kept; else there is no text.
bool sli_memory_close(sli_memory_stream *memory);

#endif
