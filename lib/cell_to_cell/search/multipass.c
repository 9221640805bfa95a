/// All cells at once, one sector of directions after the other (Laine 2005, A General Algorithm for
/// Output-Sensitive Visibility Preprocessing).
///
/// A sightline of a sector leaves a cell by a face and goes on in the cell behind. So the face sees
/// nothing but what that cell sees in the sector, its directed visible set. These are the face's
/// candidates. Cells are done in an order in which the cells behind come first (sectors.h).
///
/// A wide sector may have portals that are crossed both ways. Then cells may depend on each other
/// round a cycle. Their candidates are all cells of the cycle and all that these see beyond it.
///
/// A depth-first search decides on the candidates of a face. It asks the solver for lines of the
/// sector alone. It goes through a portal only while an unseen candidate is left behind it.
///
/// Pairs are symmetric: what a cell sees in one sector sees it in the opposite one. So half of the
/// sectors are enough.
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/rows.h"
#include "cell_to_cell/search/bounds.h"
#include "cell_to_cell/search/portal_search.h"
#include "cell_to_cell/search/sectors.h"
#include "sightline/support.h"

#include <pthread.h>
#include <string.h>

/// A pass on its way, and what its faces see: a row of cells each, empty until it is known.
typedef struct running_pass {
    sli_pass pass;
    sli_sparse_row *seen;
} running_pass;

/// A component of a pass's order: what one thread does in one go.
typedef struct unit {
    uint32_t pass, component;
} unit;

typedef struct multipass {
    const sl_space *space;
    const sl_see_options *options;
    sli_sectors sectors;
    size_t words; ///< of a row
    SL_ARRAY(running_pass) passes;
    SL_ARRAY(unit) units;  ///< by level, so that all that a unit depends on has been handed out
    size_t *after;         ///< by unit: how many of the first are of lower levels
    sli_row_budget budget; ///< of what faces see
    bool rounded;          ///< so is the solver: some pairs may be doubtful
    pthread_mutex_t lock;
    sli_bit_rows sure, doubtful; ///< joined under the lock
    sl_see_account account;      ///< under the lock
} multipass;

/// A cell on the way from a face.
typedef struct step {
    sli_portal_step at;
    sli_direction_sector cone; ///< directions that cross all portals so far
    bool grazing;              ///< the sequence is no more than grazed
} step;

/// One thread's own.
typedef struct searcher {
    sli_portal_search search;
    sli_prune_wanted wanted;                               ///< at each step
    sli_word_set sure, doubtful, cell_sure, cell_doubtful; ///< of the face and of the cell at hand
    sli_word_set candidates;                               ///< of the face, or of its cycle
    sli_bit_rows rows, doubtful_rows;
    sl_see_account account;
} searcher;

/// Adds a cell's directed visible set.
static void add_directed(const multipass *all, const running_pass *p, uint32_t cell,
                         sli_word_set *set) {
    sli_word_set_add(set, cell);
    for (uint32_t face = p->pass.first[cell]; face < p->pass.first[cell + 1]; face++)
        sli_sparse_row_add_to(&p->seen[face], all->words, set);
}

static void enter(searcher *me) {
    me->account.nodes++;
    me->search.count++;
    if (me->search.count > me->account.deepest) me->account.deepest = (uint32_t)me->search.count;
}

/// The verdict on the sequence with one more portal, for lines of the sector. SL_HIDDEN: it must
/// be popped.
static sl_status push_step(sl_context *context, const multipass *all, searcher *me,
                           const sl_directed_portal *directed, const sli_direction_sector *cone,
                           sl_stab_verdict *verdict) {
    const sl_solver *solver = all->options->solver;
    if (++me->account.tests % 64 == 0) SL_TRY(sl_check_cancelled(context));
    SL_TRY(sli_portal_search_push(context, &me->search, directed->left, directed->right, verdict));
    if (*verdict == SL_HIDDEN) return SL_OK;
    const bool near = *verdict == SL_GRAZING && solver->guarantee == SL_ROUNDED;
    SL_TRY(solver->toward(context, me->search.solver_state, cone->right, cone->left, verdict));
    // Whether a line that rounding may have made is within the sector cannot be told either.
    if (near && *verdict == SL_HIDDEN) *verdict = SL_GRAZING;
    return SL_OK;
}

