/// Which effect decides on a pair of cells: doors that are shut, one-way glass, the view range.
///
/// The pair is explained with all effects of the map. If it is seen, that is the answer. If not, it
/// is explained again without one effect, for each; an effect without which the pair is seen
/// decides. If no single one does, two are left out together, and then three. What hides the pair
/// then is walls alone.
///
/// Each search runs in a space of its own, in which shut doors are walls and glass has no directed
/// portal on its dark side. The answer is put back into the numbers of the space that was given.
/// Cost: up to eight searches for what is seen directly, and as many by mirror.
#include "effects/filtered.h"
#include "sightline/explain.h"

#include "sightline/support.h"

#include <math.h>

typedef struct job {
    const sl_space *space;
    const sl_map *map;
    const sl_explain_state *state;
    const sl_explain_options *options;
    uint32_t from, to;
} job;

/// The effects that can hide something: those that the map has, with a door that is shut.
static unsigned hiding_effects(const job *j) {
    unsigned effects = sl_plan_make(j->map).effects & (SL_EFFECT_ONEWAY | SL_EFFECT_RANGE);
    for (size_t i = 0; i < j->map->door_count && j->state->shut; i++)
        if (j->state->shut[i]) effects |= SL_EFFECT_DOOR;
    return effects;
}

// --- numbers

/// By directed portal of the space that was searched: the number in the space that was given.
static uint32_t *number_directed(sl_context *context, const sl_space *space,
                                 const sl_space *searched, const uint32_t *portals) {
    uint32_t *numbers = sl_alloc_array(context, searched->directed_count, sizeof *numbers);
    if (!numbers) return NULL;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const sl_cell *cell = &space->cells[c], *now = &searched->cells[c];
        uint32_t at = now->first_directed;
        const uint32_t stop = at + now->directed_count;
        for (uint32_t k = cell->first_directed;
             k < cell->first_directed + cell->directed_count && at < stop; k++)
            if (portals[space->directed[k].portal] == searched->directed[at].portal)
                numbers[at++] = k;
    }
    return numbers;
}

static void renumber_sequence(const uint32_t *numbers, sl_sequence *sequence) {
    for (uint32_t i = 0; i < sequence->directed_count; i++)
        sequence->directed[i] = numbers[sequence->directed[i]];
}

static void renumber(const uint32_t *numbers, sl_explanation *e) {
    renumber_sequence(numbers, &e->sequence);
    for (uint32_t i = 0; i < e->miss_count; i++) renumber_sequence(numbers, &e->misses[i].sequence);
    for (uint32_t i = 0; i < e->bent.step_count; i++)
        if (e->bent.steps[i].directed != UINT32_MAX)
            e->bent.steps[i].directed = numbers[e->bent.steps[i].directed];
}

// --- one search

static sl_status search(sl_context *context, const job *j, const sl_space *space, unsigned effects,
                        sl_explanation *out) {
    sl_explain_options options = *j->options;
    // Lengths are told wherever the map has a range.
    if (j->map->range > 0) options.range = effects & SL_EFFECT_RANGE ? j->map->range : INFINITY;
    SL_TRY(sl_explain(context, space, &options, j->from, j->to, out));
    if (!j->map->mirror_count) return SL_OK;
    const sl_status status =
        sl_explain_by_mirror(context, space, j->map, &options, j->state->mirror_depth, out);
    if (status != SL_OK) sl_explanation_destroy(context, out);
    return status;
}

/// Explains the pair with some of the effects that can hide something.
static sl_status explain(sl_context *context, const job *j, unsigned effects, sl_explanation *out) {
    const sli_filtered_space filtered = {.shut = effects & SL_EFFECT_DOOR ? j->state->shut : NULL,
                                         .one_way = effects & SL_EFFECT_ONEWAY};
    if (!filtered.shut && !filtered.one_way) return search(context, j, j->space, effects, out);
    uint32_t *portals = sl_alloc_array(context, j->space->portal_count, sizeof *portals);
    if (!portals) return SL_NO_MEMORY;
    sl_space space = {0};
    uint32_t *numbers = NULL;
    sl_status status = sli_filtered_space_make(context, j->space, &filtered, portals, &space);
    if (status == SL_OK) {
        numbers = number_directed(context, j->space, &space, portals);
        status = numbers ? search(context, j, &space, effects, out) : SL_NO_MEMORY;
    }
    if (status == SL_OK) renumber(numbers, out);
    sl_free(context, portals);
    sl_free(context, numbers);
    sl_space_destroy(context, &space);
    return status;
}

