/// Exact from-region visibility with an exact stabbing solver: a depth-first search over portal
/// sequences from the face on, within the quadrant alone (Teller & Séquin 1991, Cell to Cell
/// Visibility). A side of a leaf is stabbed as if it were one more portal.
///
/// In the plane the lines of a quadrant that leave by a face go through leaves in one way each, so
/// that sequences share no inner lines and their number is bounded by the square of the number of
/// portal ends: this is the exact solver of two dimensions, where three need Plücker space.
#include "from_region/regions.h"

#include <string.h>

typedef struct step {
    uint32_t leaf, next; ///< directed portal to try next, from 0
    sl_cone cone;
    bool grazing;
} step;

typedef struct searcher {
    const sl_regions *scene;
    const sl_from_region_options *options;
    void *solver;
    SL_ARRAY(step) steps;
    sl_bits *left; ///< of the refine set, what is not seen yet
    uint64_t left_count;
} searcher;

static void destroy(sl_context *context, void *state) {
    searcher *s = state;
    if (!s) return;
    if (s->solver) s->options->stab->destroy(context, s->solver);
    sl_free(context, s->steps.items);
    sl_free(context, s->left);
    sl_free(context, s);
}

static sl_status create(sl_context *context, const sl_regions *scene,
                        const sl_from_region_options *options, void **state) {
    if (!options->stab || !options->stab->toward)
        return sl_fail(context, SL_BAD_ARGUMENT, "the solver 'stabs' needs a stabbing solver");
    searcher *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->scene = scene;
    s->options = options;
    s->left = sl_alloc_array(context, scene->words, sizeof *s->left);
    sl_status status = s->left ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = options->stab->create(context, scene->space.bounds, &s->solver);
    if (status == SL_OK)
        *state = s;
    else
        destroy(context, s);
    return status;
}

/// Whether the sequence with one more portal counts as seen; if not, it is popped.
static sl_status push(sl_context *context, searcher *s, sl_portal_ends ends, const sl_cone *cone,
                      bool grazing_before, bool *seen, bool *grazing) {
    const sl_solver *solver = s->options->stab;
    sl_stab_verdict verdict;
    SL_TRY(solver->push(context, s->solver, ends.left, ends.right, &verdict));
    if (verdict != SL_HIDDEN)
        SL_TRY(solver->toward(context, s->solver, cone->right, cone->left, &verdict));
    *grazing = grazing_before || verdict == SL_GRAZING;
    *seen = verdict != SL_HIDDEN && (s->options->sight == SL_CLOSED || !*grazing);
    if (!*seen) solver->pop(s->solver);
    return SL_OK;
}

/// Tries the items of the leaf that the last step entered.
static sl_status try_items(sl_context *context, searcher *s, int quadrant, sl_bits *seen,
                           sl_from_region_account *account) {
    const sl_regions *scene = s->scene;
    const step at = s->steps.items[s->steps.count - 1];
    const uint32_t *index = scene->first_leaf_item;
    for (uint32_t i = index[at.leaf]; i < index[at.leaf + 1]; i++) {
        const sl_item *item = &scene->items.items[scene->leaf_items[i]];
        if (!sl_bits_has(s->left, item->object)) continue;
        const sl_portal_ends ends = sl_item_ends(item, quadrant);
        const sl_directed_portal as_portal = {.left = ends.left, .right = ends.right};
        sl_cone cone = at.cone;
        if (ends.left.x == ends.right.x && ends.left.y == ends.right.y) continue;
        if (!sl_cone_cut(&cone, &as_portal)) continue;
        bool stabbed, grazing;
        account->rays++;
        SL_TRY(push(context, s, ends, &cone, at.grazing, &stabbed, &grazing));
        if (!stabbed) continue;
        s->options->stab->pop(s->solver);
        s->left[item->object / 64] &= ~((sl_bits)1 << (item->object % 64));
        s->left_count--;
        sl_bits_add(seen, item->object);
    }
    return SL_OK;
}

/// Goes through a directed portal where the sequence with it is seen.
static sl_status try_portal(sl_context *context, searcher *s, const sl_from_region_query *query,
                            uint32_t number, sl_bits *seen, sl_from_region_account *account) {
    const sl_regions *scene = s->scene;
    const sl_directed_portal *directed = &scene->space.directed[number];
    if (scene->passes[query->quadrant].leaves.faces[number] == SL_NO_FACE) return SL_OK;
    const bool first = !s->steps.count;
    const step from = first ? (step){.cone = scene->passes[query->quadrant].leaves.cone}
                            : s->steps.items[s->steps.count - 1];
    step to = {.leaf = directed->cell, .cone = from.cone};
    bool stabbed;
    if (!sl_cone_cut(&to.cone, directed)) return SL_OK;
    if (++account->rays % 64 == 0) SL_TRY(sl_check_cancelled(context));
    SL_TRY(push(context, s, (sl_portal_ends){directed->left, directed->right}, &to.cone,
                from.grazing, &stabbed, &to.grazing));
    if (!stabbed) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &s->steps, 1));
    s->steps.items[s->steps.count++] = to;
    return try_items(context, s, query->quadrant, seen, account);
}

static sl_status run(sl_context *context, void *state, const sl_from_region_query *query,
                     sl_bits *seen, sl_from_region_account *account) {
    searcher *s = state;
    const sl_space *space = &s->scene->space;
    memcpy(s->left, query->refine, s->scene->words * sizeof *s->left);
    s->left_count = 0;
    for (size_t i = 0; i < s->scene->words; i++)
        s->left_count += (uint64_t)__builtin_popcountll(s->left[i]);
    account->images++;
    account->refined += s->left_count;
    s->steps.count = 0;
    SL_TRY(try_portal(context, s, query, query->face->directed, seen, account));
    while (s->steps.count) {
        step *last = &s->steps.items[s->steps.count - 1];
        const sl_cell *leaf = &space->cells[last->leaf];
        if (s->left_count && last->next < leaf->directed_count) {
            SL_TRY(
                try_portal(context, s, query, leaf->first_directed + last->next++, seen, account));
        } else {
            s->steps.count--;
            s->options->stab->pop(s->solver);
        }
    }
    return SL_OK;
}

const sl_from_region_solver_calls *sl_from_region_stabs(void) {
    static const sl_from_region_solver_calls stabs = {
        .create = create,
        .destroy = destroy,
        .run = run,
    };
    return &stabs;
}
