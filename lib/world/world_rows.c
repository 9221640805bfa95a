/// Visible sets that live: rows in blocks, searched again one by one.
///
/// The search is that of the method "dfs", with the exact solver: it goes through portals as long
/// as some line stabs all portals on the way (Teller & Séquin 1991). Cost: a stabbing test for each
/// portal sequence that is seen, and for each portal that leads out of it. Where few walls stand in
/// open ground there are many sequences. Once the tests have cost as much as the default method
/// would, that one sees all cells of a copy, and the rows that are not settled are taken from it.
#include "base/base.h"
#include "world/aim.h"

#include "cell_to_cell/search/directions.h"
#include "sightline/effects.h"
#include "sightline/stab.h"

#include <stdlib.h>
#include <string.h>

// --- rows in blocks

static void drop_row(sli_world_rows *r, uint32_t cell) {
    sl_pvs *pvs = &r->visibility.pvs;
    if (r->words[cell])
        sli_block_give(&r->blocks, (uint32_t *)(void *)pvs->bytes,
                       (uint32_t)(pvs->offsets[cell] / 4), r->words[cell]);
    r->words[cell] = 0;
    pvs->offsets[cell] = pvs->ends[cell] = 0;
}

/// Makes room for `more` words of rows behind those that are used.
static sl_status grow_words(sl_context *context, sli_world_rows *r, size_t more) {
    size_t bytes = 4 * r->word_room;
    const size_t needed = 4 * ((size_t)r->blocks.used + more);
    if (needed / 4 > INT32_MAX) return sl_fail_memory(context);
    SL_TRY(sl_reserve(context, &r->visibility.pvs.bytes, &bytes, needed, 1));
    r->word_room = bytes / 4;
    return SL_OK;
}

sl_status sli_world_rows_write(sl_context *context, sli_world_rows *r, uint32_t cell) {
    sl_pvs *pvs = &r->visibility.pvs;
    bool sorted = true;
    for (size_t i = 1; i < r->seen.count && sorted; i++)
        sorted = r->seen.items[i - 1] <= r->seen.items[i];
    if (!sorted) qsort(r->seen.items, r->seen.count, sizeof *r->seen.items, sli_compare_whole);
    r->row.count = 0;
    SL_TRY(sli_row_append_list(context, &r->row, r->seen.items, r->seen.count));
    const uint32_t words = (uint32_t)((r->row.count + 3) / 4);
    if (!r->words[cell] || sli_block_class(words) != sli_block_class(r->words[cell])) {
        SL_TRY(grow_words(context, r, sli_block_size(words)));
        drop_row(r, cell);
        const uint32_t *chain = (const uint32_t *)(const void *)pvs->bytes;
        pvs->offsets[cell] = 4 * (uint64_t)sli_block_take(&r->blocks, chain, words);
        r->words[cell] = words;
    }
    memcpy(pvs->bytes + pvs->offsets[cell], r->row.items, r->row.count);
    pvs->ends[cell] = pvs->offsets[cell] + r->row.count;
    return SL_OK;
}

// --- the search

void sli_world_rows_next_mark(sli_world_rows *r) {
    if (r->now == UINT32_MAX) {
        memset(r->marks, 0, r->cell_room * sizeof *r->marks);
        r->now = 0;
    }
    r->now++;
}

enum { TESTS_PER_CELL = 64, LEAST_TESTS = 4096 };

typedef struct step {
    sli_portal_step at;
    bool grazing; ///< the sequence is no more than grazed
    /// As of sli_directions: the portals whose directions bound those of all; NULL for none yet.
    const sl_directed_portal *least, *most;
    const sl_directed_portal *first; ///< that was crossed; NULL for none yet
} step;

static sl_status see(sl_context *context, sli_world_rows *r, uint32_t cell) {
    if (r->marks[cell] == r->now) return SL_OK;
    SL_TRY(sli_numbers_push(context, &r->seen, cell));
    r->marks[cell] = r->now;
    if (r->wanted_count && r->places[cell] && r->wanted.items[r->places[cell] - 1])
        r->search.stop = !--r->wanted_count;
    return SL_OK;
}

