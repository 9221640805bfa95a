/// Files that commands write: their names are checked before the work begins, several in one folder
/// come all or none; and sizes in bytes.
#ifndef OUTPUTS_H
#define OUTPUTS_H

#include "sightline/draw.h"
#include "sightline/support.h"

#include <stdint.h>

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

/// Fills what all pictures have; `width` is what --width was given, or NULL. SL_BAD_ARGUMENT.
sl_status sl_picture_plan(sl_context *context, const char *width, const char *title, bool dark,
                          sl_draw_options *out);

/// As sl_output_check() of inputs.h, and SL_BAD_ARGUMENT where the name is that of no kind of
/// picture that can be written.
sl_status sl_picture_check(sl_context *context, const char *path, const char *option,
                           const char *output);

enum { SL_SIZE_TEXT = 32 };

/// "812 bytes", "3.4 MiB"
void sl_size_write(uint64_t bytes, char text[SL_SIZE_TEXT]);

/// Of a file, 0 where the system does not tell.
uint64_t sl_size_of_file(const char *path);

/// The most memory that this process has had, 0 where the system does not tell.
uint64_t sl_size_of_peak_memory(void);

#endif
