/// While one source is searched: for each cell the smallest sets of doors found to join the two.
#ifndef SL_DOOR_TABLE_H
#define SL_DOOR_TABLE_H

#include "cell_to_cell/pvs_rows.h"
#include "sightline/support.h"

/// A set of doors, `words` words in sli_door_table.sets.
typedef struct sli_door_alternative {
    uint32_t next; ///< of the same cell; UINT32_MAX for none
    bool dropped;  ///< a smaller set has been found since
} sli_door_alternative;

typedef struct sli_door_table {
    size_t words; ///< of a set; 0 where the map has no doors
    uint32_t cell_count, limit;
    uint32_t *first; ///< by cell: of alternatives; UINT32_MAX for none
    uint32_t *count; ///< by cell: of alternatives that stand
    sl_bits *seen;   ///< cells with any
    sl_bits *free;   ///< cells that no door, or more alternatives than the limit, lead to
    SL_ARRAY(sli_door_alternative) alternatives;
    SL_ARRAY(sl_bits) sets;
    SL_ARRAY(uint32_t) sorted; ///< scratch: alternatives of one cell
    uint64_t fallbacks;        ///< since it was made: pairs beyond the limit
} sli_door_table;

sl_status sli_door_table_create(sl_context *context, uint32_t cells, size_t doors, uint32_t limit,
                                sli_door_table *table);
void sli_door_table_destroy(sl_context *context, sli_door_table *table);
void sli_door_table_clear(sli_door_table *table);

/// Whether a cell is known to be joined to the source by some of these doors.
bool sli_door_table_proves(const sli_door_table *table, uint32_t cell, const sl_bits *doors);

/// Adds what a sequence has found: `doors` join the source and the cell.
sl_status sli_door_table_add(sl_context *context, sli_door_table *table, uint32_t cell,
                             const sl_bits *doors);

/// Appends the row of sl_door_sets, of the cells from `first` on.
sl_status sli_door_table_append(sl_context *context, sli_door_table *table, uint32_t first,
                                sli_row_bytes *row);

/// From rows that have each pair in the row of its lower cell alone, makes rows that have it in
/// both.
sl_status sli_door_rows_mirror(sl_context *context, sli_row_bytes *rows, uint32_t count);

#endif
