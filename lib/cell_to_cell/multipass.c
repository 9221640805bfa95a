/// All cells at once, sector by sector of directions (Laine 2005, A General Algorithm for
/// Output-Sensitive Visibility Preprocessing).
///
/// A sightline of a sector that leaves a cell by a face goes on in the cell behind it. So what the
/// face sees is among what that cell sees in the sector, its directed visible set: those are the
/// only candidates. Cells are done in an order in which the cells behind come first. Where a sector
/// is so wide that portals are crossed both ways in it, cells may depend on each other round a
/// cycle; the candidates of these are each other, and what all of them together see beyond.
///
/// A face's candidates are decided on by a depth-first search over portal sequences, as in dfs.c,
/// within the sector alone: the solver is asked for lines of its directions. The search goes
/// through an exit only while a candidate that is not seen yet is left behind it, and what is
/// behind it is known, by the faces that are done.
///
/// Pairs are symmetric, and what a cell sees in one sector sees it in the opposite one: half of the
/// sectors tell all.
#include "base/bits.h"
#include "base/threads.h"
#include "cell_to_cell/bit_rows.h"
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pass.h"

#include <pthread.h>
#include <string.h>

/// Passes run at the same time as far as their sets need no more memory than this.
#define MOST_BYTES ((size_t)256 << 20)

/// A pass on its way, and what its faces see: a row of cells each.
typedef struct running_pass {
    sl_pass pass;
    sl_bits *seen;
} running_pass;

/// A component of a pass's order: what one thread does in one go.
typedef struct unit {
    uint32_t pass, component;
} unit;

typedef struct multipass {
    const sl_space *space;
    const sl_see_options *options;
    sl_sectors sectors;
    size_t words; ///< of a row
    SL_ARRAY(running_pass) passes;
    SL_ARRAY(unit) units; ///< by level, so that all that a unit depends on has been handed out
    size_t *after;        ///< by unit: how many of the first are of lower levels
    pthread_mutex_t lock;
    sl_bit_rows sure, doubtful; ///< under the lock; no doubtful ones of exact solvers
    sl_see_account account;     ///< under the lock
} multipass;

/// A cell on the way from a face.
typedef struct step {
    uint32_t cell, next; ///< exit to try next, from 0
    sl_cone cone;        ///< directions that cross all portals so far
    bool grazing;        ///< the sequence is no more than grazed
} step;

/// One thread's own.
typedef struct searcher {
    void *solver;
    SL_ARRAY(step) steps;
    SL_ARRAY(sl_bits) wanted;                             ///< a set for each step
    sl_bits *sure, *doubtful, *cell_sure, *cell_doubtful; ///< of the face and of the cell at hand
    sl_bits *cycle; ///< candidates of a component with a cycle
    sl_see_account account;
} searcher;

static sl_bits *row_of(const multipass *all, const running_pass *p, uint32_t face) {
    return p->seen + face * all->words;
}

static void add_all(const multipass *all, sl_bits *to, const sl_bits *from) {
    for (size_t i = 0; i < all->words; i++) to[i] |= from[i];
}

/// Adds a cell's directed visible set.
static void add_directed(const multipass *all, const running_pass *p, uint32_t cell, sl_bits *set) {
    sl_bits_add(set, cell);
    for (uint32_t face = p->pass.first[cell]; face < p->pass.first[cell + 1]; face++)
        add_all(all, set, row_of(all, p, face));
}

static sl_status enter(sl_context *context, searcher *me, step to) {
    me->account.nodes++;
    SL_TRY(SL_ARRAY_ROOM(context, &me->steps, 1));
    me->steps.items[me->steps.count++] = to;
    if (me->steps.count > me->account.deepest) me->account.deepest = (uint32_t)me->steps.count;
    return SL_OK;
}

