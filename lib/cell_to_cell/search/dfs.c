/// Depth-first search over portal sequences (Teller & Séquin 1991, Visibility Preprocessing for
/// Interactive Walkthroughs): what one cell sees.
///
/// The search starts in a source cell and goes through portals as long as some line stabs all
/// portals on the way. Every cell that it enters is seen from the source. The cells that it visits
/// form the stab tree of the source.
///
/// The search ends, since one direction crosses all portals of a sequence forwards. So no sequence
/// enters a cell twice (directions.h). Cost: one stabbing test for each node of the tree and for
/// each portal that leads out of it.
///
/// Rounded solvers mark answers near zero. The search follows these with either sight, so that all
/// pairs that hang on rounding are known. They count as seen with closed sight, not with open.
///
/// The method "prune" is the same search with an upper bound for each directed portal (flood.c), as
/// in Quake's vis. It goes through a portal only while the bounds of all portals on the way leave a
/// cell possible that it has not seen yet. A bound misses nothing: a cell that is seen stays
/// possible along the sequence that leads to it. With an exact solver each pair need be found from
/// one of its two cells only.
#include "cell_to_cell/search/dfs.h"

#include "base/size.h"
#include "cell_to_cell/methods.h"
#include "cell_to_cell/rows.h"
#include "sightline/support.h"

#include <string.h>

// --- stab trees within a limit on memory

static sl_status tree_store_create(sl_context *context, uint32_t cell_count, uint64_t limit,
                                   sli_tree_store *store) {
    *store = (sli_tree_store){.cell_count = cell_count, .limit = limit};
    store->trees = sl_alloc_array(context, cell_count, sizeof *store->trees);
    if (!store->trees) return SL_NO_MEMORY;
    pthread_mutex_init(&store->lock, NULL);
    return SL_OK;
}

static void tree_store_destroy(sl_context *context, sli_tree_store *store) {
    if (!store->trees) return;
    for (uint32_t i = 0; i < store->cell_count; i++) sl_free(context, store->trees[i].nodes);
    sl_free(context, store->trees);
    store->trees = NULL;
    pthread_mutex_destroy(&store->lock);
}

/// Adds a node to a growing tree; does nothing once the tree is larger than the limit.
static sl_status tree_grow(sl_context *context, const sli_tree_store *store, sli_growing_tree *tree,
                           sl_stab_node node) {
    if (tree->overflown) return SL_OK;
    if (tree->nodes.count == UINT32_MAX || (tree->nodes.count + 1) * sizeof node > store->limit) {
        tree->overflown = true;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &tree->nodes, 1));
    tree->nodes.items[tree->nodes.count++] = node;
    return SL_OK;
}

static void let_largest_go(sl_context *context, sli_tree_store *store) {
    struct sli_kept_tree *largest = &store->trees[0];
    for (uint32_t i = 1; i < store->cell_count; i++)
        if (store->trees[i].count >= largest->count) largest = &store->trees[i];
    store->held -= largest->count * sizeof(sl_stab_node);
    sl_free(context, largest->nodes);
    *largest = (struct sli_kept_tree){0};
}

/// Takes a finished tree, whose nodes then belong to the store. Drops the largest trees while the
/// store is above its limit. Safe from several threads.
static void tree_store_put(sl_context *context, sli_tree_store *store, uint32_t source,
                           sli_growing_tree *tree) {
    if (tree->overflown)
        sl_free(context, tree->nodes.items);
    else {
        pthread_mutex_lock(&store->lock);
        store->trees[source] =
            (struct sli_kept_tree){.nodes = tree->nodes.items, .count = tree->nodes.count};
        store->held += tree->nodes.count * sizeof(sl_stab_node);
        while (store->held > store->limit) let_largest_go(context, store);
        pthread_mutex_unlock(&store->lock);
    }
    *tree = (sli_growing_tree){0};
}

/// Joins what was kept, in the sources' order.
static sl_status tree_store_join(sl_context *context, const sli_tree_store *store,
                                 sl_stab_trees *out) {
    const uint32_t count = store->cell_count;
    uint64_t *offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *offsets);
    sl_stab_node *nodes =
        sl_alloc_array(context, sli_size(store->held / sizeof *nodes), sizeof *nodes);
    if (!offsets || !nodes) {
        sl_free(context, offsets);
        sl_free(context, nodes);
        return SL_NO_MEMORY;
    }
    uint32_t left_out = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct sli_kept_tree *tree = &store->trees[i];
        if (tree->count)
            memcpy(nodes + offsets[i], tree->nodes, sli_size(tree->count * sizeof *nodes));
        left_out += tree->count == 0;
        offsets[i + 1] = offsets[i] + tree->count;
    }
    *out = (sl_stab_trees){
        .cell_count = count, .left_out = left_out, .offsets = offsets, .nodes = nodes};
    return SL_OK;
}