/// Makes the set of candidates that are wanted beyond a directed portal of the last step.
/// `something`: one of them is not seen yet. What lies behind a portal of the current cycle may not
/// be known yet. Then it bounds nothing.
static sl_status want(sl_context *context, searcher *me, const sli_sparse_row *behind,
                      bool *something) {
    const size_t depth = me->search.count;
    SL_TRY(sli_prune_step_within(context, behind, &me->wanted, depth));
    const sli_prune_set *set = &me->wanted.sets.items[depth];
    *something = false;
    for (size_t i = set->begin; i < set->end && !*something; i++) {
        const sli_prune_word *at = &me->wanted.words.items[i];
        *something = (at->bits & ~me->sure.bits[at->word]) != 0;
    }
    return SL_OK;
}

/// The search from one face.
typedef struct face_job {
    const multipass *all;
    const running_pass *pass;
    searcher *me;
} face_job;

SLI_VISIT sl_status cross(sl_context *context, void *job, const void *last, void *next,
                          uint32_t number) {
    const face_job *at = job;
    const multipass *all = at->all;
    searcher *me = at->me;
    const step *from = last;
    step *to = next;
    const uint32_t face = at->pass->pass.faces[number];
    const sl_directed_portal *directed = &all->space->directed[number];
    *to = (step){.at.cell = directed->cell, .cone = from->cone};
    if (face == SLI_NO_FACE || !sli_direction_sector_cut(&to->cone, directed)) return SL_OK;
    bool something;
    SL_TRY(want(context, me, &at->pass->seen[face], &something));
    if (!something) return SL_OK;

    sl_stab_verdict verdict;
    SL_TRY(push_step(context, all, me, directed, &to->cone, &verdict));
    to->grazing = verdict == SL_GRAZING || from->grazing;
    if (verdict == SL_HIDDEN || (to->grazing && all->options->sight == SL_OPEN && !all->rounded)) {
        sli_portal_search_pop(&me->search);
        return SL_OK;
    }
    sli_word_set_add(to->grazing && all->rounded ? &me->doubtful : &me->sure, directed->cell);
    enter(me);
    return SL_OK;
}

/// Finds what a face sees among the candidates, into `sure` and `doubtful`.
static sl_status search_face(sl_context *context, const multipass *all, const running_pass *p,
                             searcher *me, uint32_t number) {
    static const sli_portal_visitor visitor = {.step_size = sizeof(step), .cross = cross};
    const sl_directed_portal *directed = &all->space->directed[number];
    SL_TRY(sli_portal_search_start(context, &me->search, sizeof(step)));
    step *first = me->search.steps;
    *first = (step){.at.cell = directed->cell, .cone = p->pass.cone};
    (void)sli_direction_sector_cut(&first->cone,
                                   directed); // it has some: else the portal were no face
    sl_stab_verdict verdict;
    SL_TRY(push_step(context, all, me, directed, &first->cone, &verdict));
    sli_word_set_add(&me->sure, directed->cell);
    SL_TRY(sli_prune_start_among(context, &me->wanted, &me->candidates));
    enter(me);
    face_job job = {all, p, me};
    return sli_portal_search_run(context, &me->search, &visitor, &job);
}

static uint64_t count_bits(const sli_word_set *set) {
    uint64_t count = 0;
    for (size_t word = sli_word_set_next(set, set->low); word < set->high;
         word = sli_word_set_next(set, word + 1))
        count += (uint64_t)__builtin_popcountll(set->bits[word]);
    return count;
}

static void add_set(sli_word_set *to, const sli_word_set *from) {
    for (size_t word = sli_word_set_next(from, from->low); word < from->high;
         word = sli_word_set_next(from, word + 1))
        sli_word_set_join(to, word, from->bits[word]);
}

