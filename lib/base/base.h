/// The context, as the library itself knows it.
#ifndef SL_BASE_H
#define SL_BASE_H

#include "sightline/support.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// A table of methods that other libraries add to: copies of items that begin with their name.
/// Empty as long as the library's own items are all.
typedef struct sli_table {
    void *items;
    size_t count;
} sli_table;

struct sl_context {
    sl_hooks hooks;
    char message[1024];
    sl_limits limits;         ///< 0: the usual ones
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

/// The order of two 32-bit numbers, for qsort.
static inline int sli_compare_whole(const void *left, const void *right) {
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

/// 10^power, to the nearest double.
double sli_power_of_ten(int power);

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

// --- files that are read back before they take their place

/// What was written, from its beginning.
typedef struct sli_again {
    FILE *stream; ///< NULL: it is in memory, at `at`
    const char *at;
    uint64_t left; ///< bytes that are not taken yet
} sli_again;

/// Takes the next bytes; false where fewer are left, or they cannot be read.
bool sli_again_take(sli_again *again, void *buffer, size_t count);

/// A file to write. `print` writes it: refused writes are left to the stream's error flag.
/// `read_back` reads what was written as a reader of such files does, and fails as that does.
typedef struct sli_to_write {
    const void *user;
    sl_status (*print)(sl_context *context, const void *user, FILE *stream);
    sl_status (*read_back)(sl_context *context, const void *user, const char *name,
                           sli_again *again);
} sli_to_write;

/// Writes a file beside its target, reads it back, and puts it in its place. So no file is left
/// that the project's own reader would refuse: SL_UNSUPPORTED, with the reader's message, and the
/// target stays as it was. Standard output, devices and pipes get nothing either then: for them the
/// file is written to memory first. Notes and progress of the reading are not handed on.
sl_status sli_file_write(sl_context *context, const char *path, const sli_to_write *file);

/// Reads back by file->read_back: part of sli_file_write().
sl_status sli_read_back(sl_context *context, const char *path, const sli_to_write *file,
                        sli_again again);

/// Gives back the room behind `count` items, one or more, where the system takes it.
void sli_shrink(sl_context *context, void *items, size_t *capacity, size_t count, size_t item_size);

/// The length of the decimal number at the start of text[0 .. length), 0 for none.
size_t sli_number_length(const char *text, size_t length);

#endif
