/// Tables in parts: each process of several computes some of the rows, and `sightline merge` joins
/// them to the table that one process would write, byte for byte.
///
/// A part is a table between two lines, which say what it is and that it is whole:
///
///     # sightline part 2/3, rows 4 to 6 of 9, made from k0123456789abcdef
///     x,y,connectivity
///     ...
///     # end of part 2/3
#ifndef TABLE_PART_H
#define TABLE_PART_H

#include "arguments/options.h"
#include "reports/fields.h"

/// Zeroed: the whole table.
typedef struct table_part {
    const char *text;     ///< "2/3"; NULL for all
    uint32_t part, count; ///< 0, 0 for all
    uint64_t made_from;
} table_part;

/// Reads "2/3", of --shard.
sl_status share_read(sl_context *context, const char *text, uint32_t *part, uint32_t *count);

/// Call it with the command's arguments, after they are read. Nothing but the part, the number of
/// threads and the table's name may differ between the parts of a table.
sl_status table_part_plan(sl_context *context, int argc, char **argv, const char *output,
                          table_part *part);

/// The rows that a part has, of so many: from *first up to *stop, without it.
void table_part_rows(const table_part *part, size_t count, size_t *first, size_t *stop);

/// Writes a part, or the whole table. "-": stdout.
sl_status table_part_write(sl_context *context, const table_part *part, const field_rows *rows,
                           const char *path);

/// Joins the parts of a table, in any order. Names the one that is missing, doubled, cut short or
/// of another table.
sl_status table_parts_merge(sl_context *context, const char *const *paths, uint32_t count,
                            const char *output);

#endif