/// A step of the search without effects.
typedef struct step {
    sli_dfs_step dfs;
    sli_directions directions; ///< of the portals so far
} step;

sl_status sli_dfs_enter(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                        sli_dfs_step *to, uint32_t parent, uint32_t directed, bool counts) {
    if (counts) {
        to->node = (uint32_t)me->account.nodes++;
        const sl_stab_node node = {.parent = parent, .cell = to->at.cell, .directed = directed};
        if (all->options->trees) SL_TRY(tree_grow(context, &all->trees, &me->tree, node));
    }
    const size_t depth = me->search.count++;
    if (depth > me->account.deepest) me->account.deepest = (uint32_t)depth;
    return SL_OK;
}

/// If the search prunes: makes the set of cells that are wanted beyond a directed portal of the
/// last step. `something` is false if no cell is.
static sl_status want(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                      uint32_t directed, bool *something) {
    *something = true;
    if (!all->prunes) return SL_OK;
    const size_t depth = me->search.count;
    SL_TRY(sli_prune_step(context, &all->bounds, &me->wanted, depth, directed));
    const sli_prune_set *set = &me->wanted.sets.items[depth];
    *something = set->all;
    for (size_t i = set->begin; i < set->end && !*something; i++) {
        const sli_prune_word *at = &me->wanted.words.items[i];
        *something = (at->bits & ~me->sure[at->word]) != 0;
    }
    return SL_OK;
}

/// Tests the sequence with one more directed portal, and enters the cell behind.
SLI_VISIT sl_status cross(sl_context *context, void *job, const void *last, void *next,
                          uint32_t number) {
    const sli_dfs *all = ((sli_dfs_job *)job)->all;
    sli_dfs_thread *me = ((sli_dfs_job *)job)->me;
    const step *from = last;
    step *to = next;
    const sl_directed_portal *directed = &all->space->directed[number];
    sli_directions directions = from->directions;
    if (!sli_directions_add(all->space, &directions, number)) return SL_OK;
    if (all->options->inside_only && !all->space->cells[directed->cell].inside) return SL_OK;
    bool something;
    SL_TRY(want(context, all, me, number, &something));
    if (!something) return SL_OK;
    if (++me->account.tests % 64 == 0) SL_TRY(sli_dfs_check_going_on(context, all));

    sl_stab_verdict verdict;
    SL_TRY(sli_portal_search_push(context, &me->search, directed->left, directed->right, &verdict));
    const bool closed = all->options->sight == SL_CLOSED;
    const bool rounded = all->options->solver->guarantee == SL_ROUNDED;
    const bool grazing = verdict == SL_GRAZING || from->dfs.grazing;
    if (verdict == SL_HIDDEN || (grazing && !closed && !rounded)) {
        sli_portal_search_pop(&me->search);
        return SL_OK;
    }
    sl_bits_add(grazing && rounded ? me->doubtful : me->sure, directed->cell);
    *to = (step){.dfs = {.at.cell = directed->cell, .grazing = grazing}, .directions = directions};
    return sli_dfs_enter(context, all, me, &to->dfs, from->dfs.node, number, closed || !grazing);
}

static sl_status search_from(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                             uint32_t source) {
    static const sli_portal_visitor visitor = {.step_size = sizeof(step), .cross = cross};
    sl_bits_add(me->sure, source);
    // Where pairs are found from either cell alike, those from the source on are wanted of it.
    const bool from_either = all->prunes && all->options->solver->guarantee == SL_EXACT;
    SL_TRY(sli_prune_start(context, &me->wanted, from_either ? source : 0));
    SL_TRY(sli_portal_search_start(context, &me->search, sizeof(step)));
    step *first = me->search.steps;
    *first = (step){.dfs.at.cell = source, .directions = SLI_NO_DIRECTIONS};
    SL_TRY(sli_dfs_enter(context, all, me, &first->dfs, 0, UINT32_MAX, true));
    sli_dfs_job job = {all, me};
    return sli_portal_search_run(context, &me->search, &visitor, &job);
}

static sl_status search_source(sl_context *context, sli_dfs *all, sli_dfs_thread *me,
                               uint32_t source) {
    const uint32_t count = all->space->cell_count;
    const size_t bytes = sl_bits_words(count) * sizeof(sl_bits);
    memset(me->sure, 0, bytes);
    memset(me->doubtful, 0, bytes);
    me->account = (sl_see_account){0};
    SL_TRY(all->effects ? sli_dfs_effects_search(context, all, me, source)
                        : search_from(context, all, me, source));
    SL_TRY(sli_row_append(context, &all->sure[source], me->sure, count));
    SL_TRY(sli_row_append(context, &all->doubtful[source], me->doubtful, count));
    if (all->options->trees) tree_store_put(context, &all->trees, source, &me->tree);
    all->accounts[source] = me->account;
    return SL_OK;
}