// --- which effect decides

/// Whether an explanation is seen, directly or by mirror.
static bool is_seen(const sl_explanation *e, bool mirrored) {
    if (!mirrored) return e->seen;
    return e->bent.verdict == SL_STABBED ||
           (e->bent.verdict == SL_GRAZING && e->sight == SL_CLOSED);
}

static unsigned count_bits(unsigned bits) {
    unsigned count = 0;
    for (; bits; bits &= bits - 1) count++;
    return count;
}

/// Notes what is seen without some effects, and keeps the first explanation of it.
static void note(sl_effect_verdict *verdict, bool mirrored, unsigned without,
                 const sl_explanation *tried, bool *kept) {
    if (verdict->seen || !is_seen(tried, mirrored)) return;
    if (count_bits(without) == 1) verdict->decides |= without;
    if (verdict->without) return;
    verdict->without = without;
    *kept = true;
}

/// Explains without some effects.
static sl_status try_without(sl_context *context, const job *j, unsigned effects, unsigned without,
                             sl_effect_explanation *out) {
    sl_explanation tried;
    bool direct = false, bent = false;
    SL_TRY(explain(context, j, effects & ~without, &tried));
    out->tests += tried.tests + tried.bent.tests;
    out->complete &= tried.complete && (tried.bent.complete || !tried.bent.asked);
    note(&out->direct, false, without, &tried, &direct);
    note(&out->mirrored, true, without, &tried, &bent);
    if (bent) {
        out->bent_without = tried.bent;
        tried.bent = (sl_bent_sightline){0};
    }
    if (direct) {
        const sl_bent_sightline rest = tried.bent;
        out->without = tried;
        out->without.bent = (sl_bent_sightline){0};
        tried = (sl_explanation){.bent = rest};
    }
    sl_explanation_destroy(context, &tried);
    return SL_OK;
}

/// Tries to leave out one effect, then two together, then three, until something is seen.
static sl_status find_deciding(sl_context *context, const job *j, unsigned effects,
                               sl_effect_explanation *out) {
    for (unsigned size = 1; size <= count_bits(effects); size++) {
        const bool direct = !out->direct.seen && !out->direct.without;
        const bool mirrored = !out->mirrored.seen && !out->mirrored.without;
        for (unsigned without = 1; without <= effects && (direct || mirrored); without++)
            if (!(without & ~effects) && count_bits(without) == size)
                SL_TRY(try_without(context, j, effects, without, out));
    }
    return SL_OK;
}

sl_status sl_explain_effects(sl_context *context, const sl_space *space, const sl_map *map,
                             const sl_explain_state *state, const sl_explain_options *options,
                             uint32_t from, uint32_t to, sl_effect_explanation *out) {
    const job j = {space, map, state, options, from, to};
    const unsigned effects = hiding_effects(&j);
    sl_effect_explanation made = {.effects = effects, .complete = true};
    sl_status status = explain(context, &j, effects, &made.now);
    if (status != SL_OK) return status;
    made.tests = made.now.tests + made.now.bent.tests;
    made.direct.seen = made.now.seen;
    made.mirrored.seen = !made.now.bent.asked || is_seen(&made.now, true);
    if (effects && (!made.direct.seen || !made.mirrored.seen))
        status = find_deciding(context, &j, effects, &made);
    made.mirrored.seen = made.now.bent.asked && is_seen(&made.now, true);
    if (status == SL_OK)
        *out = made;
    else
        sl_effect_explanation_destroy(context, &made);
    return status;
}

void sl_effect_explanation_destroy(sl_context *context, sl_effect_explanation *e) {
    e->without.bent = e->bent_without;
    sl_explanation_destroy(context, &e->now);
    sl_explanation_destroy(context, &e->without);
    *e = (sl_effect_explanation){0};
}
