/// What the culling methods share: the scratch memory, the begin and end of a query, and the step
/// of the exact method through one portal, with the range of sight.
#include "eye_to_cell/eye_search.h"

#include "cell_to_cell/pvs_rows.h"
#include "geometry/crossing.h"

#include <string.h>

size_t sl_eye_words(const sl_space *space) {
    return sl_bits_words(space->cell_count);
}

static sl_status check_fits(sl_context *context, uint32_t cells, const sl_visibility *visibility) {
    const uint32_t rows = visibility->pvs.cell_count, trees = visibility->trees.cell_count;
    if ((!rows || rows == cells) && (!trees || trees == cells)) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "the visible sets are those of another space");
}

static sl_status create(sl_context *context, const sl_space *space, const sli_boxed_space *boxed,
                        const sl_visibility *visibility, uint32_t row_cells, sl_eye_search **out) {
    SL_TRY(check_fits(context, row_cells, visibility));
    sl_eye_search *search = sl_alloc_array(context, 1, sizeof *search);
    if (!search) return SL_NO_MEMORY;
    const size_t count = space->cell_count;
    search->space = space;
    search->visibility = visibility;
    search->boxed = boxed;
    search->has_pvs = visibility->pvs.cell_count > 0;
    search->row = sl_alloc_array(context, sl_bits_words(row_cells), sizeof *search->row);
    search->queue = sl_alloc_array(context, count, sizeof *search->queue);
    search->steps = sl_alloc_array(context, count + 3, sizeof *search->steps);
    search->rays = sl_alloc_array(context, SLI_RAY_SIDES * count, sizeof *search->rays);
    if (!search->row || !search->queue || !search->steps || !search->rays) {
        sl_eye_search_destroy(context, search);
        return SL_NO_MEMORY;
    }
    *out = search;
    return SL_OK;
}

sl_status sl_eye_search_create(sl_context *context, const sl_space *space,
                               const sl_visibility *visibility, sl_eye_search **out) {
    return create(context, space, NULL, visibility, space->cell_count, out);
}

sl_status sli_eye_search_create_cut(sl_context *context, const sli_boxed_space *boxed,
                                    const sl_visibility *visibility, uint32_t row_cells,
                                    sl_eye_search **out) {
    return create(context, &boxed->space, boxed, visibility, row_cells, out);
}

void sl_eye_search_destroy(sl_context *context, sl_eye_search *search) {
    if (!search) return;
    sl_free(context, search->row);
    sl_free(context, search->queue);
    sl_free(context, search->steps);
    sl_free(context, search->rays);
    sli_eye_mirrors_destroy(context, search->mirrors);
    sl_free(context, search);
}

/// Adds a cell's visible set to the row; false where it has none, not even itself.
static bool add_row(sl_eye_search *search, uint32_t cell) {
    sli_row_add_to(&search->visibility->pvs, cell, search->row);
    return sl_bits_has(search->row, cell);
}

/// Finds the visible set of the eye's cell: the union over all cells of the ground that it has a
/// part of. Where there is none, the eye sees nothing.
static void find_row(sl_eye_search *search, uint32_t *cell) {
    const sli_boxed_space *boxed = search->boxed;
    const uint32_t row_cells = search->visibility->pvs.cell_count;
    memset(search->row, 0, sl_bits_words(row_cells) * sizeof *search->row);
    bool found = add_row(search, boxed ? boxed->parents[*cell] : *cell);
    if (boxed && boxed->first_share)
        for (uint32_t i = boxed->first_share[*cell]; i < boxed->first_share[*cell + 1]; i++)
            found |= add_row(search, boxed->shares[i]);
    if (!found) *cell = SL_NO_CELL;
}