/// Finds what a face sees in the sector. Keeps it as the face's row and adds it to its cell's sets.
static sl_status search_whole_face(sl_context *context, multipass *all, const running_pass *p,
                                   searcher *me, uint32_t directed) {
    sli_sparse_row *row = &p->seen[p->pass.faces[directed]];
    sli_word_set_clear(&me->sure);
    sli_word_set_clear(&me->doubtful);
    me->account.multipass.candidates += count_bits(&me->candidates);
    SL_TRY(search_face(context, all, p, me, directed));
    add_set(&me->cell_sure, &me->sure);
    add_set(&me->cell_doubtful, &me->doubtful);
    add_set(&me->sure, &me->doubtful);
    me->account.multipass.relations += count_bits(&me->sure);
    return sli_sparse_row_add(context, row, all->words, &me->sure, &all->budget);
}

/// Finds what all faces of a cell see in the sector. `cyclic`: the candidates are those of the
/// cycle, since the cell behind a face need not be done yet.
static sl_status search_cell(sl_context *context, multipass *all, const running_pass *p,
                             searcher *me, uint32_t cell, bool cyclic) {
    const sl_cell *c = &all->space->cells[cell];
    sli_word_set_clear(&me->cell_sure);
    sli_word_set_clear(&me->cell_doubtful);
    sli_word_set_add(&me->cell_sure, cell);
    for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
        if (p->pass.faces[e] == SLI_NO_FACE) continue;
        if (!cyclic) {
            sli_word_set_clear(&me->candidates);
            add_directed(all, p, all->space->directed[e].cell, &me->candidates);
        }
        SL_TRY(search_whole_face(context, all, p, me, e));
    }
    SL_TRY(sli_bit_rows_add(context, &me->rows, cell, &me->cell_sure));
    if (all->rounded)
        SL_TRY(sli_bit_rows_add(context, &me->doubtful_rows, cell, &me->cell_doubtful));
    return SL_OK;
}

/// Candidates of a component with a cycle: its cells, and all that they see beyond it.
static void bound_cycle(const multipass *all, const running_pass *p, searcher *me,
                        uint32_t component) {
    const sli_order *order = &p->pass.order;
    sli_word_set_clear(&me->candidates);
    for (uint32_t i = order->starts[component]; i < order->starts[component + 1]; i++) {
        const uint32_t cell = order->nodes[i];
        sli_word_set_add(&me->candidates, cell);
        for (uint32_t face = p->pass.first[cell]; face < p->pass.first[cell + 1]; face++) {
            const uint32_t behind = p->pass.to[face];
            if (order->component[behind] != component)
                add_directed(all, p, behind, &me->candidates);
        }
    }
}

static sl_status search_unit(sl_context *context, void *job, void *state, size_t number) {
    multipass *all = job;
    searcher *me = state;
    const unit *u = &all->units.items[number];
    const running_pass *p = &all->passes.items[u->pass];
    const sli_order *order = &p->pass.order;
    const uint32_t first = order->starts[u->component], end = order->starts[u->component + 1];
    const bool cyclic = end - first > 1;
    if (cyclic) {
        bound_cycle(all, p, me, u->component);
        me->account.multipass.on_cycles += end - first;
    }
    for (uint32_t i = first; i < end; i++) {
        const uint32_t cell = order->nodes[i];
        if (!sli_looks_from(all->space, all->options->inside_only, cell)) continue;
        SL_TRY(search_cell(context, all, p, me, cell, cyclic));
    }
    return SL_OK;
}

static void free_sets(sl_context *context, searcher *me) {
    sli_word_set *sets[] = {&me->sure, &me->doubtful, &me->cell_sure, &me->cell_doubtful,
                            &me->candidates};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) sli_word_set_destroy(context, sets[i]);
}

static void end_multipass_worker(sl_context *context, void *job, void *state) {
    multipass *all = job;
    searcher *me = state;
    const sl_solver *solver = all->options->solver;
    pthread_mutex_lock(&all->lock);
    if (me->search.solver_state && solver->account)
        solver->account(me->search.solver_state, &all->account.stab);
    all->account.tests += me->account.tests;
    all->account.nodes += me->account.nodes;
    all->account.multipass.candidates += me->account.multipass.candidates;
    all->account.multipass.relations += me->account.multipass.relations;
    all->account.multipass.on_cycles += me->account.multipass.on_cycles;
    if (me->account.deepest > all->account.deepest) all->account.deepest = me->account.deepest;
    sli_bit_rows_join(context, &all->sure, &me->rows);
    sli_bit_rows_join(context, &all->doubtful, &me->doubtful_rows);
    pthread_mutex_unlock(&all->lock);
    sli_portal_search_end(context, &me->search);
    sli_prune_wanted_destroy(context, &me->wanted);
    free_sets(context, me);
    sl_free(context, me);
}

