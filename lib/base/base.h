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

// --- Independent work in numbered units, spread over threads.

/// What a thread does. `begin` makes what the thread needs for itself (out into *state), `unit`
/// does one unit, `end` frees the state; begin, units and end of a state run in one thread. Units
/// are handed out in ascending order, any thread may get any unit. `begin` and `end` may be NULL.
/// `after`: NULL, or for each unit the number of the first unit of its wave: waves are runs of
/// units, and one starts when all before it are done.
typedef struct sli_work {
    void *job;
    sl_status (*begin)(sl_context *context, void *job, void **state);
    sl_status (*unit)(sl_context *context, void *job, void *state, size_t unit);
    void (*end)(sl_context *context, void *job, void *state);
    void (*leave_thread)(void);
    const char *stage, *units; ///< for the progress report; NULL: none
    const size_t *after;
} sli_work;

/// Runs units 0 .. count-1 on `threads` threads (0: one a core), the caller's among them. The first
/// failure stops the rest; with several at once, that of the lowest unit is returned.
sl_status sli_work_run(sl_context *context, const sli_work *work, size_t count, unsigned threads);

/// The number of threads that 0 stands for.
unsigned sli_core_count(void);

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
