/// The context, as the library itself knows it.
#ifndef SL_BASE_H
#define SL_BASE_H

#include "sightline/support.h"

#include <stddef.h>
#include <stdint.h>

/// A table of methods that other libraries add to: copies of items that begin with their name.
/// Empty as long as the library's own items are all.
typedef struct sli_table {
    void *items;
    size_t count;
} sli_table;

struct sl_context {
    sl_hooks hooks;
    char message[1024];
    sli_table map_formats;    ///< of sl_map_format
    sli_table export_formats; ///< of sl_export_format
};

/// The items of a table: those that were added to, else `own`.
const void *sli_table_items(const sli_table *table, const void *own, size_t own_count,
                            size_t *count);

/// Adds items of `size` bytes to those that are there, `own` at first. Items whose name is there
/// already are passed over.
sl_status sli_table_add(sl_context *context, sli_table *table, size_t size, const void *own,
                        size_t own_count, const void *more, size_t count);

// --- The checksum of baked files: CRC-32 with the polynomial of ISO 3309, as in zlib, PNG and
// gzip.

/// A sum that grows. sli_checksum_begin() makes it, sli_checksum_value() gives it.
typedef struct sli_checksum {
    uint32_t table[16][256];
    uint32_t state;
} sli_checksum;

void sli_checksum_begin(sli_checksum *sum);
void sli_checksum_add(sli_checksum *sum, const void *bytes, size_t count);
uint32_t sli_checksum_value(const sli_checksum *sum);

#endif
