/// The context, as the library itself knows it.
#ifndef SL_BASE_H
#define SL_BASE_H

#include "sightline/support.h"

/// A table of methods that other libraries add to: copies of items that begin with their name.
/// Empty as long as the library's own items are all.
typedef struct sl_table {
    void *items;
    size_t count;
} sl_table;

struct sl_context {
    sl_hooks hooks;
    char message[1024];
    sl_table map_formats;    ///< of sl_map_format
    sl_table export_formats; ///< of sl_export_format
};

/// The items of a table: those that were added to, else `own`.
const void *sl_table_items(const sl_table *table, const void *own, size_t own_count, size_t *count);

/// Adds items of `size` bytes to those that are there, `own` at first. Items whose name is there
/// already are passed over.
sl_status sl_table_add(sl_context *context, sl_table *table, size_t size, const void *own,
                       size_t own_count, const void *more, size_t count);

#endif