/// The verdict on the sequence with one more portal, for lines of the sector. SL_HIDDEN: it must
/// be popped.
static sl_status push(sl_context *context, const multipass *all, searcher *me, const sl_exit *exit,
                      const sl_cone *cone, sl_stab_verdict *verdict) {
    const sl_solver *solver = all->options->solver;
    if (++me->account.tests % 64 == 0) SL_TRY(sl_check_cancelled(context));
    SL_TRY(solver->push(context, me->solver, exit->left, exit->right, verdict));
    if (*verdict == SL_HIDDEN) return SL_OK;
    const bool near = *verdict == SL_GRAZING && solver->guarantee == SL_ROUNDED;
    SL_TRY(solver->toward(context, me->solver, cone->right, cone->left, verdict));
    // Whether a line that rounding may have made is within the sector cannot be told either.
    if (near && *verdict == SL_HIDDEN) *verdict = SL_GRAZING;
    return SL_OK;
}

/// Whether candidates that are not seen yet are left beyond an exit of the last step, or of the
/// face itself; makes the set of all that are wanted there.
static sl_status want(sl_context *context, const multipass *all, searcher *me,
                      const sl_bits *behind, bool *something) {
    const size_t words = all->words, depth = me->steps.count;
    SL_TRY(SL_ARRAY_ROOM(context, &me->wanted, (depth + 1) * words));
    const sl_bits *before = me->wanted.items + (depth - 1) * words;
    sl_bits *beyond = me->wanted.items + depth * words, any = 0;
    for (size_t i = 0; i < words; i++) {
        beyond[i] = before[i] & behind[i];
        any |= beyond[i] & ~me->sure[i];
    }
    *something = any != 0;
    return SL_OK;
}

static sl_status try_exit(sl_context *context, const multipass *all, const running_pass *p,
                          searcher *me, uint32_t number) {
    const sl_solver *solver = all->options->solver;
    const sl_exit *exit = &all->space->exits[number];
    const step from = me->steps.items[me->steps.count - 1];
    sl_cone cone = from.cone;
    if (p->pass.faces[number] == SL_NO_FACE || !sl_cone_cut(&cone, exit)) return SL_OK;
    bool something;
    SL_TRY(want(context, all, me, row_of(all, p, p->pass.faces[number]), &something));
    if (!something) return SL_OK;

    sl_stab_verdict verdict;
    SL_TRY(push(context, all, me, exit, &cone, &verdict));
    const bool rounded = solver->guarantee == SL_ROUNDED;
    const bool grazing = verdict == SL_GRAZING || from.grazing;
    if (verdict == SL_HIDDEN || (grazing && all->options->sight == SL_OPEN && !rounded)) {
        solver->pop(me->solver);
        return SL_OK;
    }
    sl_bits_add(grazing && rounded ? me->doubtful : me->sure, exit->cell);
    return enter(context, me, (step){.cell = exit->cell, .cone = cone, .grazing = grazing});
}

/// Finds what a face sees, among what the first set of `wanted` holds, into `sure` and `doubtful`.
static sl_status search_face(sl_context *context, const multipass *all, const running_pass *p,
                             searcher *me, uint32_t number) {
    const sl_space *space = all->space;
    const sl_exit *exit = &space->exits[number];
    sl_cone cone = p->pass.cone;
    (void)sl_cone_cut(&cone, exit); // it has some: else the exit were no face
    sl_stab_verdict verdict;
    SL_TRY(push(context, all, me, exit, &cone, &verdict));
    sl_bits_add(me->sure, exit->cell);
    me->steps.count = 0;
    SL_TRY(enter(context, me, (step){.cell = exit->cell, .cone = cone}));
    while (me->steps.count) {
        step *last = &me->steps.items[me->steps.count - 1];
        const sl_cell *cell = &space->cells[last->cell];
        if (last->next < cell->exit_count) {
            SL_TRY(try_exit(context, all, p, me, cell->first_exit + last->next++));
        } else {
            me->steps.count--;
            all->options->solver->pop(me->solver);
        }
    }
    return SL_OK;
}