/// Whether some direction still crosses all portals.
static bool add_direction(step *s, const sl_directed_portal *directed) {
    if (!s->least) {
        s->least = s->most = directed;
        return true;
    }
    const sli_direction_change crossing =
        sli_direction_change_of(s->least, s->most, s->least == s->most, directed);
    if (crossing == SLI_CROSSES_MOST) s->most = directed;
    if (crossing == SLI_CROSSES_LEAST) s->least = directed;
    return crossing != SLI_CROSSES_NEVER;
}

/// Whether glass keeps sight from leaving a cell by a directed portal.
static bool is_blocked(const sli_world_rows *r, uint32_t cell, uint32_t number) {
    const sl_space *s = r->search.space;
    const uint32_t portal = s->directed[number].portal;
    const bool forward = (s->portals[portal].cell[0] == cell) != r->backwards;
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(s, portal, &count);
    for (size_t i = 0; i < count; i++)
        if (s->seams[on[i].seam].kind == SL_SEAM_ONEWAY && on[i].forward != forward) return true;
    return false;
}

SLI_VISIT sl_status cross(sl_context *context, void *job, const void *last, void *next,
                          uint32_t number) {
    sli_world_rows *r = job;
    const step *from = last;
    const sl_directed_portal *directed = &r->search.space->directed[number];
    step to = {.at.cell = directed->cell,
               .least = from->least,
               .most = from->most,
               .first = from->first ? from->first : directed};
    sl_stab_verdict verdict;
    if (r->within_places && !r->places[directed->cell]) return SL_OK;
    if (!add_direction(&to, directed)) return SL_OK;
    if (r->search.space->seam_portal_count && is_blocked(r, from->at.cell, number)) return SL_OK;
    r->search.stop = ++r->tests > r->most_tests;
    SL_TRY(sli_portal_search_push(context, &r->search, directed->left, directed->right, &verdict));
    to.grazing = verdict == SL_GRAZING || from->grazing;
    if (verdict == SL_HIDDEN || (to.grazing && r->visibility.sight == SL_OPEN)) {
        sli_portal_search_pop(&r->search);
        return SL_OK;
    }
    SL_TRY(see(context, r, directed->cell));
    if (!sli_aim_may_hit(r, to.first, directed)) {
        sli_portal_search_pop(&r->search);
        return SL_OK;
    }
    *(step *)next = to;
    r->search.count++;
    return r->seen.count % 64 ? SL_OK : sl_check_cancelled(context);
}

/// A search that failed leaves its solver as it is, so the next one needs another.
static sl_status start_search(sl_context *context, const sli_live *live, sli_world_rows *r) {
    if (r->search.solver) return SL_OK;
    sli_portal_search search = {.space = &live->space, .solver = sl_funnel()};
    SL_TRY(search.solver->create(context, live->space.bounds, &search.solver_state));
    r->search = search;
    return SL_OK;
}

/// Searches with the portals that the solver holds. `through`: a portal among them that bounds the
/// directions, or NULL.
static sl_status run_search(sl_context *context, sli_world_rows *r, uint32_t cell,
                            const sl_directed_portal *through) {
    static const sli_portal_visitor visitor = {.step_size = sizeof(step), .cross = cross};
    SL_TRY(see(context, r, cell));
    SL_TRY(sli_portal_search_start(context, &r->search, sizeof(step)));
    *(step *)r->search.steps = (step){.at.cell = cell, .least = through, .most = through};
    r->search.count = 1;
    return sli_portal_search_run(context, &r->search, &visitor, r);
}

static sl_status search(sl_context *context, const sli_live *live, sli_world_rows *r, uint32_t cell,
                        const sl_directed_portal *held, size_t count, bool through) {
    sl_stab_verdict verdict;
    sli_world_rows_next_mark(r);
    r->seen.count = 0;
    SL_TRY(start_search(context, live, r));
    SL_TRY(sli_aim(context, r));
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++)
        status = sli_portal_search_push(context, &r->search, held[i].left, held[i].right, &verdict);
    if (status == SL_OK) status = run_search(context, r, cell, through ? held : NULL);
    if (status != SL_OK) sli_portal_search_end(context, &r->search);
    return status;
}

