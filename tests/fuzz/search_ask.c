/// What a search asks of one sequence: do all solvers agree, and with the oracle?
#include "search.h"

#include <math.h>

static sl_box bounds_of(const random_portals *portals) {
    return oracle_bounds(portals->items, portals->count);
}

/// Fills in portals and truth.
static void ask_reference(const random_portals *portals, search_trial *trial) {
    sl_point ends[2 * RANDOM_PORTALS];
    for (size_t i = 0; i < portals->count; i++) {
        ends[2 * i] = portals->items[i].left;
        ends[2 * i + 1] = portals->items[i].right;
    }
    oracle_sequence *sequence = oracle_sequence_create(ends, 2 * portals->count);
    trial->portals.count = 0;
    sl_stab_verdict verdict = SL_STABBED;
    for (size_t i = 0; i < portals->count && verdict != SL_HIDDEN; i++) {
        if (!oracle_sequence_forwards(sequence, portals->items[i])) continue;
        verdict = oracle_sequence_push(sequence, portals->items[i]);
        trial->truth[trial->portals.count] = verdict;
        trial->portals.items[trial->portals.count++] = portals->items[i];
    }
    oracle_sequence_destroy(sequence);
}

static sl_status push(const search *s, const sl_solver *solver, void *state,
                      const oracle_portal *portal, sl_stab_verdict *verdict) {
    return solver->push(s->context, state, portal->left, portal->right, verdict);
}

static void ask_again(const search *s, const sl_solver *solver, void *state,
                      const random_portals *portals, size_t from, search_answer *answer) {
    if (answer->status != SL_OK || from >= answer->count) return;
    for (size_t i = answer->count; i > from; i--) solver->pop(state);
    for (size_t i = from; i < answer->count; i++) {
        sl_stab_verdict verdict;
        const sl_status status = push(s, solver, state, &portals->items[i], &verdict);
        if (status == SL_OK && verdict == answer->verdicts[i]) continue;
        answer->changed = true;
        return;
    }
}

static void ask_solver(const search *s, const sl_solver *solver, const random_portals *portals,
                       size_t back, search_answer *answer) {
    void *state;
    *answer = (search_answer){0};
    answer->status = solver->create(s->context, bounds_of(portals), &state);
    if (answer->status != SL_OK) return;
    bool goes_on = true;
    for (size_t i = 0; goes_on && i < portals->count; i++) {
        answer->status = push(s, solver, state, &portals->items[i], &answer->verdicts[i]);
        if (answer->status != SL_OK) break;
        answer->count++;
        goes_on = answer->verdicts[i] != SL_HIDDEN;
    }
    if (back) ask_again(s, solver, state, portals, back - 1, answer);
    solver->destroy(s->context, state);
}

bool search_references_differ(const search_trial *trial) {
    return trial->truth[trial->portals.count - 1] != trial->margin.verdict;
}

double search_miss(const search_trial *trial) {
    return fabs(trial->margin.value) / trial->size;
}

bool search_ask(const search *s, const random_portals *portals, size_t back, search_trial *trial) {
    ask_reference(portals, trial);
    if (trial->portals.count < 2) return false;
    const sl_box box = bounds_of(&trial->portals);
    trial->size = fmax(box.max.x - box.min.x, box.max.y - box.min.y);
    trial->margin = oracle_margin_of(trial->portals.items, trial->portals.count);
    for (size_t i = 0; i < s->solver_count; i++)
        ask_solver(s, s->solvers[i], &trial->portals, back, &trial->answers[i]);
    return !search_references_differ(trial);
}
