/// The culling methods: which cells does one viewpoint see? (Teller & Séquin 1991, Eye to Cell
/// Visibility)
///
/// Each method refines the one before it, so its cells are among those of that one:
///
///   cell_to_cell         the visible sets of the eye's cells
///   disjoint_cell        of those, the cells that meet the view cone
///   connected_component  of those, the cells connected to the eye's cells through such cells
///   incident_portals     of those, the cells reached through portals that meet the view cone
///   exact                of those, the cells with a sightline from the eye within the view cone
///
/// Why: a cell reached over cells that meet the cone meets the cone itself. A portal that meets the
/// cone is part of the border of both its cells, so both meet it.
///
/// Cost: disjoint_cell tests each cell of the visible set, connected_component and incident_portals
/// each directed portal of the cells they keep. exact.c has the exact method.
#include "base/bits.h"
#include "cell_to_cell/pvs_rows.h"
#include "sight/eye_search.h"

#include <string.h>

// --- no culling

static sl_status cell_to_cell(sl_context *context, sli_eye_search *search, const sl_view *view,
                              uint64_t *cells, sl_eye_account *account) {
    sli_eye_query query;
    SL_TRY(sli_eye_begin(context, search, view, true, cells, &query));
    const size_t words = sl_eye_words(search->space);
    if (query.fan_count) {
        memcpy(cells, search->row, words * sizeof *cells);
        query.nodes += sli_bits_count(cells, words);
    }
    sli_eye_end(&query, account);
    return SL_OK;
}

static sl_status cell_to_cell_mirrored(sl_context *context, sli_eye_search *search,
                                       const sl_view *view, uint64_t *cells,
                                       sl_eye_account *account) {
    sli_eye_query query;
    SL_TRY(sli_eye_begin(context, search, view, true, cells, &query));
    const sl_visibility *v = search->visibility;
    if (query.fan_count && v->mirrored.cell_count) {
        for (uint32_t at = 0; at < query.fan_count; at++)
            sli_row_add_open_to(&v->mirrored, &v->mirrored_doors, search->queue[at], search->shut,
                                cells);
        query.nodes += sli_bits_count(cells, sl_eye_words(search->space));
    }
    sli_eye_end(&query, account);
    return SL_OK;
}

// --- disjoint cell

static sl_status disjoint_cell(sl_context *context, sli_eye_search *search, const sl_view *view,
                               uint64_t *cells, sl_eye_account *account) {
    sli_eye_query query;
    SL_TRY(sli_eye_begin(context, search, view, true, cells, &query));
    const size_t words = query.fan_count ? sl_eye_words(search->space) : 0;
    for (size_t word = 0; word < words; word++) {
        for (sl_bits rest = search->row[word]; rest; rest &= rest - 1) {
            const uint32_t cell = (uint32_t)(64 * word) + (uint32_t)__builtin_ctzll(rest);
            if (++query.nodes % 4096 == 0) SL_TRY(sl_check_cancelled(context));
            if (sli_eye_meets_cell(&query, cell)) sl_bits_add(cells, cell);
        }
    }
    sli_eye_end(&query, account);
    return SL_OK;
}

// --- spreading from the eye's cells

/// Whether to go through a directed portal.
typedef bool portal_test(sli_eye_query *query, const sl_directed_portal *portal);

/// Tests the portals of a kept cell and queues the cells behind those that pass.
static size_t spread_from(sli_eye_query *query, portal_test *test, uint32_t from, uint32_t *queue,
                          size_t queued) {
    const sl_cell *cell = &query->space->cells[from];
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const sl_directed_portal *portal = &query->space->directed[cell->first_directed + i];
        if (sl_bits_has(query->cells, portal->cell) || !sli_eye_may_see(query, portal->cell))
            continue;
        query->nodes++;
        if (!test(query, portal)) continue;
        sl_bits_add(query->cells, portal->cell);
        queue[queued++] = portal->cell;
    }
    return queued;
}

/// Adds to the result each cell that can be reached, the eye's own first.
static sl_status spread(sl_context *context, sli_eye_query *query, portal_test *test) {
    uint32_t *queue = query->search->queue;
    size_t queued = query->fan_count;
    for (size_t at = 0; at < queued; at++) sl_bits_add(query->cells, queue[at]);
    query->nodes = queued;
    for (size_t at = 0; at < queued; at++) {
        if (at % 4096 == 4095) SL_TRY(sl_check_cancelled(context));
        queued = spread_from(query, test, queue[at], queue, queued);
    }
    return SL_OK;
}

static bool meets_cell(sli_eye_query *query, const sl_directed_portal *portal) {
    return sli_eye_meets_cell(query, portal->cell);
}

static sl_status connected_component(sl_context *context, sli_eye_search *search,
                                     const sl_view *view, uint64_t *cells,
                                     sl_eye_account *account) {
    sli_eye_query query;
    SL_TRY(sli_eye_begin(context, search, view, true, cells, &query));
    SL_TRY(spread(context, &query, meets_cell));
    sli_eye_end(&query, account);
    return SL_OK;
}

static sl_status incident_portals(sl_context *context, sli_eye_search *search, const sl_view *view,
                                  uint64_t *cells, sl_eye_account *account) {
    sli_eye_query query;
    SL_TRY(sli_eye_begin(context, search, view, true, cells, &query));
    SL_TRY(spread(context, &query, sli_eye_meets_portal));
    sli_eye_end(&query, account);
    return SL_OK;
}

// --- the table

const sl_eye_method *sl_eye_methods(size_t *count) {
    static const sl_eye_method methods[] = {
        {"cell_to_cell", "no culling: all that the eye's cells see", SL_CONSERVATIVE, true,
         cell_to_cell, cell_to_cell_mirrored},
        {"disjoint_cell", "of those, the cells that meet the view cone", SL_CONSERVATIVE, true,
         disjoint_cell, NULL},
        {"connected_component", "of those, the cells connected to the eye's through such cells",
         SL_CONSERVATIVE, true, connected_component, NULL},
        {"incident_portals", "of those, the cells reached through portals that meet the cone",
         SL_CONSERVATIVE, true, incident_portals, NULL},
        {"exact", "of those, the cells with a sightline from the eye within the cone", SL_EXACT,
         false, sli_eye_exact, sli_eye_exact_mirrored},
    };
    *count = sizeof methods / sizeof *methods;
    return methods;
}
