/// Records a depth-first search step by step, to be shown: each portal that was tried, and what
/// came of it. The search is that of dfs.c, without bounds and effects.
#include "sightline/steps.h"

#include "cell_to_cell/search/directions.h"
#include "cell_to_cell/search/portal_search.h"
#include "sightline/stab.h"
#include "sightline/support.h"

/// A cell on the way from the source.
typedef struct place {
    sli_portal_step at;
    uint32_t directed;
    uint32_t step;             ///< that entered it
    sli_directions directions; ///< of the portals so far
} place;

typedef struct recorder {
    const sl_steps_options *options;
    sli_portal_search search;
    sl_bits *seen;
    uint32_t seen_count, node_count;
    SL_ARRAY(sl_step) steps;
} recorder;

sl_steps_options sl_steps_options_default(void) {
    return (sl_steps_options){.sight = SL_CLOSED, .solver = sl_funnel(), .most = 200000};
}

/// Records a step. The search stops where there are enough of them.
static sl_status add_step(sl_context *context, recorder *r, sl_step step) {
    SL_TRY(SL_ARRAY_ROOM(context, &r->steps, 1));
    step.node = r->node_count;
    step.seen = r->seen_count;
    r->steps.items[r->steps.count++] = step;
    r->search.stop = r->steps.count >= r->options->most;
    return sl_check_cancelled(context);
}

static sl_status enter(sl_context *context, recorder *r, place *to, sl_step step) {
    const uint32_t cell = to->at.cell;
    step.first = !sl_bits_has(r->seen, cell);
    sl_bits_add(r->seen, cell);
    r->seen_count += step.first;
    r->node_count++;
    to->step = (uint32_t)r->steps.count;
    r->search.count++;
    return add_step(context, r, step);
}

static sl_status cross(sl_context *context, void *job, const void *last, void *next,
                       uint32_t number) {
    recorder *r = job;
    const place *from = last;
    place *to = next;
    const sl_space *space = r->search.space;
    const sl_directed_portal *directed = &space->directed[number];
    *to = (place){.at.cell = directed->cell, .directed = number, .directions = from->directions};
    sl_step step = {.directed = number,
                    .cell = directed->cell,
                    .parent = from->step,
                    .depth = (uint32_t)r->search.count};
    if (r->options->inside_only && !space->cells[directed->cell].inside) return SL_OK;
    if (!sli_directions_add(space, &to->directions, number)) {
        step.kind = SL_STEP_BACKWARDS;
        return add_step(context, r, step);
    }
    sl_stab_verdict verdict;
    SL_TRY(sli_portal_search_push(context, &r->search, directed->left, directed->right, &verdict));
    step.grazing = verdict == SL_GRAZING;
    if (verdict == SL_HIDDEN || (verdict == SL_GRAZING && r->options->sight == SL_OPEN)) {
        sli_portal_search_pop(&r->search);
        step.kind = SL_STEP_HIDDEN;
        return add_step(context, r, step);
    }
    return enter(context, r, to, step);
}

static sl_status leave(sl_context *context, void *job, const void *left) {
    recorder *r = job;
    const place *last = left;
    return add_step(context, r,
                    (sl_step){.kind = SL_STEP_LEAVE,
                              .directed = last->directed,
                              .cell = last->at.cell,
                              .parent = last->step,
                              .depth = (uint32_t)r->search.count});
}

static sl_status record(sl_context *context, recorder *r, uint32_t source) {
    static const sli_portal_visitor visitor = {
        .step_size = sizeof(place), .cross = cross, .leave = leave};
    SL_TRY(sli_portal_search_start(context, &r->search, sizeof(place)));
    place *first = r->search.steps;
    *first = (place){.at.cell = source, .directed = UINT32_MAX, .directions = SLI_NO_DIRECTIONS};
    SL_TRY(enter(context, r, first, (sl_step){.directed = UINT32_MAX, .cell = source}));
    return sli_portal_search_run(context, &r->search, &visitor, r);
}

sl_status sl_steps_record(sl_context *context, const sl_space *space,
                          const sl_steps_options *options, uint32_t source, sl_steps *out) {
    if (!options->solver)
        return sl_fail(context, SL_BAD_ARGUMENT, "steps of a search need a solver");
    if (source >= space->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: there are %u cells", (unsigned)source,
                       (unsigned)space->cell_count);
    recorder r = {.options = options, .search = {.space = space, .solver = options->solver}};
    r.seen = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *r.seen);
    if (!r.seen) return SL_NO_MEMORY;
    sl_status status = options->solver->create(context, space->bounds, &r.search.solver_state);
    if (status == SL_OK) status = record(context, &r, source);
    const bool complete = r.search.count == 0;
    sli_portal_search_end(context, &r.search);
    sl_free(context, r.seen);
    if (status == SL_OK)
        *out = (sl_steps){r.steps.items, r.steps.count, complete};
    else
        sl_free(context, r.steps.items);
    return status;
}

void sl_steps_destroy(sl_context *context, sl_steps *steps) {
    sl_free(context, steps->steps);
    *steps = (sl_steps){0};
}

uint32_t sl_steps_sequence(const sl_steps *steps, size_t step, uint32_t *directed, uint32_t room) {
    const sl_step *s = &steps->steps[step];
    const uint32_t count = s->depth;
    if (s->kind == SL_STEP_LEAVE) s = &steps->steps[s->parent];
    for (uint32_t i = count; i-- > 0; s = &steps->steps[s->parent])
        if (i < room) directed[i] = s->directed;
    return count;
}
