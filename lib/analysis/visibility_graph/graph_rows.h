/// Rows of a visibility graph: written as runs (sightline/vga.h), read as bits.
#ifndef SL_VGA_ROWS_H
#define SL_VGA_ROWS_H

#include "sightline/support.h"
#include "sightline/vga.h"

/// Where the rows of a graph come from. Threads take bundles of 64 points; each has a state.
typedef struct sli_vga_source {
    uint32_t count;  ///< of rows
    uint32_t points; ///< of a row
    bool directed;   ///< as sl_vga_graph
    void *job;
    sl_status (*begin)(sl_context *context, void *job, void **state); ///< NULL: no state
    void (*end)(sl_context *context, void *job, void *state);
    /// Adds what a point sees to a zeroed set. The point itself is taken out afterwards.
    sl_status (*look)(sl_context *context, void *job, void *state, uint32_t point, sl_bits *row);
    const char *stage; ///< for reports; NULL: none
} sli_vga_source;

/// Makes a graph. `threads`: 0 for one per core.
sl_status sli_vga_graph_write(sl_context *context, const sli_vga_source *source, unsigned threads,
                              sl_vga_graph *out);

/// Adds what a point sees to a set.
void sli_vga_add_row(const sl_vga_graph *graph, uint32_t point, sl_bits *row);

/// The bytes that a graph takes.
uint64_t sli_vga_graph_size(const sl_vga_graph *graph);

#endif