sl_status sli_world_rows_search(sl_context *context, const sli_live *live, sli_world_rows *r,
                                uint32_t cell, const sl_directed_portal *through) {
    return search(context, live, r, cell, through, through ? 1 : 0, true);
}

sl_status sli_world_rows_search_along(sl_context *context, const sli_live *live, sli_world_rows *r,
                                      uint32_t cell, sl_segment line) {
    const sl_directed_portal both[] = {{.left = line.a, .right = line.b},
                                       {.left = line.b, .right = line.a}};
    return search(context, live, r, cell, both, 2, false);
}

// --- edits

/// Makes room for as many cells as the space has numbers.
static sl_status grow_cells(sl_context *context, const sli_live *live, sli_world_rows *r) {
    const size_t old = r->cell_room, room = live->cell_room;
    sl_pvs *pvs = &r->visibility.pvs;
    if (room <= old) return SL_OK;
    size_t capacity = old ? old + 1 : 0;
    SL_TRY(sl_reserve(context, &pvs->offsets, &capacity, room + 1, sizeof *pvs->offsets));
    capacity = old;
    SL_TRY(sl_reserve(context, &pvs->ends, &capacity, room, sizeof *pvs->ends));
    capacity = old;
    SL_TRY(sl_reserve(context, &r->words, &capacity, room, sizeof *r->words));
    capacity = old;
    SL_TRY(sl_reserve(context, &r->marks, &capacity, room, sizeof *r->marks));
    capacity = old;
    SL_TRY(sl_reserve(context, &r->loose, &capacity, room, sizeof *r->loose));
    capacity = old;
    SL_TRY(sl_reserve(context, &r->places, &capacity, room, sizeof *r->places));
    for (size_t c = old; c < room; c++) {
        pvs->offsets[c] = pvs->ends[c] = 0;
        r->words[c] = r->marks[c] = r->places[c] = 0;
        r->loose[c] = 0;
    }
    pvs->offsets[room] = 0;
    r->cell_room = room;
    return SL_OK;
}

static bool goes(const sli_live *l, uint32_t cell) {
    return l->dissolved[cell] == l->now;
}

/// Adds the cells that see one that goes. A cell may come several times then.
static sl_status find_seers(sl_context *context, const sli_live *live, sli_world_rows *r) {
    r->backwards = true;
    r->most_tests = UINT64_MAX;
    sl_status status = SL_OK;
    for (size_t i = 0; i < live->old.count && status == SL_OK; i++) {
        if (!goes(live, live->old.items[i])) continue;
        status = sli_world_rows_search(context, live, r, live->old.items[i], NULL);
        for (size_t k = 0; k < r->seen.count && status == SL_OK; k++)
            if (!goes(live, r->seen.items[k]))
                status = sli_numbers_push(context, &r->changed, r->seen.items[k]);
    }
    r->backwards = false;
    return status;
}

static void leave_each_once(sli_numbers *list) {
    size_t count = 0;
    if (list->count) qsort(list->items, list->count, sizeof *list->items, sli_compare_whole);
    for (size_t i = 0; i < list->count; i++)
        if (!count || list->items[count - 1] != list->items[i])
            list->items[count++] = list->items[i];
    list->count = count;
}

sl_status sli_world_rows_plan(sl_context *context, const sli_live *live, sli_world_rows *r) {
    const sl_pvs *pvs = &r->visibility.pvs;
    r->changed.count = 0;
    if (!r->kept) return SL_OK;
    SL_TRY(grow_cells(context, live, r));
    sli_world_rows_next_mark(r);
    for (size_t i = 0; i < live->old.count && pvs->cell_count; i++) {
        if (!goes(live, live->old.items[i])) continue;
        for (sl_pvs_run run = sl_pvs_begin(pvs, live->old.items[i]); sl_pvs_next(&run);)
            for (uint32_t cell = run.first; cell < run.end; cell++) {
                if (r->marks[cell] == r->now || goes(live, cell) ||
                    !live->space.cells[cell].vertex_count)
                    continue;
                r->marks[cell] = r->now;
                SL_TRY(sli_numbers_push(context, &r->changed, cell));
            }
    }
    if (live->space.seam_portal_count) {
        SL_TRY(find_seers(context, live, r));
        leave_each_once(&r->changed);
    }
    SL_TRY(SL_ARRAY_ROOM(context, &r->changed, live->cells.count));
    // All cells that are loose are in the list, each once.
    return SL_ARRAY_ROOM(context, &r->unsettled, live->cell_room);
}

