/// The visible sets of a world.
///
/// Which sets does an edit change? Let a line join two cells that stay, and let it be there only
/// before or only after the edit. Then it passes the region of the cells that went, which is that
/// of the cells that came. Up to there it is the same as before. So both cells saw a cell that
/// went. The sets of all cells that did, and of those that came, are searched again; no other
/// changes. With one-way glass, one of the two sees and the other one is seen: those that see a
/// cell that goes are searched for.
#ifndef SL_WORLD_ROWS_H
#define SL_WORLD_ROWS_H

#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/search/portal_search.h"
#include "world/live.h"

/// A cell, by its place in `changed`, and another one that it sees.
typedef struct sli_reveal_pair_of {
    uint32_t place, other;
} sli_reveal_pair_of;

typedef SL_ARRAY(sli_reveal_pair_of) sli_reveal_pairs;

typedef struct sli_world_rows {
    bool kept; ///< the world has visible sets
    sl_visibility visibility;
    sli_portal_search search;
    sli_blocks blocks; ///< of the rows, in words of 4 bytes
    size_t word_room;
    uint32_t *words; ///< by cell: how many the row's block was taken for; 0 for none
    uint32_t *marks; ///< by cell: the search that saw it, or that lists it
    uint8_t *loose;  ///< by cell: its set is conservative
    bool limits;     ///< there are limited walls, which the sets take as open
    size_t cell_room;
    uint32_t now;          ///< the last mark
    sli_numbers changed;   ///< cells whose rows the last edit may have changed
    sli_numbers unsettled; ///< cells that may be loose
    sli_numbers seen;      ///< by the search under way
    sli_row_bytes row;
    // What walls reveal that are taken away (reveal.c).
    uint32_t stayed;     ///< so many changed cells stay; they are the first
    uint32_t *places;    ///< by cell: 1 + its place in `changed`; 0 for none
    bool backwards;      ///< the search finds cells that see the first one
    bool within_places;  ///< the search enters cells with places only
    size_t wanted_count; ///< cells that the search still has to see, then it stops; 0: no such end
    SL_ARRAY(bool) wanted;        ///< by place: they are such
    sli_numbers targets;          ///< cells that are wanted and not seen yet (aim.c)
    SL_ARRAY(uint8_t) sides;      ///< by place: where it lies, seen along a wall
    sli_reveal_pairs pairs;       ///< that came
    sli_numbers first, more;      ///< of the same: by place, the others
    SL_ARRAY(sl_segment) portals; ///< that are there only before or only after the edit
    sli_numbers touched;          ///< cells that a line meets
    sli_reveal_pairs joined;      ///< by lines along portals, before the edit
    uint64_t tests, most_tests;   ///< of the searches since settling began
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
/// Before an edit that takes walls away: notes what sli_world_rows_reveal will need.
sl_status sli_world_rows_note_lines(sl_context *context, const sli_live *live,
                                    sli_world_rows *rows);
/// Makes the changed rows exact after an edit that took walls away and did nothing else: `opened`
/// are those, and all rows were exact before.
sl_status sli_world_rows_reveal(sl_context *context, const sli_live *live, sli_world_rows *rows,
                                const sl_segment *opened, size_t count);
/// Makes loose rows exact for a time, in seconds.
sl_status sli_world_rows_settle(sl_context *context, const sli_live *live, sli_world_rows *rows,
                                double seconds);
/// Leaves no rows, and all cells loose.
void sli_world_rows_lose(const sli_live *live, sli_world_rows *rows);

/// Begins new marks.
void sli_world_rows_next_mark(sli_world_rows *rows);
/// Searches from a cell: `seen` is then what it sees, by lines that also cross `through`, if that
/// is not NULL.
sl_status sli_world_rows_search(sl_context *context, const sli_live *live, sli_world_rows *rows,
                                uint32_t cell, const sl_directed_portal *through);
/// Likewise by one line alone.
sl_status sli_world_rows_search_along(sl_context *context, const sli_live *live,
                                      sli_world_rows *rows, uint32_t cell, sl_segment line);
/// Writes `seen` as the row of a cell.
sl_status sli_world_rows_write(sl_context *context, sli_world_rows *rows, uint32_t cell);

#endif