sl_status sli_eye_begin(sl_context *context, sl_eye_search *search, const sl_view *view,
                        bool needs_pvs, uint64_t *cells, sli_eye_query *out) {
    if (!sl_view_usable(view))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the view is none: its points must be finite, the cone's not the eye");
    if (needs_pvs && !search->has_pvs)
        return sl_fail(context, SL_BAD_ARGUMENT, "there are no visible sets to cull");
    const size_t words = sl_eye_words(search->space);
    memset(cells, 0, words * sizeof *cells);
    *out = (sli_eye_query){.search = search,
                           .space = search->space,
                           .pivot = {.eye = view->eye},
                           .cell = sli_eye_cell(search->space, view->eye),
                           .cells = cells};
    if (out->cell == SL_NO_CELL) return SL_OK;
    if (search->has_pvs) find_row(search, &out->cell);
    out->cone = sli_cone_of(&out->pivot, view);
    return SL_OK;
}

void sli_eye_end(const sli_eye_query *query, sl_eye_account *account) {
    *account = (sl_eye_account){.nodes = query->nodes, .orientations = query->pivot.tests};
}

sli_eye_step sli_eye_first_step(const sli_eye_query *query) {
    return (sli_eye_step){.at.cell = query->cell, .near = true};
}

/// Clips a step's arcs to a directed portal of its cell; `first` for the eye's own cell. False
/// where nothing is left that counts.
static bool pass(sli_eye_query *query, const sli_eye_step *from, bool first,
                 const sl_directed_portal *portal, sli_eye_step *to) {
    sli_pivot *pivot = &query->pivot;
    *to = (sli_eye_step){.at.cell = portal->cell};
    if (from->near) {
        sli_arc through;
        if (!sli_arc_of_portal(pivot, portal, &through)) return false;
        to->near = through.span == SLI_SPAN_HALF;
        if (first) to->arc_count = sli_cone_clip(pivot, &query->cone, &through, to->arcs);
        // Each arc meets the portal's half in one arc at most: along a half opposite to it there
        // are portals that are crossed the other way.
        for (unsigned i = 0; i < from->arc_count; i++) {
            sli_arc pieces[2];
            if (sli_arc_meet(pivot, &from->arcs[i], &through, pieces))
                to->arcs[to->arc_count++] = pieces[0];
        }
    } else {
        for (unsigned i = 0; i < from->arc_count; i++)
            to->arc_count +=
                sli_arc_narrow(pivot, &from->arcs[i], portal, &to->arcs[to->arc_count]);
    }
    if (query->search->visibility->sight == SL_CLOSED) return to->arc_count > 0;
    unsigned kept = 0;
    for (unsigned i = 0; i < to->arc_count; i++)
        if (to->arcs[i].span != SLI_SPAN_RAY) to->arcs[kept++] = to->arcs[i];
    to->arc_count = kept;
    return kept > 0;
}

// --- the range of sight

/// Whether the part of a portal within an arc is in range of the eye, which is not on it. With open
/// sight more than one point of it must be. Exact: the nearest point of the part is compared; all
/// of a cell that is seen through a portal lies beyond that.
static bool reaches(const sli_pivot *pivot, const sli_arc *arc, const sl_directed_portal *portal,
                    double range, sl_sight sight) {
    const sli_glance glance = {.eye = {pivot->eye, pivot->rest},
                               .from = {arc->right.point, arc->right.rest},
                               .to = {arc->left.point, arc->left.rest},
                               .from_away = arc->right.away,
                               .to_away = arc->left.away,
                               .right = portal->right,
                               .left = portal->left};
    const int sign = sli_nearest_compare(&glance, range);
    return sight == SL_OPEN ? sign < 0 : sign <= 0;
}

void sl_eye_search_set_range(sl_eye_search *search, double range) {
    search->range = range;
}

bool sli_eye_pass_in_range(sli_eye_query *query, const sli_eye_step *from, bool first,
                           const sl_directed_portal *portal, sli_eye_step *to) {
    const double range = query->search->range;
    if (!pass(query, from, first, portal, to)) return false;
    if (!(range > 0) || to->near) return true;
    unsigned kept = 0;
    for (unsigned i = 0; i < to->arc_count; i++)
        if (reaches(&query->pivot, &to->arcs[i], portal, range, query->search->visibility->sight))
            to->arcs[kept++] = to->arcs[i];
    to->arc_count = kept;
    return kept > 0;
}
