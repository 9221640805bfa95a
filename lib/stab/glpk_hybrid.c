/// Stabbing in doubles with certified answers: how an answer that may be rounded wrong becomes one
/// that can be relied on.
///
/// GLPK's simplex answers first. A line that it found is tried on every portal end by the exact
/// predicate; if it passes strictly between all, the sequence is stabbed, whatever GLPK rounded.
/// That there is no line is proven by few portals: those whose ends the best line is tight to, with
/// those that bound its direction. If the exact solver finds no line through these, there is none
/// through all. Where neither proof holds (margins near zero, above all) the exact solver decides
/// on the whole.
#include "sightline/glpk.h"
#include "sightline/stab.h"

#include "sightline/support.h"
#include "stab/funnel.h"
#include "stab/glpk_shared.h"

/// What a push was answered.
typedef struct answer {
    sl_stab_verdict verdict;
    bool certified; ///< GLPK's own, and proven
} answer;

typedef struct hybrid {
    void *simplex;
    void *exact; ///< a funnel that holds the first `exact_count` portals
    size_t exact_count;
    void *few; ///< a funnel for proofs, empty between calls
    SL_ARRAY(sl_portal_ends) portals;
    SL_ARRAY(answer) answers; ///< one a portal
    sl_stab_account account;  ///< what the funnels count is theirs
} hybrid;

static void destroy(sl_context *context, void *state) {
    hybrid *h = state;
    if (!h) return;
    sl_glpk_simplex()->destroy(context, h->simplex);
    sl_funnel()->destroy(context, h->exact);
    sl_funnel()->destroy(context, h->few);
    sl_free(context, h->portals.items);
    sl_free(context, h->answers.items);
    sl_free(context, h);
}

static sl_status create(sl_context *context, sl_box bounds, void **state) {
    hybrid *h = sl_alloc_array(context, 1, sizeof *h);
    if (!h) return SL_NO_MEMORY;
    sl_status status = sl_glpk_simplex()->create(context, bounds, &h->simplex);
    if (status == SL_OK) status = sl_funnel()->create(context, bounds, &h->exact);
    if (status == SL_OK) status = sl_funnel()->create(context, bounds, &h->few);
    if (status == SL_OK)
        *state = h;
    else
        destroy(context, h);
    return status;
}

/// Brings the exact solver to the sequence as it stands; its verdict on it.
static sl_status decide_exactly(sl_context *context, hybrid *h, sl_stab_verdict *verdict) {
    h->account.fallbacks++;
    while (h->exact_count < h->portals.count) {
        const sl_portal_ends *p = &h->portals.items[h->exact_count++];
        SL_TRY(sl_funnel()->push(context, h->exact, p->left, p->right, verdict));
    }
    return SL_OK;
}

static bool passes_strictly(hybrid *h, sl_line line) {
    for (size_t i = 0; i < h->portals.count; i++) {
        const sl_portal_ends *p = &h->portals.items[i];
        if (sli_orient_counted(&h->account, line.a, line.b, p->left) <= 0 ||
            sli_orient_counted(&h->account, line.a, line.b, p->right) >= 0)
            return false;
    }
    return true;
}

/// Whether the few portals that the program names have no line by themselves.
static sl_status few_are_hidden(sl_context *context, hybrid *h, bool *hidden) {
    uint32_t portals[SLI_GLPK_TIGHT_MOST];
    const size_t count = sli_glpk_tight_portals(h->simplex, portals);
    sl_stab_verdict verdict = SL_STABBED;
    size_t pushed = 0;
    sl_status status = SL_OK;
    while (pushed < count && verdict != SL_HIDDEN && status == SL_OK) {
        const sl_portal_ends *p = &h->portals.items[portals[pushed++]];
        status = sl_funnel()->push(context, h->few, p->left, p->right, &verdict);
    }
    if (status != SL_OK) return status;
    while (pushed--) sl_funnel()->pop(h->few);
    *hidden = verdict == SL_HIDDEN;
    return SL_OK;
}

static sl_status hybrid_push(sl_context *context, void *state, sl_point left, sl_point right,
                             sl_stab_verdict *verdict) {
    hybrid *h = state;
    SL_TRY(SL_ARRAY_ROOM(context, &h->portals, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &h->answers, 1));
    h->portals.items[h->portals.count++] = (sl_portal_ends){left, right};
    answer *last = &h->answers.items[h->answers.count++];
    *last = (answer){0};
    SL_TRY(sl_glpk_simplex()->push(context, h->simplex, left, right, &last->verdict));
    if (last->verdict == SL_STABBED)
        last->certified = passes_strictly(h, sl_glpk_simplex()->witness(h->simplex));
    else if (last->verdict == SL_HIDDEN)
        SL_TRY(few_are_hidden(context, h, &last->certified));
    h->account.certified += last->certified;
    if (!last->certified) SL_TRY(decide_exactly(context, h, &last->verdict));
    *verdict = last->verdict;
    return SL_OK;
}

static void pop(void *state) {
    hybrid *h = state;
    sl_glpk_simplex()->pop(h->simplex);
    if (h->exact_count == h->portals.count) {
        sl_funnel()->pop(h->exact);
        h->exact_count--;
    }
    h->portals.count--;
    h->answers.count--;
}

/// Left to the exact solver: directions are compared by few predicates, once it has the sequence.
static sl_status toward(sl_context *context, void *state, sl_line right, sl_line left,
                        sl_stab_verdict *verdict) {
    hybrid *h = state;
    if (h->exact_count < h->portals.count) SL_TRY(decide_exactly(context, h, verdict));
    return sl_funnel()->toward(context, h->exact, right, left, verdict);
}

static sl_line witness(const void *state) {
    const hybrid *h = state;
    const bool certified = h->answers.items[h->answers.count - 1].certified;
    return certified ? sl_glpk_simplex()->witness(h->simplex) : sl_funnel()->witness(h->exact);
}

static sl_status conflict(sl_context *context, const void *state,
                          sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *count) {
    const hybrid *h = state;
    const bool strict = h->answers.items[h->answers.count - 1].verdict != SL_HIDDEN;
    return sli_conflict_find(context, h->portals.items, h->portals.count, strict, ends, count);
}

static void account(const void *state, sl_stab_account *sum) {
    const hybrid *h = state;
    sum->orientations += h->account.orientations;
    sum->exact += h->account.exact;
    sum->certified += h->account.certified;
    sum->fallbacks += h->account.fallbacks;
    sl_funnel()->account(h->exact, sum);
    sl_funnel()->account(h->few, sum);
}

static void leave_thread(void) {
    sl_glpk_simplex()->leave_thread();
}

const sl_solver *sl_glpk_hybrid(void) {
    static const sl_solver solver = {
        .name = "hybrid",
        .what = "GLPK first, its answer confirmed by exact predicates or else replaced",
        .guarantee = SL_EXACT,
        .create = create,
        .destroy = destroy,
        .push = hybrid_push,
        .pop = pop,
        .toward = toward,
        .witness = witness,
        .conflict = conflict,
        .account = account,
        .leave_thread = leave_thread,
    };
    return &solver;
}
