/// Potentially visible sets: for each cell the cells seen from it, kept compressed.
#ifndef SIGHTLINE_PVS_H
#define SIGHTLINE_PVS_H

#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A row is bytes[offsets[cell] .. offsets[cell + 1]): numbers in LEB128 (seven bits a byte, low
/// first, the high bit set on all but the last), in turn how many cells are not in the set, how
/// many are, and so on from cell 0; the last run is one of cells in the set. Zeroed: no rows.
typedef struct sl_pvs {
    uint32_t cell_count;
    uint64_t *offsets; ///< cell_count + 1
    uint8_t *bytes;
    uint64_t *ends; ///< by cell, of rows that live (sightline/world.h): where its row ends, in
                    ///< place of offsets[cell + 1]. Else NULL
} sl_pvs;

SL_API void sl_pvs_destroy(sl_context *context, sl_pvs *pvs); ///< and zeroes it

/// A run of cells of a row, first .. end - 1.
typedef struct sl_pvs_run {
    uint32_t first, end;
    const uint8_t *next, *stop; ///< the iteration's own
} sl_pvs_run;

/// Iterates a row: for (sl_pvs_run r = sl_pvs_begin(pvs, cell); sl_pvs_next(&r);) first .. end - 1.
SL_API sl_pvs_run sl_pvs_begin(const sl_pvs *pvs, uint32_t cell);
/// Goes on to the next run; false behind the last.
SL_API bool sl_pvs_next(sl_pvs_run *run);

/// Whether cell `to` is in the row of cell `from`. Time: the length of the row.
SL_API bool sl_pvs_sees(const sl_pvs *pvs, uint32_t from, uint32_t to);
/// How many cells are in a row.
SL_API uint32_t sl_pvs_count(const sl_pvs *pvs, uint32_t cell);
// --- doors

/// For each pair that depends on doors its alternatives: the smallest sets of doors that some
/// sightline passes. The pair is seen exactly if of one of them no door is shut. Pairs that some
/// sightline joins without a door are not there, nor those that needed more alternatives than the
/// limit: they count as seen whatever is shut (counted by sl_effects_account.door_fallbacks).
/// Alternatives of fewer doors come first, of as many those with lower doors.
///
/// A row is bytes[offsets[cell] .. offsets[cell + 1]): numbers in LEB128, for each pair in turn the
/// cells passed over since the last one, how many alternatives, and for each of them how many
/// doors, then the doors passed over since the last one. Zeroed: no rows.
typedef struct sl_door_sets {
    uint32_t cell_count;
    uint64_t *offsets; ///< cell_count + 1
    uint8_t *bytes;
} sl_door_sets;

/// Bytes of all rows.
SL_API uint64_t sl_door_sets_bytes(const sl_door_sets *sets);

/// One of a pair's alternatives, `which` counted from 0: sets those of `doors` (by door of the map)
/// that it is made of, and leaves the others; NULL to ask only. False where there is none of that
/// number. Time: the length of the row.
SL_API bool sl_door_sets_alternative(const sl_door_sets *sets, uint32_t from, uint32_t to,
                                     uint32_t which, bool *doors);

/// A walk over a row's pairs: for (sl_door_pairs p = sl_door_pairs_begin(sets, cell);
/// sl_door_pairs_next(&p, shut);) p.cell, p.open.
typedef struct sl_door_pairs {
    uint32_t cell, alternatives;
    bool open;                  ///< seen, with what is shut
    const uint8_t *next, *stop; ///< the walk's own
} sl_door_pairs;

/// Starts a walk over the pairs of a cell's row.
SL_API sl_door_pairs sl_door_pairs_begin(const sl_door_sets *sets, uint32_t cell);
/// Goes on to the next pair; false behind the last.
SL_API bool sl_door_pairs_next(sl_door_pairs *pairs, const bool *shut);

// --- rows of view cells

/// "No view cell": empty space, where no viewpoint is.
#define SL_NO_VIEW_CELL UINT32_MAX

/// What view cells see, in cells of a space (sightline/view_cells.h makes them). Rows form a tree:
/// nodes below view_cell_count are view cells, and a view cell sees what its own row and the rows
/// of all nodes above it hold. Zeroed: none.
typedef struct sl_view_rows {
    uint32_t view_cell_count, node_count;
    uint32_t *view_cells; ///< by cell of the space: its view cell, or SL_NO_VIEW_CELL
    uint32_t *parents;    ///< by node: a node of a higher number, or SL_NO_VIEW_CELL
    sl_pvs rows;          ///< by node; as many rows as cells, the rest are empty
} sl_view_rows;

/// Expands rows to visible sets of cells: each cell sees what its view cell sees. `pairs`: how many
/// pairs there are. Untrusted rows must be checked before.
SL_API sl_status sl_view_rows_expand(sl_context *context, const sl_view_rows *rows, sl_pvs *out,
                                     uint64_t *pairs);
SL_API void sl_view_rows_destroy(sl_context *context, sl_view_rows *rows); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif
