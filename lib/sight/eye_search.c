/// What the culling methods share: the scratch memory, the begin and end of a query, and the step
/// of the exact method through one portal, with the range of sight.
#include "sight/eye_search.h"

#include "cell_to_cell/pvs_rows.h"
#include "geometry/crossing.h"

#include <math.h>
#include <string.h>

size_t sl_eye_words(const sl_space *space) {
    return sl_bits_words(space->cell_count);
}

static sl_status check_fits(sl_context *context, uint32_t cells, const sl_visibility *visibility) {
    const uint32_t rows = visibility->pvs.cell_count, trees = visibility->trees.cell_count;
    if ((!rows || rows == cells) && (!trees || trees == cells)) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "the visible sets are those of another space");
}

/// Marks the portals on limited walls, if there are any.
static sl_status mark_limited(sl_context *context, const sl_space *space, sl_bits **out) {
    for (uint32_t i = 0; i < space->seam_portal_count; i++) {
        if (space->seams[space->seam_portals[i].seam].kind != SL_SEAM_LIMITED) continue;
        if (!*out) *out = sl_alloc_array(context, sl_bits_words(space->portal_count), sizeof **out);
        if (!*out) return SL_NO_MEMORY;
        sl_bits_add(*out, space->seam_portals[i].portal);
    }
    return SL_OK;
}

static sl_status create(sl_context *context, const sl_space *space, const sli_boxed_space *boxed,
                        const sl_visibility *visibility, uint32_t row_cells, sli_eye_search **out) {
    SL_TRY(check_fits(context, row_cells, visibility));
    sli_eye_search *search = sl_alloc_array(context, 1, sizeof *search);
    if (!search) return SL_NO_MEMORY;
    const size_t count = space->cell_count;
    search->space = space;
    search->visibility = visibility;
    search->boxed = boxed;
    search->has_pvs = visibility->pvs.cell_count > 0;
    search->row = sl_alloc_array(context, sl_bits_words(row_cells), sizeof *search->row);
    search->queue = sl_alloc_array(context, count, sizeof *search->queue);
    search->steps = sl_alloc_array(context, count + 3, sizeof *search->steps);
    const sl_status marked = mark_limited(context, space, &search->limited);
    const size_t rays = SLI_RAY_SIDES * (search->limited ? 2 * count : count);
    search->rays = sl_alloc_array(context, rays, sizeof *search->rays);
    if (marked != SL_OK || !search->row || !search->queue || !search->steps || !search->rays) {
        sli_eye_search_destroy(context, search);
        return SL_NO_MEMORY;
    }
    *out = search;
    return SL_OK;
}

sl_status sli_eye_search_create(sl_context *context, const sl_space *space,
                                const sl_visibility *visibility, sli_eye_search **out) {
    return create(context, space, NULL, visibility, space->cell_count, out);
}

sl_status sli_eye_search_create_cut(sl_context *context, const sli_boxed_space *boxed,
                                    const sl_visibility *visibility, uint32_t row_cells,
                                    sli_eye_search **out) {
    return create(context, &boxed->space, boxed, visibility, row_cells, out);
}

void sli_eye_mirrors_destroy(sl_context *context, sli_eye_mirrors *m) {
    if (!m) return;
    sli_mirror_sides_destroy(context, &m->sides);
    sl_free(context, m->images);
    sli_portal_search_end(context, &m->way);
    sl_free(context, m);
}

void sli_eye_search_destroy(sl_context *context, sli_eye_search *search) {
    if (!search) return;
    sl_free(context, search->row);
    sl_free(context, search->queue);
    sl_free(context, search->steps);
    sl_free(context, search->rays);
    sl_free(context, search->limited);
    sli_eye_mirrors_destroy(context, search->mirrors);
    sl_free(context, search);
}

/// Adds a cell's visible set to the row; false where it has none, not even itself.
static bool add_row(sli_eye_search *search, uint32_t cell) {
    const sl_visibility *v = search->visibility;
    sli_row_add_open_to(&v->pvs, &v->doors, cell, search->shut, search->row);
    return sl_bits_has(search->row, cell);
}

/// Adds the visible sets of all cells of the ground that a cell has a part of; false where it has
/// none.
static bool add_rows(sli_eye_search *search, uint32_t cell) {
    const sli_boxed_space *boxed = search->boxed;
    bool found = add_row(search, boxed ? boxed->parents[cell] : cell);
    if (boxed && boxed->first_share)
        for (uint32_t i = boxed->first_share[cell]; i < boxed->first_share[cell + 1]; i++)
            found |= add_row(search, boxed->shares[i]);
    return found;
}

static bool is_on(sl_point a, sl_point b, sl_point eye) {
    return fmin(a.x, b.x) <= eye.x && eye.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= eye.y &&
           eye.y <= fmax(a.y, b.y) && sli_orient(a, b, eye) == 0;
}