static sl_status make_sets(sl_context *context, const multipass *all, searcher *me) {
    const uint32_t count = all->space->cell_count;
    me->search = (sli_portal_search){.space = all->space, .solver = all->options->solver};
    SL_TRY(sli_word_set_create(context, count, &me->sure));
    SL_TRY(sli_word_set_create(context, count, &me->doubtful));
    SL_TRY(sli_word_set_create(context, count, &me->cell_sure));
    SL_TRY(sli_word_set_create(context, count, &me->cell_doubtful));
    SL_TRY(sli_word_set_create(context, count, &me->candidates));
    SL_TRY(sli_bit_rows_fork(context, &all->sure, &me->rows));
    if (all->rounded) SL_TRY(sli_bit_rows_fork(context, &all->doubtful, &me->doubtful_rows));
    return me->search.solver->create(context, all->space->bounds, &me->search.solver_state);
}

static sl_status begin_multipass_worker(sl_context *context, void *job, void **state) {
    multipass *all = job;
    searcher *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    const sl_status status = make_sets(context, all, me);
    if (status == SL_OK)
        *state = me;
    else
        end_multipass_worker(context, job, me);
    return status;
}

// --- passes at the same time

static sl_status add_pass(sl_context *context, multipass *all, uint32_t sector) {
    SL_TRY(SL_ARRAY_ROOM(context, &all->passes, 1));
    running_pass *p = &all->passes.items[all->passes.count];
    *p = (running_pass){0};
    SL_TRY(sli_pass_create(context, all->space, all->options->inside_only,
                           sli_sectors_get(&all->sectors, sector), &p->pass));
    all->passes.count++;
    p->seen = sl_alloc_array(context, p->pass.face_count, sizeof *p->seen);
    return p->seen ? SL_OK : SL_NO_MEMORY;
}

static void drop_passes(sl_context *context, multipass *all) {
    for (size_t i = 0; i < all->passes.count; i++) {
        running_pass *p = &all->passes.items[i];
        for (uint32_t face = 0; p->seen && face < p->pass.face_count; face++)
            sli_sparse_row_destroy(context, &p->seen[face]);
        sl_free(context, p->seen);
        sli_pass_destroy(context, &p->pass);
    }
    all->passes.count = 0;
    atomic_store(&all->budget.used, 0);
}

/// Lists the components of all passes by level.
static sl_status list_units(sl_context *context, multipass *all) {
    uint32_t levels = 0;
    size_t count = 0;
    for (size_t i = 0; i < all->passes.count; i++) {
        const sli_order *order = &all->passes.items[i].pass.order;
        count += order->component_count;
        if (order->level_count > levels) levels = order->level_count;
    }
    size_t *starts = sl_alloc_array(context, (size_t)levels + 1, sizeof *starts);
    all->after = sl_alloc_array(context, count, sizeof *all->after);
    all->units.count = 0;
    sl_status status =
        starts && all->after ? SL_ARRAY_ROOM(context, &all->units, count + 1) : SL_NO_MEMORY;
    if (status == SL_OK) {
        for (size_t i = 0; i < all->passes.count; i++) {
            const sli_order *order = &all->passes.items[i].pass.order;
            for (uint32_t k = 0; k < order->component_count; k++) starts[order->level[k] + 1]++;
        }
        for (uint32_t level = 0; level < levels; level++) {
            starts[level + 1] += starts[level];
            for (size_t i = starts[level]; i < starts[level + 1]; i++)
                all->after[i] = starts[level];
        }
        for (size_t i = 0; i < all->passes.count; i++) {
            const sli_order *order = &all->passes.items[i].pass.order;
            for (uint32_t k = 0; k < order->component_count; k++)
                all->units.items[starts[order->level[k]]++] =
                    (unit){.pass = (uint32_t)i, .component = k};
        }
        all->units.count = count;
    }
    sl_free(context, starts);
    return status;
}