static void loosen(sli_world_rows *r, uint32_t cell) {
    if (!r->loose[cell]) r->unsettled.items[r->unsettled.count++] = cell;
    r->loose[cell] = 1;
    r->visibility.guarantee = SL_CONSERVATIVE;
}

void sli_world_rows_apply(const sli_live *live, sli_world_rows *r) {
    if (!r->kept) return;
    for (size_t i = 0; i < live->gone.count; i++) drop_row(r, live->gone.items[i]);
    for (size_t i = 0; i < live->came.count; i++)
        r->changed.items[r->changed.count++] = live->came.items[i];
    if (r->visibility.pvs.cell_count) r->visibility.pvs.cell_count = live->space.cell_count;
}

void sli_world_rows_doubt(sli_world_rows *r) {
    for (size_t i = 0; i < r->changed.count; i++) loosen(r, r->changed.items[i]);
}

sl_status sli_world_rows_loosen(sl_context *context, const sli_live *live, sli_world_rows *r,
                                bool opened) {
    const size_t stayed = r->changed.count - live->came.count;
    if (!r->visibility.pvs.cell_count) return SL_OK;
    opened |= r->visibility.sight == SL_CLOSED; // new portals may join cells, too (along.c)
    for (size_t i = 0; i < r->changed.count; i++) {
        const uint32_t cell = r->changed.items[i];
        r->seen.count = 0;
        for (sl_pvs_run run = sl_pvs_begin(&r->visibility.pvs, cell); sl_pvs_next(&run);)
            for (uint32_t c = run.first; c < run.end; c++)
                if (live->space.cells[c].vertex_count)
                    SL_TRY(sli_numbers_push(context, &r->seen, c));
        for (size_t k = opened || i >= stayed ? 0 : stayed; k < r->changed.count; k++)
            SL_TRY(sli_numbers_push(context, &r->seen, r->changed.items[k]));
        SL_TRY(sli_world_rows_write(context, r, cell));
    }
    return SL_OK;
}

/// Takes the rows that are not settled from a copy that is seen as a whole.
static sl_status take_rows(sl_context *context, sli_world_rows *r, const uint32_t *numbers,
                           const uint32_t *cells, const sl_pvs *from) {
    while (r->unsettled.count) {
        const uint32_t cell = r->unsettled.items[r->unsettled.count - 1];
        if (numbers[cell] != SL_NO_CELL) {
            r->seen.count = 0;
            for (sl_pvs_run run = sl_pvs_begin(from, numbers[cell]); sl_pvs_next(&run);)
                for (uint32_t c = run.first; c < run.end; c++)
                    SL_TRY(sli_numbers_push(context, &r->seen, cells[c]));
            SL_TRY(sli_world_rows_write(context, r, cell));
        }
        r->loose[cell] = 0;
        r->unsettled.count--;
    }
    return SL_OK;
}

