/// What walls reveal that are taken away.
///
/// A line that is there only after the edit touches a wall that went, or runs along a portal that
/// came or went (along.c). So the sets of cells that came are searched as usual, and say which
/// other cells see these. And two cells that stay see each other newly by lines through a wall that
/// went: a search with that wall as the first portal of its sequence follows no others. Both cells
/// saw a cell that went (world_rows.h), so the search enters no cells but those and the ones that
/// came. It starts where some cell that it may find is not in the row yet, goes where these may be
/// (aim.c), and ends when it has found all of them.
///
///          a       |            The lines from a through the wall w are few:
///            `.    w            a narrow cone, and what it meets behind w.
///               `. |.
///                  |  ` b
#include "world/reveal.h"
#include "base/base.h"

#include <stdlib.h>

sl_status sli_reveal_pair(sl_context *context, sli_reveal_pairs *pairs, uint32_t place,
                          uint32_t other) {
    SL_TRY(SL_ARRAY_ROOM(context, pairs, 1));
    pairs->items[pairs->count++] = (sli_reveal_pair_of){place, other};
    return SL_OK;
}

/// Searches from the cells that came. None can see more than the changed cells.
static sl_status see_from_new(sl_context *context, const sli_live *live, sli_world_rows *r) {
    const size_t stayed = r->stayed;
    for (size_t i = stayed; i < r->changed.count; i++) {
        const uint32_t cell = r->changed.items[i];
        for (size_t k = 0; k < r->changed.count; k++) r->wanted.items[k] = k != i;
        r->wanted_count = r->changed.count - 1;
        SL_TRY(sli_world_rows_search(context, live, r, cell, NULL));
        for (size_t k = 0; k < r->seen.count; k++) {
            const uint32_t place = r->places[r->seen.items[k]];
            if (place && place <= stayed)
                SL_TRY(sli_reveal_pair(context, &r->pairs, place - 1, cell));
        }
        SL_TRY(sli_world_rows_write(context, r, cell));
    }
    return SL_OK;
}

// --- lines through a wall

/// Counts the cells on the left of a wall that are not in the row of a cell.
static void find_wanted(sli_world_rows *r, uint32_t cell) {
    const size_t stayed = r->stayed;
    for (size_t i = 0; i < r->changed.count; i++)
        r->wanted.items[i] = i < stayed && r->sides.items[i] & SLI_LEFT_OF_IT;
    for (sl_pvs_run run = sl_pvs_begin(&r->visibility.pvs, cell); sl_pvs_next(&run);)
        for (uint32_t c = run.first; c < run.end; c++)
            if (r->places[c]) r->wanted.items[r->places[c] - 1] = false;
    r->wanted_count = 0;
    for (size_t i = 0; i < stayed; i++) r->wanted_count += r->wanted.items[i];
}

/// Finds the pairs that lines join through a wall, from its right to its left.
static sl_status see_through(sl_context *context, const sli_live *live, sli_world_rows *r,
                             sl_segment wall) {
    const sl_directed_portal through = {.left = wall.a, .right = wall.b};
    const size_t stayed = r->stayed;
    for (size_t i = 0; i < stayed; i++)
        r->sides.items[i] = sli_reveal_side(&live->space, r->changed.items[i], wall);
    for (uint32_t i = 0; i < stayed; i++) {
        if (!(r->sides.items[i] & SLI_RIGHT_OF_IT)) continue;
        find_wanted(r, r->changed.items[i]);
        if (!r->wanted_count) continue;
        SL_TRY(sli_world_rows_search(context, live, r, r->changed.items[i], &through));
        for (size_t k = 0; k < r->seen.count; k++) {
            const uint32_t place = r->places[r->seen.items[k]];
            if (!place || place > stayed || !r->wanted.items[place - 1]) continue;
            SL_TRY(sli_reveal_pair(context, &r->pairs, i, r->seen.items[k]));
            SL_TRY(sli_reveal_pair(context, &r->pairs, place - 1, r->changed.items[i]));
        }
    }
    return SL_OK;
}

// --- rows

/// Sorts what came by the cells that see it.
static void sort_pairs(sli_world_rows *r) {
    uint32_t *first = r->first.items, *more = r->more.items;
    for (size_t i = 0; i <= r->stayed; i++) first[i] = 0;
    for (size_t i = 0; i < r->pairs.count; i++) first[r->pairs.items[i].place]++;
    for (size_t i = 0; i < r->stayed; i++) first[i + 1] += first[i];
    for (size_t i = r->pairs.count; i-- > 0;)
        more[--first[r->pairs.items[i].place]] = r->pairs.items[i].other;
    for (size_t i = 0; i < r->stayed; i++)
        qsort(more + first[i], first[i + 1] - first[i], sizeof *more, sli_compare_whole);
}

/// Writes the row of a cell that stays: what it has of cells that stay, and what came. `lost`: the
/// next pair that is not joined any more.
static sl_status write_row(sl_context *context, const sli_live *live, sli_world_rows *r,
                           uint32_t place, size_t *lost) {
    const uint32_t stop = r->first.items[place + 1];
    uint32_t at = r->first.items[place];
    r->seen.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &r->seen, live->space.cell_count + r->pairs.count));
    for (sl_pvs_run run = sl_pvs_begin(&r->visibility.pvs, r->changed.items[place]);
         sl_pvs_next(&run);)
        for (uint32_t c = run.first; c < run.end; c++) {
            const bool left = *lost < r->joined.count && r->joined.items[*lost].place == place;
            if (left && r->joined.items[*lost].other == c) {
                ++*lost;
                continue;
            }
            // A number may have gone and come again; what it sees now is among the pairs.
            if (!live->space.cells[c].vertex_count || r->places[c] > r->stayed) continue;
            while (at < stop && r->more.items[at] < c)
                r->seen.items[r->seen.count++] = r->more.items[at++];
            r->seen.items[r->seen.count++] = c;
        }
    while (at < stop) r->seen.items[r->seen.count++] = r->more.items[at++];
    return sli_world_rows_write(context, r, r->changed.items[place]);
}

static sl_status reveal(sl_context *context, const sli_live *live, sli_world_rows *r,
                        const sl_segment *opened, size_t count) {
    size_t lost = 0;
    r->pairs.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &r->sides, r->stayed));
    SL_TRY(SL_ARRAY_ROOM(context, &r->wanted, r->changed.count));
    SL_TRY(see_from_new(context, live, r));
    for (size_t i = 0; i < count; i++) SL_TRY(see_through(context, live, r, opened[i]));
    r->wanted_count = 0;
    SL_TRY(sli_reveal_along(context, live, r));
    SL_TRY(SL_ARRAY_ROOM(context, &r->first, r->stayed + 1));
    SL_TRY(SL_ARRAY_ROOM(context, &r->more, r->pairs.count));
    sort_pairs(r);
    for (uint32_t i = 0; i < r->stayed; i++) SL_TRY(write_row(context, live, r, i, &lost));
    return SL_OK;
}

sl_status sli_world_rows_reveal(sl_context *context, const sli_live *live, sli_world_rows *r,
                                const sl_segment *opened, size_t count) {
    sli_reveal_begin(r, &live->came);
    const sl_status status = reveal(context, live, r, opened, count);
    sli_reveal_end(r, &live->came);
    return status;
}