/// Adds the visible sets of the cells at glass that the eye is in line with. A line along it may
/// cross it as the visible sets do not know it; after the last such portal they know all of it.
static void add_rows_in_line(sli_eye_search *search, sl_point eye) {
    const sl_space *space = search->space;
    for (uint32_t i = 0; i < space->seam_portal_count; i++) {
        const sl_seam *seam = &space->seams[space->seam_portals[i].seam];
        if (seam->kind != SL_SEAM_ONEWAY || sli_orient(seam->at.a, seam->at.b, eye) != 0) continue;
        const sl_portal *portal = &space->portals[space->seam_portals[i].portal];
        for (unsigned side = 0; side < 2; side++) add_rows(search, portal->cell[side]);
    }
}

uint32_t sli_eye_cells(const sl_space *space, sl_point eye, uint32_t *cells, uint64_t *marks) {
    uint32_t count = 0;
    cells[0] = sli_eye_cell(space, eye);
    if (cells[0] == SL_NO_CELL) return 0;
    sl_bits_add(marks, cells[count++]);
    for (uint32_t at = 0; at < count; at++) {
        const sl_cell *cell = &space->cells[cells[at]];
        for (uint32_t i = cell->first_directed; i < cell->first_directed + cell->directed_count;
             i++) {
            const sl_directed_portal *portal = &space->directed[i];
            if (sl_bits_has(marks, portal->cell) || !is_on(portal->left, portal->right, eye))
                continue;
            sl_bits_add(marks, portal->cell);
            cells[count++] = portal->cell;
        }
    }
    for (uint32_t at = 0; at < count; at++) marks[cells[at] / 64] = 0;
    return count;
}

bool sli_eye_is_in(const sli_eye_query *query, uint32_t cell) {
    for (uint32_t at = 0; at < query->fan_count; at++)
        if (query->search->queue[at] == cell) return true;
    return false;
}

bool sli_eye_leads_into(sli_eye_query *query, uint32_t number) {
    const sl_cell *cell = &query->space->cells[number];
    const sl_point *vertices = query->space->vertices, eye = query->pivot.eye;
    const uint32_t first = cell->first_vertex, count = cell->vertex_count;
    sli_ray right = {0}, left = {0};
    bool at_border = false;
    if (query->cone.full) return true;
    for (uint32_t i = 0; i < count; i++) {
        const sl_point a = vertices[first + i];
        const sl_point b = vertices[first + (i + 1 == count ? 0 : i + 1)];
        if (!is_on(a, b, eye)) continue;
        at_border = true;
        if (!sli_same_point(a, eye)) left = sli_ray_to(a);
        if (!sli_same_point(b, eye)) right = sli_ray_to(b);
    }
    sli_arc inward, pieces[2];
    return !at_border || !sli_arc_make(&query->pivot, right, left, &inward) ||
           sli_cone_clip(&query->pivot, &query->cone, &inward, pieces) > 0;
}

sl_status sli_eye_begin(sl_context *context, sli_eye_search *search, const sl_view *view,
                        bool needs_pvs, uint64_t *cells, sli_eye_query *out) {
    if (!sli_view_usable(view))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the view is none: its points must be finite, the cone's not the eye");
    if (needs_pvs && !search->has_pvs)
        return sl_fail(context, SL_BAD_ARGUMENT, "there are no visible sets to cull");
    const size_t words = sl_eye_words(search->space);
    memset(cells, 0, words * sizeof *cells);
    *out = (sli_eye_query){
        .search = search, .space = search->space, .pivot = {.eye = view->eye}, .cells = cells};
    const uint32_t count = sli_eye_cells(search->space, view->eye, search->queue, cells);
    if (!count) return SL_OK;
    if (search->has_pvs) {
        const size_t row_words = sl_bits_words(search->visibility->pvs.cell_count);
        memset(search->row, 0, row_words * sizeof *search->row);
        if (!add_rows(search, search->queue[0])) return SL_OK;
        for (uint32_t at = 1; at < count; at++) add_rows(search, search->queue[at]);
        if (search->in_line) add_rows_in_line(search, view->eye);
    }
    out->fan_count = count;
    out->cone = sli_cone_of(&out->pivot, view);
    return SL_OK;
}

void sli_eye_end(const sli_eye_query *query, sl_eye_account *account) {
    if (account)
        *account = (sl_eye_account){.nodes = query->nodes, .orientations = query->pivot.tests};
}

sli_eye_step sli_eye_first_step(const sli_eye_query *query, uint32_t fan) {
    return (sli_eye_step){.at.cell = query->search->queue[fan], .near = true};
}

/// Clips a step's arcs to a directed portal of its cell; `first` for a cell of the eye's own.
/// False where nothing is left that counts.
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

void sli_eye_search_set_range(sli_eye_search *search, double range) {
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
