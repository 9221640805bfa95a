/// The visible sets of a world.
///
/// Which sets does an edit change? Let a line join two cells that stay, and let it be there only
/// before or only after the edit. Then it passes the region of the cells that went, which is that
/// of the cells that came. Up to there it is the same as before. So both cells saw a cell that
/// went. The sets of all cells that did, and of those that came, are searched again; no other
/// changes.
#ifndef SL_WORLD_ROWS_H
#define SL_WORLD_ROWS_H

#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/search/portal_search.h"
#include "world/live.h"

typedef struct sli_world_rows {
    bool kept; ///< the world has visible sets
    sl_visibility visibility;
    sli_portal_search search;
    sli_blocks blocks; ///< of the rows, in words of 4 bytes
    size_t word_room;
    uint32_t *words; ///< by cell: how many the row's block was taken for; 0 for none
    uint32_t *marks; ///< by cell: the search that saw it, or that lists it
    uint8_t *loose;  ///< by cell: its set is conservative
    size_t cell_room;
    uint32_t now;          ///< the last mark
    sli_numbers changed;   ///< cells whose rows the last edit may have changed
    sli_numbers unsettled; ///< cells that may be loose
    sli_numbers seen;      ///< by the search under way
    sli_row_bytes row;
    uint64_t tests, most_tests; ///< of the searches since settling began
} sli_world_rows;

sl_status sli_world_rows_start(sl_context *context, const sli_live *live, sl_sight sight,
                               sli_world_rows *rows);
void sli_world_rows_destroy(sl_context *context, sli_world_rows *rows);

/// Finds the cells that stay and whose rows a planned edit may change, and makes room.
sl_status sli_world_rows_plan(sl_context *context, const sli_live *live, sli_world_rows *rows);
/// After the edit: drops the rows of cells that went, and adds those that came to the changed ones.
void sli_world_rows_apply(const sli_live *live, sli_world_rows *rows);
/// Writes rows for the changed cells that miss nothing. `opened`: walls went or moved.
sl_status sli_world_rows_loosen(sl_context *context, const sli_live *live, sli_world_rows *rows,
                                bool opened);
/// Marks the rows of changed cells as loose, whatever they are.
void sli_world_rows_doubt(sli_world_rows *rows);
/// Makes loose rows exact for a time, in seconds.
sl_status sli_world_rows_settle(sl_context *context, const sli_live *live, sli_world_rows *rows,
                                double seconds);
/// Leaves no rows, and all cells loose.
void sli_world_rows_lose(const sli_live *live, sli_world_rows *rows);

#endif
