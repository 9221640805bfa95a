/// The exact method by mirror: portal sequences as in exact.c, in which a mirror is one more portal
/// that leads back into the cell before it. From there on the eye is its image in the mirror, and
/// what is left of the cone is reflected with it: cells and portals stay where they are.
#include "eye_to_cell/eye_search.h"

#include "effects/fold.h"
#include "effects/mirror_sides.h"

/// A step, the number of mirrors on its way, and the one crossed last, UINT32_MAX for a portal.
typedef struct step {
    sl_eye_step at;
    uint32_t depth, mirror;
} step;

struct sl_eye_mirrors {
    const sl_map *map;
    uint32_t depth;
    sl_mirror_sides sides;
    sl_fine *images; ///< of the eye, by the number of mirrors
    SL_ARRAY(step) steps;
    uint64_t rounded;
};

typedef struct sl_eye_mirrors mirrors;

sl_status sl_eye_search_add_mirrors(sl_context *context, sl_eye_search *search, const sl_map *map,
                                    uint32_t depth) {
    mirrors *m = sl_alloc_array(context, 1, sizeof *m);
    if (!m) return SL_NO_MEMORY;
    m->map = map;
    m->depth = depth;
    m->images = sl_alloc_array(context, (size_t)depth + 1, sizeof *m->images);
    const sl_status status =
        m->images ? sl_mirror_sides_find(context, search->space, map, &m->sides) : SL_NO_MEMORY;
    if (status != SL_OK) {
        sl_eye_mirrors_destroy(context, m);
        return status;
    }
    sl_eye_mirrors_destroy(context, search->mirrors);
    search->mirrors = m;
    return SL_OK;
}

void sl_eye_mirrors_destroy(sl_context *context, mirrors *m) {
    if (!m) return;
    sl_mirror_sides_destroy(context, &m->sides);
    sl_free(context, m->images);
    sl_free(context, m->steps.items);
    sl_free(context, m);
}

/// Puts the eye where it is seen to be after a number of mirrors.
static void look_from(sl_eye_query *query, uint32_t depth) {
    const sl_fine *image = &query->search->mirrors->images[depth];
    query->pivot.eye = image->at;
    query->pivot.rest = image->rest;
    query->pivot.fine = depth > 0;
}

/// Adds a step for each arc that is left of one.
static sl_status enter(sl_context *context, sl_eye_query *query, const sl_eye_step *from,
                       const step *entered) {
    mirrors *m = query->search->mirrors;
    for (unsigned i = 0; i < entered->at.arc_count; i++) {
        step to = *entered;
        to.at.arcs[0] = entered->at.arcs[i];
        to.at.arc_count = 1;
        if (!sl_eye_is_new(query->search, from, &to.at)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &m->steps, 1));
        m->steps.items[m->steps.count++] = to;
        if (to.depth) sl_bits_add(query->cells, to.at.cell);
        if (++query->nodes % 1024 == 0) SL_TRY(sl_check_cancelled(context));
    }
    return SL_OK;
}

static sl_status try_portal(sl_context *context, sl_eye_query *query, const step *last, bool first,
                            uint32_t number) {
    const sl_directed_portal *directed = &query->space->directed[number];
    step to = {.depth = last->depth, .mirror = UINT32_MAX};
    if (!last->depth && !sl_eye_may_see(query, directed->cell)) return SL_OK;
    if (!sl_eye_pass_in_range(query, &last->at, first, directed, &to.at)) return SL_OK;
    return enter(context, query, &last->at, &to);
}

static sl_ray fold_ray(mirrors *m, sl_segment mirror, sl_ray ray) {
    bool rounded = false;
    const sl_fine image = sl_fold(mirror, &(sl_fine){ray.point, ray.rest}, &rounded);
    m->rounded += rounded;
    ray.point = image.at;
    ray.rest = image.rest;
    return ray;
}

static sl_status try_mirror(sl_context *context, sl_eye_query *query, const step *last, bool first,
                            uint32_t number) {
    mirrors *m = query->search->mirrors;
    const sl_mirror_side *side = &m->sides.sides[number];
    const sl_segment mirror = m->map->mirrors[side->mirror].segment;
    // Behind a mirror its own side is behind the line of sight, but for rounding.
    if (last->mirror == side->mirror || last->depth == m->depth) return SL_OK;
    const sl_directed_portal directed = {
        .left = side->left, .right = side->right, .cell = side->cell};
    step to = {.depth = last->depth + 1, .mirror = side->mirror};
    sl_eye_step seen;
    if (!sl_eye_pass_in_range(query, &last->at, first, &directed, &seen)) return SL_OK;
    bool rounded = false;
    m->images[to.depth] = sl_fold(mirror, &m->images[last->depth], &rounded);
    m->rounded += rounded;
    look_from(query, to.depth);
    to.at = (sl_eye_step){.cell = seen.cell, .near = seen.near};
    for (unsigned i = 0; i < seen.arc_count; i++)
        to.at.arc_count +=
            sl_arc_make(&query->pivot, fold_ray(m, mirror, seen.arcs[i].left),
                        fold_ray(m, mirror, seen.arcs[i].right), &to.at.arcs[to.at.arc_count]);
    return enter(context, query, &(sl_eye_step){0}, &to);
}

static sl_status search(sl_context *context, sl_eye_query *query) {
    const sl_space *space = query->space;
    mirrors *m = query->search->mirrors;
    const size_t most = ((size_t)space->cell_count + 2) * ((size_t)m->depth + 1);
    m->steps.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &m->steps, 1));
    m->images[0] = (sl_fine){.at = query->pivot.eye};
    m->steps.items[m->steps.count++] = (step){.at = sl_eye_first_step(query), .mirror = UINT32_MAX};
    query->nodes = 1;
    while (m->steps.count) {
        step *top = &m->steps.items[m->steps.count - 1];
        const sl_cell *cell = &space->cells[top->at.cell];
        const uint32_t first_side = m->sides.first[top->at.cell];
        const uint32_t sides = m->sides.first[top->at.cell + 1] - first_side;
        const uint32_t next = top->at.next++;
        const bool first = m->steps.count == 1;
        const step last = *top;
        look_from(query, last.depth);
        if (next == 0 && last.depth && query->search->targets.first)
            sl_eye_meet_targets(query, &last.at, false);
        if (next < cell->directed_count)
            SL_TRY(try_portal(context, query, &last, first, cell->first_directed + next));
        else if (next < cell->directed_count + sides)
            SL_TRY(
                try_mirror(context, query, &last, first, first_side + next - cell->directed_count));
        else
            m->steps.count--;
        if (m->steps.count > most)
            return sl_fail(context, SL_BAD_INPUT,
                           "a line enters cell %u twice: cells and portals do not fit together",
                           (unsigned)last.at.cell);
    }
    return SL_OK;
}

sl_status sl_eye_exact_mirrored(sl_context *context, sl_eye_search *s, const sl_view *view,
                                uint64_t *cells, sl_eye_account *account) {
    if (!s->mirrors)
        return sl_fail(context, SL_BAD_ARGUMENT, "the search was given no mirrors to look into");
    sl_eye_query query;
    SL_TRY(sl_eye_begin(context, s, view, false, cells, &query));
    s->mirrors->rounded = 0;
    if (query.cell != SL_NO_CELL) SL_TRY(search(context, &query));
    sl_eye_end(&query, account);
    account->rounded = s->mirrors->rounded;
    return SL_OK;
}