static sl_status run_passes(sl_context *context, multipass *all) {
    SL_TRY(list_units(context, all));
    const sl_work work = {.job = all,
                          .begin = begin_multipass_worker,
                          .unit = search_unit,
                          .end = end_multipass_worker,
                          .leave_thread = all->options->solver->leave_thread,
                          .stage = "cell_to_cell",
                          .units = "cells",
                          .after = all->after};
    return sl_work_run(context, &work, all->units.count, all->options->threads);
}

/// Runs as many passes at the same time as there are threads. One pass alone often has no work that
/// is ready.
static sl_status pass_all(sl_context *context, multipass *all) {
    const size_t together = all->options->threads ? all->options->threads : sl_core_count();
    const uint32_t count = all->sectors.count / 2;
    for (uint32_t sector = 0; sector < count; sector++) {
        SL_TRY(add_pass(context, all, sector));
        if (all->passes.count < together && sector + 1 < count) continue;
        SL_TRY(run_passes(context, all));
        drop_passes(context, all);
        sl_free(context, all->after);
        all->after = NULL;
    }
    return SL_OK;
}

// --- the method

/// For rounded solvers: a pair that is sure is not doubtful. With closed sight a doubtful pair
/// counts as seen.
static sl_status finish_rounded(sl_context *context, multipass *all, sl_visibility *out) {
    sl_visibility sure = {0}, doubtful = {0};
    sl_status status = sli_bit_rows_encode(context, &all->sure, &sure);
    if (status == SL_OK) status = sli_bit_rows_encode(context, &all->doubtful, &doubtful);
    if (status == SL_OK)
        status = sli_visibility_finish(context, &sure.pvs, &doubtful.pvs, true, out);
    sl_visibility_destroy(context, &sure);
    sl_visibility_destroy(context, &doubtful);
    return status;
}

static sl_status finish(sl_context *context, multipass *all, sl_visibility *out) {
    if (all->rounded) return finish_rounded(context, all, out);
    SL_TRY(sli_bit_rows_mirror(context, &all->sure, SLI_ADD_MIRRORED));
    return sli_bit_rows_encode(context, &all->sure, out);
}

static sl_status see(sl_context *context, multipass *all, sl_visibility *out) {
    const uint32_t count = all->space->cell_count;
    SL_TRY(sli_sectors_create(context, all->space, all->options->sectors, &all->sectors));
    all->account.multipass.sectors = all->sectors.count;
    SL_TRY(sli_bit_rows_create(context, count, all->options, &all->sure));
    if (all->rounded) SL_TRY(sli_bit_rows_create(context, count, all->options, &all->doubtful));
    SL_TRY(pass_all(context, all));
    out->account = all->account;
    return finish(context, all, out);
}

sl_status sli_see_multipass(sl_context *context, const sl_space *space,
                            const sl_see_options *options, sl_visibility *out) {
    if (!options->solver)
        return sl_fail(context, SL_BAD_ARGUMENT, "the method 'multipass' needs a solver");
    if (!options->solver->toward)
        return sl_fail(context, SL_UNSUPPORTED,
                       "the method 'multipass' needs a solver that can limit directions; "
                       "'%s' does not",
                       options->solver->name);
    if (options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method 'multipass' makes no stab trees");
    multipass all = {.space = space,
                     .options = options,
                     .words = sl_bits_words(space->cell_count),
                     .budget = {.most = options->row_bytes},
                     .rounded = options->solver->guarantee == SL_ROUNDED};
    sl_visibility visibility = {.sight = options->sight, .guarantee = options->solver->guarantee};
    pthread_mutex_init(&all.lock, NULL);
    const sl_status status = see(context, &all, &visibility);
    pthread_mutex_destroy(&all.lock);
    drop_passes(context, &all);
    sl_free(context, all.passes.items);
    sl_free(context, all.units.items);
    sl_free(context, all.after);
    sli_sectors_destroy(context, &all.sectors);
    sli_bit_rows_destroy(context, &all.sure);
    sli_bit_rows_destroy(context, &all.doubtful);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}
