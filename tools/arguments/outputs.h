/// Files that commands write. Names are checked before the work begins. Several files in one folder
/// are written all or none. Also sizes in bytes.
#ifndef OUTPUTS_H
#define OUTPUTS_H

#include "arguments/options.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <stdint.h>

/// Checks the argument of `option`, a file to be written, before the work is done. SL_BAD_ARGUMENT
/// where it is empty, or ends in none of `endings` (".map .txt"; NULL: any), and is no pipe or
/// device. SL_IO where nothing can be written there.
sl_status output_check_file(sl_context *context, const char *option, const char *output,
                            const char *endings);
/// The same for a table, whose name ends in .csv or .txt, in one of `more` (NULL: none), or has no
/// ending.
sl_status output_check_table(sl_context *context, const char *option, const char *output,
                             const char *more);
/// The same for a baked file, whose name must end in .slv.
sl_status output_check_baked(sl_context *context, const char *option, const char *output);
/// The same for a picture, whose name must end in .png, .svg or .pdf, or in one of `more` (NULL:
/// none).
sl_status output_check_picture(sl_context *context, const char *option, const char *output,
                               const char *more);

#define OUTPUT_TABLES ".csv .txt"

/// Whether a name ends in one of `endings`.
bool output_has_ending(const char *path, const char *endings);

/// SL_BAD_ARGUMENT: "-o x.abc: end the name in .map or .txt".
sl_status output_fail_ending(sl_context *context, const char *option, const char *output,
                             const char *endings);

/// Sets *chosen to the export format that the ending of `output` says, where `given` is NULL. Else
/// checks that the ending fits the chosen format. A stream, or a name without an ending, fits all.
sl_status output_choose_export(sl_context *context, const name_table *formats, const char *option,
                               const char *output, const char *given, size_t *chosen);

/// Whether two names of outputs stand for one file, maybe through links.
bool output_is_same(const char *path, const char *other);

/// Whether a name stands for a file that is there, and no pipe or device; "-" does not.
bool output_is_plain_file(const char *path);

/// SL_BAD_ARGUMENT where an output is the input itself, maybe through links: it would be replaced.
/// "-" is stdin or stdout.
sl_status output_check_apart(sl_context *context, const char *input, const char *option,
                             const char *output);

/// The options --width, --dark and, if `titled`, --title and those of paper, of the picture that
/// the option `output` names; of several with spaces between, any.
option_table picture_option_table(sl_draw_options *drawing, const char *output, bool titled);

/// Several files in one folder, all or none. They are written into a temporary folder and moved to
/// their places at the end.
typedef struct output_folder {
    char *path, *temporary;
    const char *const *names; ///< of the files, NULL behind the last
    bool exists;              ///< `path` was there before
} output_folder;

/// Makes the folder `path` if it is missing; its parent must exist. SL_BAD_ARGUMENT where something
/// else has the name of the folder or of a file in it.
sl_status folder_open(sl_context *context, const char *path, const char *const *names,
                      output_folder *out);

/// The path to write a file to, which the caller frees (sl_free). NULL where there is no memory.
char *folder_file(sl_context *context, const output_folder *folder, const char *name);

/// Moves the files to their places if `status` is SL_OK; all must be there. Else removes them.
/// Returns the outcome.
sl_status folder_close(sl_context *context, output_folder *folder, sl_status status);

enum { SIZE_TEXT = 32 };

/// "812 bytes", "3.4 MiB"
void size_write(uint64_t bytes, char text[SIZE_TEXT]);

#endif