static uint64_t count_bits(const sl_bits *set, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(set[i]);
    return count;
}

/// What all faces of a cell see in the sector. `cycle`: the candidates where those behind a face
/// need not be done yet; NULL where they are.
static sl_status search_cell(sl_context *context, const multipass *all, const running_pass *p,
                             searcher *me, uint32_t cell, const sl_bits *cycle) {
    const size_t bytes = all->words * sizeof(sl_bits);
    const sl_cell *c = &all->space->cells[cell];
    memset(me->cell_sure, 0, bytes);
    memset(me->cell_doubtful, 0, bytes);
    sl_bits_add(me->cell_sure, cell);
    SL_TRY(SL_ARRAY_ROOM(context, &me->wanted, all->words));
    for (uint32_t e = c->first_exit; e < c->first_exit + c->exit_count; e++) {
        const uint32_t face = p->pass.faces[e];
        if (face == SL_NO_FACE) continue;
        memset(me->sure, 0, bytes);
        memset(me->doubtful, 0, bytes);
        if (cycle) {
            memcpy(me->wanted.items, cycle, bytes);
        } else {
            memset(me->wanted.items, 0, bytes);
            add_directed(all, p, all->space->exits[e].cell, me->wanted.items);
        }
        me->account.candidates += count_bits(me->wanted.items, all->words);
        SL_TRY(search_face(context, all, p, me, e));
        sl_bits *row = row_of(all, p, face);
        memcpy(row, me->sure, bytes);
        add_all(all, row, me->doubtful);
        me->account.relations += count_bits(row, all->words);
        add_all(all, me->cell_sure, me->sure);
        add_all(all, me->cell_doubtful, me->doubtful);
    }
    return SL_OK;
}

/// Candidates of a component with a cycle: its cells, and all that they see beyond it. Until better
/// is known that is what its faces see.
static void bound_cycle(const multipass *all, const running_pass *p, searcher *me,
                        uint32_t component) {
    const sl_order *order = &p->pass.order;
    memset(me->cycle, 0, all->words * sizeof *me->cycle);
    for (int round = 0; round < 2; round++)
        for (uint32_t i = order->starts[component]; i < order->starts[component + 1]; i++) {
            const uint32_t cell = order->nodes[i];
            sl_bits_add(me->cycle, cell);
            for (uint32_t face = p->pass.first[cell]; face < p->pass.first[cell + 1]; face++) {
                const uint32_t behind = p->pass.to[face];
                if (round)
                    memcpy(row_of(all, p, face), me->cycle, all->words * sizeof *me->cycle);
                else if (order->component[behind] != component)
                    add_directed(all, p, behind, me->cycle);
            }
        }
}

static sl_status search_unit(sl_context *context, void *job, void *state, size_t number) {
    multipass *all = job;
    searcher *me = state;
    const unit *u = &all->units.items[number];
    const running_pass *p = &all->passes.items[u->pass];
    const sl_order *order = &p->pass.order;
    const uint32_t first = order->starts[u->component], end = order->starts[u->component + 1];
    const bool cyclic = end - first > 1;
    if (cyclic) {
        bound_cycle(all, p, me, u->component);
        me->account.on_cycles += end - first;
    }
    for (uint32_t i = first; i < end; i++) {
        const uint32_t cell = order->nodes[i];
        if (all->options->inside_only && !all->space->cells[cell].inside) continue;
        SL_TRY(search_cell(context, all, p, me, cell, cyclic ? me->cycle : NULL));
        pthread_mutex_lock(&all->lock);
        add_all(all, sl_bit_rows_dense(&all->sure, cell), me->cell_sure);
        if (all->doubtful.bits)
            add_all(all, sl_bit_rows_dense(&all->doubtful, cell), me->cell_doubtful);
        pthread_mutex_unlock(&all->lock);
    }
    return SL_OK;
}