static sl_status settle_by_copy(sl_context *context, const sli_live *live, sli_world_rows *r) {
    const uint32_t count = live->space.cell_count;
    sl_see_options options = sl_see_options_default();
    const sl_plan plan = {.effects = SL_EFFECT_ONEWAY};
    sl_space space = {0};
    sl_visibility seen = {0};
    uint32_t *numbers = sl_alloc_array(context, count, sizeof *numbers);
    uint32_t *cells = sl_alloc_array(context, count, sizeof *cells);
    sl_status status = numbers && cells ? SL_OK : SL_NO_MEMORY;
    options.sight = r->visibility.sight;
    options.threads = 1;
    if (live->space.seam_portal_count) options.plan = &plan;
    if (status == SL_OK) status = sli_live_pack(context, live, numbers, &space);
    if (status == SL_OK)
        status = sl_see_method_named("sweep")->see(context, &space, &options, &seen);
    for (uint32_t cell = 0; cell < count && status == SL_OK; cell++)
        if (numbers[cell] != SL_NO_CELL) cells[numbers[cell]] = cell;
    if (status == SL_OK) status = take_rows(context, r, numbers, cells, &seen.pvs);
    sl_visibility_destroy(context, &seen);
    sl_space_destroy(context, &space);
    sl_free(context, numbers);
    sl_free(context, cells);
    return status;
}

/// Makes loose rows exact by searches, until the time or the tests are used up.
static sl_status settle_by_search(sl_context *context, const sli_live *live, sli_world_rows *r,
                                  double end) {
    r->tests = 0;
    r->most_tests = LEAST_TESTS + TESTS_PER_CELL * (uint64_t)live->live_count;
    while (r->unsettled.count && r->tests <= r->most_tests) {
        const uint32_t cell = r->unsettled.items[r->unsettled.count - 1];
        if (live->space.cells[cell].vertex_count) {
            SL_TRY(sli_world_rows_search(context, live, r, cell, NULL));
            if (r->tests > r->most_tests) return SL_OK;
            SL_TRY(sli_world_rows_write(context, r, cell));
        }
        r->loose[cell] = 0;
        r->unsettled.count--;
        if (!(sl_seconds() < end)) return SL_OK;
    }
    return SL_OK;
}

sl_status sli_world_rows_settle(sl_context *context, const sli_live *live, sli_world_rows *r,
                                double seconds) {
    if (!r->kept) return SL_OK;
    SL_TRY(settle_by_search(context, live, r, sl_seconds() + seconds));
    if (r->tests > r->most_tests) SL_TRY(settle_by_copy(context, live, r));
    if (r->unsettled.count) return SL_OK;
    r->visibility.guarantee = r->limits ? SL_CONSERVATIVE : SL_EXACT;
    r->visibility.pvs.cell_count = live->space.cell_count;
    return SL_OK;
}

void sli_world_rows_lose(const sli_live *live, sli_world_rows *r) {
    r->visibility.pvs.cell_count = 0;
    for (uint32_t cell = 0; cell < live->space.cell_count; cell++)
        if (live->space.cells[cell].vertex_count) loosen(r, cell);
}

sl_status sli_world_rows_start(sl_context *context, const sli_live *live, sl_sight sight,
                               sli_world_rows *r) {
    r->visibility.sight = sight;
    r->kept = true;
    SL_TRY(grow_cells(context, live, r));
    SL_TRY(SL_ARRAY_ROOM(context, &r->unsettled, live->cell_room));
    // The first searched are the first in memory.
    for (uint32_t cell = live->space.cell_count; cell-- > 0;)
        if (live->space.cells[cell].vertex_count) loosen(r, cell);
    return sli_world_rows_settle(context, live, r, HUGE_VAL);
}

void sli_world_rows_destroy(sl_context *context, sli_world_rows *r) {
    if (r->search.solver) sli_portal_search_end(context, &r->search);
    sl_free(context, r->visibility.pvs.offsets);
    sl_free(context, r->visibility.pvs.ends);
    sl_free(context, r->visibility.pvs.bytes);
    sl_free(context, r->words);
    sl_free(context, r->marks);
    sl_free(context, r->places);
    sl_free(context, r->loose);
    sl_free(context, r->changed.items);
    sl_free(context, r->unsettled.items);
    sl_free(context, r->seen.items);
    sl_free(context, r->wanted.items);
    sl_free(context, r->targets.items);
    sl_free(context, r->sides.items);
    sl_free(context, r->first.items);
    sl_free(context, r->more.items);
    sl_free(context, r->pairs.items);
    sl_free(context, r->portals.items);
    sl_free(context, r->joined.items);
    sl_free(context, r->touched.items);
    sl_free(context, r->row.items);
    *r = (sli_world_rows){0};
}
