/// The exact culling method: a depth-first search over portal sequences from the eye.
///
/// A step holds the arc of directions in which a line from the eye, within the view cone, crosses
/// all portals of the sequence. The search starts in each of the eye's cells, and so leaves out the
/// portals between them. Each such line is a sightline of the cell that it starts in. So with exact
/// visible sets the search never leaves them.
///
/// Arcs that lead to one cell by different sequences overlap in their borders at most. So there are
/// no more steps than visible pieces of cells, but for single rays. A single ray may pass a point
/// where portals meet on either side, and again at the next such point. Of all sequences that one
/// ray has to a cell, one is followed for each side on which it may still cross portals along it,
/// and for each number of limited walls, 0 or 1, that it has crossed.
#include "sight/eye_search.h"

#include <string.h>

/// On which sides a ray has crossed portals along it: that is all that tells apart what is ahead.
static unsigned sides_of(const sli_arc *ray) {
    return ray->left.along ? 2 : ray->right.along;
}

/// A number for a ray that no cell has been marked with.
static uint32_t new_ray(sli_eye_search *search) {
    if (++search->ray_count == 0) {
        memset(search->rays, 0,
               SLI_RAY_SIDES * (size_t)search->space->cell_count * (search->limited ? 2 : 1) *
                   sizeof(uint32_t));
        search->ray_count = 1;
    }
    return search->ray_count;
}

bool sli_eye_is_new(sli_eye_search *search, const sli_eye_step *from, sli_eye_step *to) {
    if (to->arcs[0].span != SLI_SPAN_RAY) return true;
    to->ray = from->ray ? from->ray : new_ray(search);
    const size_t cell = to->at.cell + (to->limited ? search->space->cell_count : (size_t)0);
    uint32_t *mark = &search->rays[SLI_RAY_SIDES * cell + sides_of(&to->arcs[0])];
    const bool fresh = *mark != to->ray;
    *mark = to->ray;
    return fresh;
}

void sli_eye_meet_targets(sli_eye_query *query, const sli_eye_step *at, bool first) {
    const sli_eye_targets *t = &query->search->targets;
    sli_eye_step neighbour;
    for (uint32_t i = t->first[at->at.cell]; i < t->first[at->at.cell + 1]; i++)
        if (!t->met[t->targets[i].portal])
            t->met[t->targets[i].portal] =
                sli_eye_pass_in_range(query, at, first, &t->targets[i], &neighbour);
}

/// One query's search.
typedef struct exact_job {
    sli_eye_query *query;
    sli_portal_search way; ///< of sli_eye_step
} exact_job;

/// Enters the step that stands behind the last one.
static sl_status enter(sl_context *context, exact_job *job, const sli_eye_step *to) {
    sli_eye_query *query = job->query;
    const size_t depth = ++job->way.count;
    if (query->search->targets.first) sli_eye_meet_targets(query, to, depth == 1);
    if (SLI_BOXES && query->search->boxes) sli_eye_meet_boxes(query, to, depth == 1);
    // No cell comes twice on the way; a first directed portal may have given two steps.
    if (depth > (size_t)query->space->cell_count + 1)
        return sl_fail(context, SL_BAD_INPUT,
                       "a line enters cell %u twice: cells and portals do not fit together",
                       (unsigned)to->at.cell);
    return ++query->nodes % 1024 == 0 ? sl_check_cancelled(context) : SL_OK;
}

/// Goes through a directed portal: one step for each arc that is left there.
SLI_VISIT sl_status cross(sl_context *context, void *visit, const void *last, void *next,
                          uint32_t number) {
    exact_job *job = visit;
    sli_eye_query *query = job->query;
    const sli_eye_step *from = last;
    sli_eye_step *to = next, entered;
    const sl_directed_portal *directed = &query->space->directed[number];
    if (!sli_eye_may_see(query, directed->cell) ||
        !sli_eye_pass_in_range(query, from, job->way.count == 1, directed, &entered) ||
        entered.near || !sli_eye_may_cross(query->search, from, directed->portal, &entered))
        return SL_OK;
    for (unsigned i = 0; i < entered.arc_count; i++) {
        *to = entered;
        to->arcs[0] = entered.arcs[i];
        to->arc_count = 1;
        if (!sli_eye_is_new(query->search, from, to)) continue;
        sl_bits_add(query->cells, directed->cell);
        SL_TRY(enter(context, job, to++));
    }
    return SL_OK;
}

static sl_status search_portals(sl_context *context, sli_eye_query *query, uint32_t fan) {
    static const sli_portal_visitor visitor = {.step_size = sizeof(sli_eye_step), .cross = cross};
    sli_eye_search *search = query->search;
    exact_job job = {.query = query,
                     .way = {.space = query->space,
                             .steps = search->steps,
                             .capacity = (size_t)query->space->cell_count + 3}};
    search->steps[0] = sli_eye_first_step(query, fan);
    if (sli_eye_leads_into(query, search->steps[0].at.cell))
        sl_bits_add(query->cells, search->steps[0].at.cell);
    sl_status status = enter(context, &job, &search->steps[0]);
    if (status == SL_OK) status = sli_portal_search_run(context, &job.way, &visitor, &job);
    search->steps = job.way.steps;
    return status;
}

sl_status sli_eye_exact(sl_context *context, sli_eye_search *search, const sl_view *view,
                        uint64_t *cells, sl_eye_account *account) {
    sli_eye_query query;
    SL_TRY(sli_eye_begin(context, search, view, false, cells, &query));
    for (uint32_t fan = 0; fan < query.fan_count; fan++) {
        bool done = false;
        if (!search->boxed && !search->boxes)
            SL_TRY(sli_eye_exact_tree(context, &query, fan, &done));
        if (!done) SL_TRY(search_portals(context, &query, fan));
    }
    sli_eye_end(&query, account);
    return SL_OK;
}