static void end(sl_context *context, void *job, void *state) {
    multipass *all = job;
    searcher *me = state;
    const sl_solver *solver = all->options->solver;
    pthread_mutex_lock(&all->lock);
    if (me->solver && solver->account) solver->account(me->solver, &all->account.stab);
    all->account.tests += me->account.tests;
    all->account.nodes += me->account.nodes;
    all->account.candidates += me->account.candidates;
    all->account.relations += me->account.relations;
    all->account.on_cycles += me->account.on_cycles;
    if (me->account.deepest > all->account.deepest) all->account.deepest = me->account.deepest;
    pthread_mutex_unlock(&all->lock);
    solver->destroy(context, me->solver);
    sl_free(context, me->steps.items);
    sl_free(context, me->wanted.items);
    sl_free(context, me->sure);
    sl_free(context, me);
}

static sl_status begin(sl_context *context, void *job, void **state) {
    multipass *all = job;
    searcher *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    me->sure = sl_alloc_array(context, all->words, 5 * sizeof *me->sure);
    sl_status status = me->sure ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        me->doubtful = me->sure + all->words;
        me->cell_sure = me->doubtful + all->words;
        me->cell_doubtful = me->cell_sure + all->words;
        me->cycle = me->cell_doubtful + all->words;
        status = all->options->solver->create(context, all->space->bounds, &me->solver);
    }
    if (status == SL_OK)
        *state = me;
    else
        end(context, job, me);
    return status;
}

// --- passes at the same time

static size_t bytes_of(const multipass *all, const running_pass *p) {
    return p->pass.face_count * all->words * sizeof(sl_bits);
}

/// Rows here are dense: a pass alone may take more than it may.
static sl_status check_memory(sl_context *context, const multipass *all, size_t bytes) {
    if (bytes <= all->options->row_bytes) return SL_OK;
    return sl_fail(
        context, SL_NO_MEMORY,
        "a pass over all cells takes %.1f MiB, more than the %.1f MiB that it may: allow "
        "more memory, or take the method 'sweep'",
        (double)bytes / 0x1p20, (double)all->options->row_bytes / 0x1p20);
}

static sl_status add_pass(sl_context *context, multipass *all, uint32_t sector) {
    SL_TRY(SL_ARRAY_ROOM(context, &all->passes, 1));
    running_pass *p = &all->passes.items[all->passes.count];
    *p = (running_pass){0};
    SL_TRY(sl_pass_create(context, all->space, all->options->inside_only,
                          sl_sector_cone(&all->sectors, sector), &p->pass));
    all->passes.count++;
    SL_TRY(check_memory(context, all, bytes_of(all, p)));
    p->seen = sl_alloc_array(context, p->pass.face_count, all->words * sizeof *p->seen);
    return p->seen ? SL_OK : SL_NO_MEMORY;
}

static void drop_passes(sl_context *context, multipass *all) {
    for (size_t i = 0; i < all->passes.count; i++) {
        sl_pass_destroy(context, &all->passes.items[i].pass);
        sl_free(context, all->passes.items[i].seen);
    }
    all->passes.count = 0;
}

/// Lists the components of all passes by level.
static sl_status list_units(sl_context *context, multipass *all) {
    uint32_t levels = 0;
    size_t count = 0;
    for (size_t i = 0; i < all->passes.count; i++) {
        const sl_order *order = &all->passes.items[i].pass.order;
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
            const sl_order *order = &all->passes.items[i].pass.order;
            for (uint32_t k = 0; k < order->component_count; k++) starts[order->level[k] + 1]++;
        }
        for (uint32_t level = 0; level < levels; level++) {
            starts[level + 1] += starts[level];
            for (size_t i = starts[level]; i < starts[level + 1]; i++)
                all->after[i] = starts[level];
        }
        for (size_t i = 0; i < all->passes.count; i++) {
            const sl_order *order = &all->passes.items[i].pass.order;
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
                          .begin = begin,
                          .unit = search_unit,
                          .end = end,
                          .leave_thread = all->options->solver->leave_thread,
                          .stage = "cell_to_cell",
                          .units = "cells",
                          .after = all->after};
    return sl_work_run(context, &work, all->units.count, all->options->threads);
}

