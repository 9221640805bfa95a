/// Files that commands write: their names are checked before the work begins, several in one folder
/// come all or none; and sizes in bytes.
#ifndef OUTPUTS_H
#define OUTPUTS_H

#include "options.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <stdint.h>

/// Before the work is done: SL_BAD_ARGUMENT where what `option` names to be written is no name, or
/// the input `path` itself, which it would replace; SL_IO where nothing can be written there.
sl_status output_check_file(sl_context *context, const char *path, const char *option,
                            const char *output);
/// Likewise for what is to be a baked file, which is known by its ending.
sl_status output_check_baked(sl_context *context, const char *path, const char *option,
                             const char *output);
/// Likewise for a picture, whose ending says its kind.
sl_status output_check_picture(sl_context *context, const char *path, const char *option,
                               const char *output);

/// --width, --dark and, where `titled`, --title.
option_table picture_option_table(sl_draw_options *drawing, bool titled);

/// Several files in one folder, all or none: they are written into a folder for the time being,
/// beside their places, and moved there when all is well.
typedef struct output_folder {
    char *path, *temporary;
    const char *const *names; ///< of the files, NULL behind the last
    bool exists;              ///< `path` was there before
} output_folder;

/// `path` is the folder, which is made if missing (in a folder that is there). SL_BAD_ARGUMENT
/// where it, or a file's place in it, is taken by something else.
sl_status folder_open(sl_context *context, const char *path, const char *const *names,
                      output_folder *out);

/// Where a file is to be written; sl_free is the caller's. NULL where there is no memory.
char *folder_file(sl_context *context, const output_folder *folder, const char *name);

/// Where `status` is SL_OK, moves the files, all of which must be there, to their places; else
/// removes them. Returns what came of it.
sl_status folder_close(sl_context *context, output_folder *folder, sl_status status);

enum { SIZE_TEXT = 32 };

/// "812 bytes", "3.4 MiB"
void size_write(uint64_t bytes, char text[SIZE_TEXT]);

/// Of a file, 0 where the system does not tell.
uint64_t size_of_file(const char *path);

/// The most memory that this process has had, 0 where the system does not tell.
uint64_t size_of_peak_memory(void);

#endif
