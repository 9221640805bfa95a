/// Exact from-region visibility with an exact stabbing solver: a depth-first search over portal
/// sequences from a face on, within one quadrant of directions (Teller & Séquin 1991). A side of a
/// leaf is stabbed as if it were one more portal.
///
/// In the plane the lines of a quadrant that leave by a face go through leaves in one way each. So
/// sequences share no inner lines, and their number is at most the square of the number of portal
/// ends. This is the exact solver of two dimensions, where three dimensions need Plücker space.
#include "base/bits.h"
#include "cell_to_cell/search/portal_search.h"
#include "study/from_region/from_region_scene.h"

#include <string.h>

typedef struct step {
    sli_portal_step at; ///< a leaf
    sli_direction_sector cone;
    bool grazing;
} step;

typedef struct searcher {
    const sl_from_region_scene *scene;
    const sl_from_region_options *options;
    sli_portal_search search;
    sl_bits *left; ///< of the refine set, what is not seen yet
    uint64_t left_count;
    /// Of the query at hand:
    const sli_from_region_query *query;
    sl_bits *seen;
    sli_from_region_account *account;
} searcher;

static void destroy(sl_context *context, void *state) {
    searcher *s = state;
    if (!s) return;
    sli_portal_search_end(context, &s->search);
    sl_free(context, s->left);
    sl_free(context, s);
}

static sl_status create(sl_context *context, const sl_from_region_scene *scene,
                        const sl_from_region_options *options, void **state) {
    if (!options->stab || !options->stab->toward)
        return sl_fail(context, SL_BAD_ARGUMENT, "the solver 'stabs' needs a stabbing solver");
    searcher *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->scene = scene;
    s->options = options;
    s->search = (sli_portal_search){.space = &scene->space, .solver = options->stab};
    s->left = sl_alloc_array(context, scene->words, sizeof *s->left);
    sl_status status = s->left ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = options->stab->create(context, scene->space.bounds, &s->search.solver_state);
    if (status == SL_OK)
        *state = s;
    else
        destroy(context, s);
    return status;
}

/// Whether the sequence with one more portal counts as seen; if not, it is popped.
static sl_status push_portal(sl_context *context, searcher *s, sl_portal_ends ends,
                             const sli_direction_sector *cone, bool grazing_before, bool *seen,
                             bool *grazing) {
    const sl_solver *solver = s->search.solver;
    sl_stab_verdict verdict;
    SL_TRY(sli_portal_search_push(context, &s->search, ends.left, ends.right, &verdict));
    if (verdict != SL_HIDDEN)
        SL_TRY(solver->toward(context, s->search.solver_state, cone->right, cone->left, &verdict));
    *grazing = grazing_before || verdict == SL_GRAZING;
    *seen = verdict != SL_HIDDEN && (s->options->sight == SL_CLOSED || !*grazing);
    if (!*seen) sli_portal_search_pop(&s->search);
    return SL_OK;
}

/// Tries the items of the leaf that a step enters.
static sl_status try_items(sl_context *context, searcher *s, const step *at) {
    const sl_from_region_scene *scene = s->scene;
    const uint32_t *index = scene->first_leaf_item;
    for (uint32_t i = index[at->at.cell]; i < index[at->at.cell + 1]; i++) {
        const sli_item *item = &scene->items.items[scene->leaf_items[i]];
        if (!sl_bits_has(s->left, item->object)) continue;
        const sl_portal_ends ends = sli_item_ends(item, s->query->quadrant);
        const sl_directed_portal as_portal = {.left = ends.left, .right = ends.right};
        sli_direction_sector cone = at->cone;
        if (ends.left.x == ends.right.x && ends.left.y == ends.right.y) continue;
        if (!sli_direction_sector_cut(&cone, &as_portal)) continue;
        bool stabbed, grazing;
        s->account->rays++;
        SL_TRY(push_portal(context, s, ends, &cone, at->grazing, &stabbed, &grazing));
        if (!stabbed) continue;
        sli_portal_search_pop(&s->search);
        s->left[item->object / 64] &= ~((sl_bits)1 << (item->object % 64));
        s->left_count--;
        sl_bits_add(s->seen, item->object);
    }
    s->search.stop = !s->left_count;
    return SL_OK;
}

/// Goes through a directed portal where the sequence with it is seen.
static sl_status cross(sl_context *context, void *job, const void *last, void *next,
                       uint32_t number) {
    searcher *s = job;
    const step *from = last;
    step *to = next;
    const sl_from_region_scene *scene = s->scene;
    const sl_directed_portal *directed = &scene->space.directed[number];
    if (scene->passes[s->query->quadrant].leaves.faces[number] == SLI_NO_FACE) return SL_OK;
    *to = (step){.at.cell = directed->cell, .cone = from->cone};
    bool stabbed;
    if (!sli_direction_sector_cut(&to->cone, directed)) return SL_OK;
    if (++s->account->rays % 64 == 0) SL_TRY(sl_check_cancelled(context));
    SL_TRY(push_portal(context, s, (sl_portal_ends){directed->left, directed->right}, &to->cone,
                       from->grazing, &stabbed, &to->grazing));
    if (!stabbed) return SL_OK;
    s->search.count++;
    return try_items(context, s, to);
}

static sl_status run(sl_context *context, void *state, const sli_from_region_query *query,
                     sl_bits *seen, sli_from_region_account *account) {
    static const sli_portal_visitor visitor = {.step_size = sizeof(step), .cross = cross};
    searcher *s = state;
    memcpy(s->left, query->refine, s->scene->words * sizeof *s->left);
    s->left_count = sli_bits_count(s->left, s->scene->words);
    account->images++;
    account->refined += s->left_count;
    s->query = query;
    s->seen = seen;
    s->account = account;
    SL_TRY(sli_portal_search_start(context, &s->search, sizeof(step)));
    const step outside = {.cone = s->scene->passes[query->quadrant].leaves.cone};
    SL_TRY(cross(context, s, &outside, s->search.steps, query->face->directed));
    return sli_portal_search_run(context, &s->search, &visitor, s);
}

const sli_from_region_solver_calls *sli_from_region_stabs(void) {
    static const sli_from_region_solver_calls stabs = {
        .create = create,
        .destroy = destroy,
        .run = run,
    };
    return &stabs;
}