static sl_status search_unit(sl_context *context, void *job, void *state, size_t unit) {
    sli_dfs *all = job;
    const uint32_t source = (uint32_t)unit;
    const bool takes_part = sli_looks_from(all->space, all->options->inside_only, source);
    if (!all->before) return takes_part ? search_source(context, all, state, source) : SL_OK;
    if (!sli_unit_is_wanted(all->options, all->before, source)) return SL_OK;
    if (sli_is_enough(all->options)) return SL_OK;
    if (takes_part) {
        const sl_status status = search_source(context, all, state, source);
        // What the source has seen so far is let go: its row would not be exact.
        if (status == SL_CANCELLED && sli_is_enough(all->options))
            return sl_check_cancelled(context);
        SL_TRY(status);
    }
    all->done[source] = 1;
    return SL_OK;
}

static void end_dfs_worker(sl_context *context, void *job, void *state) {
    sli_dfs *all = job;
    sli_dfs_thread *me = state;
    const sl_solver *solver = all->options->solver;
    if (me->search.solver_state && solver->account) {
        pthread_mutex_lock(&all->lock);
        solver->account(me->search.solver_state, &all->stab);
        pthread_mutex_unlock(&all->lock);
    }
    sli_portal_search_end(context, &me->search);
    sl_free(context, me->sure);
    sl_free(context, me->doubtful);
    sli_prune_wanted_destroy(context, &me->wanted);
    sli_dfs_effects_end(context, me);
    sl_free(context, me->tree.nodes.items);
    sl_free(context, me);
}

static sl_status begin_dfs_worker(sl_context *context, void *job, void **state) {
    sli_dfs *all = job;
    sli_dfs_thread *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    const size_t words = all->words;
    me->sure = sl_alloc_array(context, words, sizeof *me->sure);
    me->doubtful = sl_alloc_array(context, words, sizeof *me->doubtful);
    sl_status status = me->sure && me->doubtful ? SL_OK : SL_NO_MEMORY;
    me->search = (sli_portal_search){.space = all->space, .solver = all->options->solver};
    if (status == SL_OK)
        status = me->search.solver->create(context, all->space->bounds, &me->search.solver_state);
    if (status == SL_OK && all->effects) status = sli_dfs_effects_begin(context, all, me);
    if (status == SL_OK)
        *state = me;
    else
        end_dfs_worker(context, job, me);
    return status;
}

static void sum_accounts(const sli_dfs *all, sl_see_account *sum) {
    for (uint32_t i = 0; i < all->space->cell_count; i++) {
        const sl_see_account *one = &all->accounts[i];
        sum->tests += one->tests;
        sum->nodes += one->nodes;
        if (one->deepest > sum->deepest) sum->deepest = one->deepest;
    }
    sum->stab = all->stab;
}

static sl_status run_search(sl_context *context, sli_dfs *all) {
    const sl_work work = {.job = all,
                          .begin = begin_dfs_worker,
                          .unit = search_unit,
                          .end = end_dfs_worker,
                          .leave_thread = all->options->solver->leave_thread,
                          .stage = "cell_to_cell",
                          .units = "cells"};
    return sl_work_run(context, &work, all->space->cell_count, all->options->threads);
}

static sl_status search_all(sl_context *context, sli_dfs *all, sl_visibility *out) {
    const uint32_t count = all->space->cell_count;
    SL_TRY(run_search(context, all));
    sum_accounts(all, &out->account);
    sl_pvs sure = {0}, doubtful = {0};
    sl_status status = sli_pvs_join(context, all->sure, count, &sure);
    if (status == SL_OK) status = sli_pvs_join(context, all->doubtful, count, &doubtful);
    const bool mutual = !all->effects || all->options->plan->mutual;
    if (status == SL_OK) status = sli_visibility_finish(context, &sure, &doubtful, mutual, out);
    sl_pvs_destroy(context, &sure);
    sl_pvs_destroy(context, &doubtful);
    if (status == SL_OK && all->effects) status = sli_dfs_effects_finish(context, all, out);
    if (status == SL_OK && all->options->trees)
        status = tree_store_join(context, &all->trees, &out->trees);
    return status;
}

static sl_status allocate(sl_context *context, sli_dfs *all) {
    const uint32_t count = all->space->cell_count;
    all->sure = sl_alloc_array(context, count, sizeof *all->sure);
    all->doubtful = sl_alloc_array(context, count, sizeof *all->doubtful);
    all->accounts = sl_alloc_array(context, count, sizeof *all->accounts);
    if (!all->sure || !all->doubtful || !all->accounts) return SL_NO_MEMORY;
    if (all->options->plan && all->options->plan->effects)
        SL_TRY(sli_dfs_effects_create(context, all));
    if (!all->options->trees) return SL_OK;
    return tree_store_create(context, count, all->options->tree_bytes, &all->trees);
}

