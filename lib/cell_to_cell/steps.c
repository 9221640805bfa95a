#include "sightline/steps.h"

#include "cell_to_cell/crossing.h"
#include "sightline/solvers.h"
#include "sightline/support.h"

/// A cell on the way from the source.
typedef struct place {
    uint32_t cell, directed;
    uint32_t next;          ///< directed portal to try next, from 0
    uint32_t step;          ///< that entered it
    sl_crossings crossings; ///< of the portals so far
} place;

typedef struct recorder {
    const sl_space *space;
    const sl_steps_options *options;
    void *solver;
    sl_bits *seen;
    uint32_t seen_count, node_count;
    SL_ARRAY(place) way;
    SL_ARRAY(sl_step) steps;
} recorder;

sl_steps_options sl_steps_options_default(void) {
    return (sl_steps_options){.sight = SL_CLOSED, .solver = sl_funnel(), .most = 200000};
}

static sl_status add(sl_context *context, recorder *r, sl_step step) {
    SL_TRY(SL_ARRAY_ROOM(context, &r->steps, 1));
    step.node = r->node_count;
    step.seen = r->seen_count;
    r->steps.items[r->steps.count++] = step;
    return SL_OK;
}

static sl_status enter(sl_context *context, recorder *r, place to, sl_step step) {
    step.first = !sl_bits_has(r->seen, to.cell);
    sl_bits_add(r->seen, to.cell);
    r->seen_count += step.first;
    r->node_count++;
    to.step = (uint32_t)r->steps.count;
    SL_TRY(add(context, r, step));
    SL_TRY(SL_ARRAY_ROOM(context, &r->way, 1));
    r->way.items[r->way.count++] = to;
    return SL_OK;
}

static sl_status try_portal(sl_context *context, recorder *r, uint32_t number) {
    const sl_directed_portal *directed = &r->space->directed[number];
    const place from = r->way.items[r->way.count - 1];
    sl_crossings crossings = from.crossings;
    sl_step step = {.directed = number,
                    .cell = directed->cell,
                    .parent = from.step,
                    .depth = (uint32_t)r->way.count};
    if (r->options->inside_only && !r->space->cells[directed->cell].inside) return SL_OK;
    if (!sl_crossings_add(r->space, &crossings, number)) {
        step.kind = SL_STEP_BACKWARDS;
        return add(context, r, step);
    }
    const sl_solver *solver = r->options->solver;
    sl_stab_verdict verdict;
    SL_TRY(solver->push(context, r->solver, directed->left, directed->right, &verdict));
    step.grazing = verdict == SL_GRAZING;
    if (verdict == SL_HIDDEN || (verdict == SL_GRAZING && r->options->sight == SL_OPEN)) {
        solver->pop(r->solver);
        step.kind = SL_STEP_HIDDEN;
        return add(context, r, step);
    }
    return enter(context, r,
                 (place){.cell = directed->cell, .directed = number, .crossings = crossings}, step);
}

static sl_status leave(sl_context *context, recorder *r) {
    const place last = r->way.items[--r->way.count];
    if (r->way.count) r->options->solver->pop(r->solver);
    return add(context, r,
               (sl_step){.kind = SL_STEP_LEAVE,
                         .directed = last.directed,
                         .cell = last.cell,
                         .parent = last.step,
                         .depth = (uint32_t)r->way.count});
}

static sl_status record(sl_context *context, recorder *r, uint32_t source) {
    SL_TRY(enter(context, r,
                 (place){.cell = source, .directed = UINT32_MAX, .crossings = SL_CROSSINGS_NONE},
                 (sl_step){.directed = UINT32_MAX, .cell = source}));
    while (r->way.count && r->steps.count < r->options->most) {
        SL_TRY(sl_check_cancelled(context));
        place *last = &r->way.items[r->way.count - 1];
        const sl_cell *cell = &r->space->cells[last->cell];
        if (last->next < cell->directed_count)
            SL_TRY(try_portal(context, r, cell->first_directed + last->next++));
        else
            SL_TRY(leave(context, r));
    }
    return SL_OK;
}

sl_status sl_steps_record(sl_context *context, const sl_space *space,
                          const sl_steps_options *options, uint32_t source, sl_steps *out) {
    if (!options->solver)
        return sl_fail(context, SL_BAD_ARGUMENT, "steps of a search need a solver");
    if (source >= space->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: there are %u cells", (unsigned)source,
                       (unsigned)space->cell_count);
    recorder r = {.space = space, .options = options};
    r.seen = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *r.seen);
    if (!r.seen) return SL_NO_MEMORY;
    sl_status status = options->solver->create(context, space->bounds, &r.solver);
    if (status == SL_OK) {
        status = record(context, &r, source);
        options->solver->destroy(context, r.solver);
    }
    const bool complete = r.way.count == 0;
    sl_free(context, r.seen);
    sl_free(context, r.way.items);
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