static sl_status pass_all(sl_context *context, multipass *all) {
    size_t bytes = 0;
    for (uint32_t sector = 0; sector < all->sectors.count / 2; sector++) {
        SL_TRY(add_pass(context, all, sector));
        bytes += bytes_of(all, &all->passes.items[all->passes.count - 1]);
        if (bytes < MOST_BYTES && sector + 1 < all->sectors.count / 2) continue;
        SL_TRY(run_passes(context, all));
        drop_passes(context, all);
        sl_free(context, all->after);
        all->after = NULL;
        bytes = 0;
    }
    return SL_OK;
}

// --- the method

/// Of rounded solvers: what is sure is not doubtful, and with closed sight what is doubtful is
/// seen.
static sl_status settle(sl_context *context, multipass *all, sl_visibility *out) {
    SL_TRY(sl_bit_rows_mirror(context, &all->sure, SL_ADD_MIRRORED));
    if (!all->doubtful.bits) return sl_bit_rows_encode(context, &all->sure, out);
    SL_TRY(sl_bit_rows_mirror(context, &all->doubtful, SL_ADD_MIRRORED));
    for (size_t i = 0; i < all->sure.count * all->words; i++) {
        all->doubtful.bits[i] &= ~all->sure.bits[i];
        if (out->sight == SL_CLOSED) all->sure.bits[i] |= all->doubtful.bits[i];
    }
    sl_visibility doubtful = {0};
    SL_TRY(sl_bit_rows_encode(context, &all->doubtful, &doubtful));
    out->doubtful = doubtful.pvs;
    out->account.doubtful_pairs = doubtful.account.pairs;
    return sl_bit_rows_encode(context, &all->sure, out);
}

static sl_status see(sl_context *context, multipass *all, sl_visibility *out) {
    const uint32_t count = all->space->cell_count;
    SL_TRY(sl_sectors_create(context, all->space, all->options->sectors, &all->sectors));
    all->account.sectors = all->sectors.count;
    // Faces have dense rows, of which there are more than cells.
    sl_see_options dense = *all->options;
    dense.rows = SL_ROWS_DENSE;
    SL_TRY(sl_bit_rows_create(context, count, &dense, &all->sure));
    if (all->options->solver->guarantee == SL_ROUNDED)
        SL_TRY(sl_bit_rows_create(context, count, &dense, &all->doubtful));
    SL_TRY(pass_all(context, all));
    out->account = all->account;
    return settle(context, all, out);
}

sl_status sl_see_multipass(sl_context *context, const sl_space *space,
                           const sl_see_options *options, sl_visibility *out) {
    if (!options->solver)
        return sl_fail(context, SL_BAD_ARGUMENT, "the method 'multipass' needs a solver");
    if (!options->solver->toward)
        return sl_fail(context, SL_UNSUPPORTED,
                       "the method 'multipass' needs a solver that tells lines of some directions; "
                       "'%s' does not",
                       options->solver->name);
    if (options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method 'multipass' makes no stab trees");
    multipass all = {.space = space, .options = options, .words = sl_bits_words(space->cell_count)};
    sl_visibility visibility = {.sight = options->sight, .guarantee = options->solver->guarantee};
    pthread_mutex_init(&all.lock, NULL);
    const sl_status status = see(context, &all, &visibility);
    pthread_mutex_destroy(&all.lock);
    drop_passes(context, &all);
    sl_free(context, all.passes.items);
    sl_free(context, all.units.items);
    sl_free(context, all.after);
    sl_sectors_destroy(context, &all.sectors);
    sl_bit_rows_destroy(context, &all.sure);
    sl_bit_rows_destroy(context, &all.doubtful);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}
