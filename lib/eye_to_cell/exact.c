/// Exact: depth-first over portal sequences, with the arc of directions in which a line through the
/// eye and within the cone crosses all of the sequence. Each such line meets each portal within the
/// cone, so that the cells are among those of the incident portals; and it is a sightline from the
/// eye's cell, so that with exact visible sets these hold nothing back.
///
/// Arcs that lead to the same cell by different sequences overlap at their borders at most (and
/// where portals meet at the eye itself, which is passed on either side). So there are no more
/// steps than pieces of cells that are seen, but for single rays, which may pass a point where
/// portals meet on either side and again at the next: of all sequences that one ray has to a cell,
/// one is followed for each side on which it may still cross portals along it.
#include "eye_to_cell/eye_search.h"

#include <string.h>

/// On which sides a ray has crossed portals along it: that is all that tells apart what is ahead.
static unsigned sides_of(const sl_arc *ray) {
    return ray->left.along ? 2 : ray->right.along;
}

/// A number for a ray that no cell has been marked with.
static uint32_t new_ray(sl_eye_search *search) {
    if (++search->ray_count == 0) {
        memset(search->rays, 0,
               SL_RAY_SIDES * (size_t)search->space->cell_count * sizeof(uint32_t));
        search->ray_count = 1;
    }
    return search->ray_count;
}

bool sl_eye_is_new(sl_eye_search *search, const sl_eye_step *from, sl_eye_step *to) {
    if (to->arcs[0].span != SL_SPAN_RAY) return true;
    to->ray = from->ray ? from->ray : new_ray(search);
    uint32_t *mark = &search->rays[SL_RAY_SIDES * (size_t)to->cell + sides_of(&to->arcs[0])];
    const bool fresh = *mark != to->ray;
    *mark = to->ray;
    return fresh;
}

/// Tries the next directed portal of a step; what is entered, a step for each arc, goes behind it.
/// Returns how many steps that are.
static size_t try_portal(sl_eye_query *query, sl_eye_step *last, bool first) {
    const sl_cell *cell = &query->space->cells[last->cell];
    const sl_directed_portal *directed =
        &query->space->directed[cell->first_directed + last->next++];
    sl_eye_step *to = last + 1, entered;
    size_t count = 0;
    if (!sl_eye_may_see(query, directed->cell) ||
        !sl_eye_pass_in_range(query, last, first, directed, &entered))
        return 0;
    for (unsigned i = 0; i < entered.arc_count; i++) {
        to[count] = entered;
        to[count].arcs[0] = entered.arcs[i];
        to[count].arc_count = 1;
        count += sl_eye_is_new(query->search, last, &to[count]);
    }
    if (count) sl_bits_add(query->cells, directed->cell);
    return count;
}

void sl_eye_meet_targets(sl_eye_query *query, const sl_eye_step *at, bool first) {
    const sl_eye_targets *t = &query->search->targets;
    sl_eye_step neighbour;
    for (uint32_t i = t->first[at->cell]; i < t->first[at->cell + 1]; i++)
        if (!t->met[t->targets[i].portal])
            t->met[t->targets[i].portal] =
                sl_eye_pass_in_range(query, at, first, &t->targets[i], &neighbour);
}

static sl_status search_portals(sl_context *context, sl_eye_query *query) {
    const sl_space *space = query->space;
    sl_eye_step *steps = query->search->steps;
    size_t count = 1;
    steps[0] = sl_eye_first_step(query);
    sl_bits_add(query->cells, query->cell);
    query->nodes = 1;
    while (count) {
        sl_eye_step *last = &steps[count - 1];
        if (query->search->targets.first && last->next == 0)
            sl_eye_meet_targets(query, last, count == 1);
        if (last->next == space->cells[last->cell].directed_count) {
            count--;
            continue;
        }
        // No cell comes twice on the way; a first directed portal may have given two steps.
        if (count > (size_t)space->cell_count + 1)
            return sl_fail(context, SL_BAD_INPUT,
                           "a line enters cell %u twice: cells and portals do not fit together",
                           (unsigned)last->cell);
        const size_t entered = try_portal(query, last, count == 1);
        count += entered;
        query->nodes += entered;
        if (entered && query->nodes % 1024 == 0) SL_TRY(sl_check_cancelled(context));
    }
    return SL_OK;
}

sl_status sl_eye_exact(sl_context *context, sl_eye_search *search, const sl_view *view,
                       uint64_t *cells, sl_eye_account *account) {
    sl_eye_query query;
    SL_TRY(sl_eye_begin(context, search, view, false, cells, &query));
    bool done = query.cell == SL_NO_CELL;
    if (!done && !search->boxed) SL_TRY(sl_eye_exact_tree(context, &query, &done));
    if (!done) SL_TRY(search_portals(context, &query));
    sl_eye_end(&query, account);
    return SL_OK;
}
