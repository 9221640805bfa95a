/// The exact method by mirror: a mirror is one more portal, which leads back into the cell before
/// it. Behind it the eye is its image in the mirror, and the rest of the arc is reflected with it.
/// Cells and portals stay where they are.
#include "sight/eye_search.h"

/// A step, the number of mirrors on its way, and the one crossed last, UINT32_MAX for a portal.
typedef struct step {
    sli_eye_step at;
    uint32_t depth, mirror;
} step;

typedef sli_eye_mirrors mirrors;

sl_status sli_eye_search_add_mirrors(sl_context *context, sli_eye_search *search, const sl_map *map,
                                     uint32_t depth) {
    mirrors *m = sl_alloc_array(context, 1, sizeof *m);
    if (!m) return SL_NO_MEMORY;
    m->map = map;
    m->depth = depth;
    m->images = sl_alloc_array(context, (size_t)depth + 1, sizeof *m->images);
    const sl_status status =
        m->images ? sli_mirror_sides_find(context, search->space, map, &m->sides) : SL_NO_MEMORY;
    if (status != SL_OK) {
        sli_eye_mirrors_destroy(context, m);
        return status;
    }
    sli_eye_mirrors_destroy(context, search->mirrors);
    search->mirrors = m;
    return SL_OK;
}

/// Puts the eye where it is seen to be after a number of mirrors.
static void look_from(sli_eye_query *query, uint32_t depth) {
    const sli_fine *image = &query->search->mirrors->images[depth];
    query->pivot.eye = image->at;
    query->pivot.rest = image->rest;
    query->pivot.fine = depth > 0;
}

/// Enters a step for each arc of one, at `to` and behind it.
static sl_status enter(sl_context *context, sli_eye_query *query, const sli_eye_step *from,
                       step *to) {
    const step entered = *to;
    mirrors *m = query->search->mirrors;
    const size_t most = ((size_t)query->space->cell_count + 2) * ((size_t)m->depth + 1);
    for (unsigned i = 0; i < entered.at.arc_count; i++) {
        *to = entered;
        to->at.arcs[0] = entered.at.arcs[i];
        to->at.arc_count = 1;
        if (!sli_eye_is_new(query->search, from, &to->at)) continue;
        if (to->depth && query->search->targets.first) sli_eye_meet_targets(query, &to->at, false);
        if (to->depth) sl_bits_add(query->cells, to->at.at.cell);
        to++;
        if (++m->way.count > most)
            return sl_fail(context, SL_BAD_INPUT,
                           "a line enters cell %u twice: cells and portals do not fit together",
                           (unsigned)entered.at.at.cell);
        if (++query->nodes % 1024 == 0) SL_TRY(sl_check_cancelled(context));
    }
    return SL_OK;
}

static sl_status cross(sl_context *context, void *job, const void *last, void *next,
                       uint32_t number) {
    sli_eye_query *query = job;
    const step *from = last;
    step *to = next;
    const bool first = query->search->mirrors->way.count == 1;
    const sl_directed_portal *directed = &query->space->directed[number];
    if (!from->depth && !sli_eye_may_see(query, directed->cell)) return SL_OK;
    look_from(query, from->depth);
    if (!sli_eye_pass_in_range(query, &from->at, first, directed, &to->at)) return SL_OK;
    to->depth = from->depth;
    to->mirror = UINT32_MAX;
    return enter(context, query, &from->at, to);
}

static sli_ray fold_ray(mirrors *m, sl_segment mirror, sli_ray ray) {
    bool rounded = false;
    const sli_fine image = sli_fold(mirror, &(sli_fine){ray.point, ray.rest}, &rounded);
    m->rounded += rounded;
    ray.point = image.at;
    ray.rest = image.rest;
    return ray;
}

static sl_status reflect(sl_context *context, void *job, const void *last, void *next,
                         uint32_t number) {
    sli_eye_query *query = job;
    const step *from = last;
    step *to = next;
    mirrors *m = query->search->mirrors;
    const sli_mirror_side *side = &m->sides.sides[number];
    const sl_segment mirror = m->map->mirrors[side->mirror].segment;
    // Behind a mirror its own side is behind the line of sight, but for rounding.
    if (from->mirror == side->mirror || from->depth == m->depth) return SL_OK;
    const sl_directed_portal directed = {
        .left = side->left, .right = side->right, .cell = side->cell};
    sli_eye_step seen;
    look_from(query, from->depth);
    if (!sli_eye_pass_in_range(query, &from->at, m->way.count == 1, &directed, &seen)) return SL_OK;
    bool rounded = false;
    *to = (step){
        .at = {.at = seen.at, .near = seen.near}, .depth = from->depth + 1, .mirror = side->mirror};
    m->images[to->depth] = sli_fold(mirror, &m->images[from->depth], &rounded);
    m->rounded += rounded;
    look_from(query, to->depth);
    for (unsigned i = 0; i < seen.arc_count; i++)
        to->at.arc_count +=
            sli_arc_make(&query->pivot, fold_ray(m, mirror, seen.arcs[i].left),
                         fold_ray(m, mirror, seen.arcs[i].right), &to->at.arcs[to->at.arc_count]);
    return enter(context, query, &(sli_eye_step){0}, to);
}

static sl_status search(sl_context *context, sli_eye_query *query, uint32_t fan) {
    static const sli_portal_visitor visitor = {
        .step_size = sizeof(step), .cross = cross, .reflect = reflect};
    mirrors *m = query->search->mirrors;
    m->way.space = query->space;
    m->way.mirrors = &m->sides;
    SL_TRY(sli_portal_search_start(context, &m->way, sizeof(step)));
    step *first = m->way.steps;
    *first = (step){.at = sli_eye_first_step(query, fan), .mirror = UINT32_MAX};
    m->way.count = 1;
    query->nodes++;
    return sli_portal_search_run(context, &m->way, &visitor, query);
}

sl_status sli_eye_exact_mirrored(sl_context *context, sli_eye_search *s, const sl_view *view,
                                 uint64_t *cells, sl_eye_account *account) {
    if (!s->mirrors)
        return sl_fail(context, SL_BAD_ARGUMENT, "the search was given no mirrors to look into");
    sli_eye_query query;
    SL_TRY(sli_eye_begin(context, s, view, false, cells, &query));
    s->mirrors->rounded = 0;
    s->mirrors->images[0] = (sli_fine){.at = view->eye};
    for (uint32_t fan = 0; fan < query.fan_count; fan++) SL_TRY(search(context, &query, fan));
    sli_eye_end(&query, account);
    if (account) account->rounded = s->mirrors->rounded;
    return SL_OK;
}