static sl_status prepare(sl_context *context, sli_dfs *all) {
    // Portals that may lead to a mirror stay open: bounds of portals prune too little then to pay.
    const sl_plan *plan = all->options->plan;
    if (!all->known && plan && plan->effects & SL_EFFECT_MIRROR) all->prunes = false;
    all->words = sl_bits_words(all->space->cell_count);
    pthread_mutex_init(&all->lock, NULL);
    const sl_pvs *possible = all->known ? all->known->possible : NULL;
    if (all->prunes)
        SL_TRY(sli_prune_bounds_find(context, all->space, all->options, possible, &all->bounds));
    return allocate(context, all);
}

static void tidy_up(sl_context *context, sli_dfs *all) {
    for (uint32_t i = 0; i < all->space->cell_count; i++) {
        if (all->sure) sl_free(context, all->sure[i].items);
        if (all->doubtful) sl_free(context, all->doubtful[i].items);
    }
    sl_free(context, all->sure);
    sl_free(context, all->doubtful);
    sl_free(context, all->accounts);
    sli_prune_bounds_destroy(context, &all->bounds);
    sli_dfs_effects_destroy(context, all);
    sl_free(context, all->done);
    tree_store_destroy(context, &all->trees);
    pthread_mutex_destroy(&all->lock);
}

static sl_status see(sl_context *context, sli_dfs *all, sl_visibility *out) {
    sl_visibility visibility = {.sight = all->options->sight,
                                .guarantee = all->options->solver->guarantee};
    sl_status status = prepare(context, all);
    if (status == SL_OK) status = search_all(context, all, &visibility);
    tidy_up(context, all);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}

// --- in parts

/// Adds what the search has found to what was known.
static sl_status hand_over(sl_context *context, sli_dfs *all, sl_partial *partial) {
    const uint32_t count = all->space->cell_count;
    sl_partial found = {.unit_count = count, .inside_only = all->options->inside_only};
    found.done = sl_alloc_array(context, sl_bits_words(count), sizeof *found.done);
    sl_status status = found.done ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sli_pvs_join(context, all->sure, count, &found.sure);
    if (status == SL_OK) status = sli_pvs_join(context, all->doubtful, count, &found.doubtful);
    if (status == SL_OK) status = sli_dfs_effects_hand_over(context, all, &found);
    if (status == SL_OK) {
        sli_partial_note_bytes(&found, all->done);
        status = sl_partial_merge(context, partial, &found);
    }
    sl_partial_destroy(context, &found);
    return status;
}

static sl_status search_some(sl_context *context, sli_dfs *all, sl_partial *partial) {
    const uint32_t count = all->space->cell_count;
    SL_TRY(prepare(context, all));
    SL_TRY(sli_partial_begin(context, all->space, all->options, count, partial));
    all->before = partial;
    all->done = sl_alloc_array(context, count, sizeof *all->done);
    if (!all->done) return SL_NO_MEMORY;
    SL_TRY(run_search(context, all));
    return hand_over(context, all, partial);
}

static sl_status look(sl_context *context, sli_dfs *all, sl_partial *partial) {
    if (all->options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "a search done in parts makes no stab trees");
    const sl_status status = search_some(context, all, partial);
    tidy_up(context, all);
    return status;
}

// --- the methods

static sl_status check_options(sl_context *context, const sl_see_options *options, bool prunes) {
    if (!options->solver)
        return sl_fail(context, SL_BAD_ARGUMENT, "the method '%s' needs a solver",
                       prunes ? "prune" : "dfs");
    if (prunes && options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method 'prune' makes no stab trees");
    return SL_OK;
}

sl_status sli_see_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                      sl_visibility *out) {
    sli_dfs all = {.space = space, .options = options};
    SL_TRY(check_options(context, options, all.prunes));
    return see(context, &all, out);
}

sl_status sli_run_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                      sl_partial *partial) {
    sli_dfs all = {.space = space, .options = options};
    SL_TRY(check_options(context, options, all.prunes));
    return look(context, &all, partial);
}

sl_status sli_see_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_visibility *out) {
    sli_dfs all = {.space = space, .options = options, .prunes = true};
    SL_TRY(check_options(context, options, all.prunes));
    return see(context, &all, out);
}

sl_status sli_dfs_see_rest(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const sli_dfs_known *known,
                           sl_visibility *out) {
    sli_dfs all = {.space = space, .options = options, .prunes = true, .known = known};
    return see(context, &all, out);
}

sl_status sli_run_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_partial *partial) {
    sli_dfs all = {.space = space, .options = options, .prunes = true};
    SL_TRY(check_options(context, options, all.prunes));
    return look(context, &all, partial);
}
